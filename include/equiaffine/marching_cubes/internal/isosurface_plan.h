// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_PLAN_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_PLAN_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/marching_cubes/internal/active_cells.h>
#include <equiaffine/marching_cubes/internal/case_table.h>
#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>
#include <equiaffine/marching_cubes/internal/trilinear_cell.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// The plan by which the vertices and triangles of an isosurface are made: their numbers, so that planes of nodes and
/// layers of cells can be worked on in any order, and the sub-cases of cells whose signs are ambiguous, which take 2
/// bytes each.
struct Isosurface_plan {
  const Node_signs& signs;
  const Case_table& table;
  bool has_undefined; ///< whether a node has no value
  Isosurface_numbering numbering;
  std::vector<std::vector<std::uint16_t>> sub_cases; ///< for each layer, one per ambiguous cell in the order of cells

  std::size_t number_of_ambiguous_cells() const {
    std::size_t sum = 0;
    for (const auto& layer : sub_cases) sum += layer.size();
    return sum;
  }
};

/// The number of crossed edges along each axis that begin in a row of nodes.
template <bool HasUndefined>
std::array<Isosurface_numbering::Index, 3> count_crossed_edges(const Node_signs& signs, std::size_t j, std::size_t k) {
  std::array<Isosurface_numbering::Index, 3> counts{};
  const Node_signs::Edge_row<HasUndefined> edges(signs, j, k);
  signs.for_each_word(j, k, [&](std::size_t w) {
    const auto crossed = edges.crossed(w);
    if ((crossed[0] | crossed[1] | crossed[2]) == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis)
      counts[axis] += Isosurface_numbering::Index(std::popcount(crossed[axis]));
  });
  return counts;
}

/// Counts the vertices and triangles of a layer of cells and of the plane of nodes at its lower end. The sub-case of an
/// ambiguous cell is `choose(i, j, k, signs)`.
template <bool HasUndefined, class Choose>
void plan_layer(Isosurface_plan& plan, std::size_t k, const Choose& choose) {
  const Case_table& table = plan.table;
  const Node_signs& signs = plan.signs;
  auto& sub_cases = plan.sub_cases[k];
  auto& layer = plan.numbering.layer(k);
  for (std::size_t j = 0; j < signs.size()[1]; ++j) {
    Isosurface_numbering::Row counts;
    counts.first = count_crossed_edges<HasUndefined>(signs, j, k);
    if (j + 1 < signs.size()[1] && k + 1 < signs.size()[2])
      for_each_active_cell<HasUndefined>(signs, j, k, [&](std::size_t i, unsigned corner_signs) {
        const Case_table::Entry* entry = &table.of_signs[corner_signs];
        if (entry->is_ambiguous) {
          sub_cases.push_back(std::uint16_t(choose(i, j, k, corner_signs)));
          entry = &table.of_sub_case[sub_cases.back()];
          layer.inner_vertices += entry->inner_vertices;
        }
        counts.triangles += entry->triangles;
      });
    plan.numbering.row(j, k) = counts;
  }
}

/// Makes the plan of the surface in a grid. In ambiguous cells the trilinear interpolant decides. The plan keeps
/// references to the signs and the table.
template <class ConcurrencyTag, class Grid>
Isosurface_plan plan_isosurface(const Node_signs& signs, const Grid& grid, const Case_table& table) {
  const auto choose = [&](std::size_t i, std::size_t j, std::size_t k, unsigned corner_signs) {
    return Trilinear_cell<typename Grid::FT>(grid.cell_values({i, j, k}), grid.isovalue()).sub_case(corner_signs);
  };
  const std::size_t planes = signs.size()[2];
  Isosurface_plan plan{signs, table, signs.has_undefined(), Isosurface_numbering(signs), {}};
  plan.sub_cases.resize(planes);
  parallel_for<ConcurrencyTag>(0, planes, [&](std::size_t k) {
    plan.has_undefined ? plan_layer<true>(plan, k, choose) : plan_layer<false>(plan, k, choose);
  });
  plan.numbering.turn_counts_into_numbers();
  return plan;
}

} // namespace equiaffine::internal

#endif
