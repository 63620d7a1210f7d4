// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface_arrays.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace equiaffine {

namespace {

void add_counts(vtkFieldData& data, const char* name, std::span<const std::int64_t> counts) {
  const vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(int(counts.size()));
  for (const std::int64_t n : counts) array->InsertNextValue(n);
  data.AddArray(array);
}

void add_marks(vtkDataSetAttributes& data, Growing_array<unsigned char>& marks) {
  const vtkNew<vtkUnsignedCharArray> array;
  array->SetName(vtkDataSetAttributes::GhostArrayName());
  marks.move_to(*array);
  data.AddArray(array);
}

} // namespace

bool Surface_arrays::is_own(Vertex_id least_id) const {
  const auto cell = cell_of(least_id, nodes_);
  return std::any_of(own_.begin(), own_.end(), [&](const Cell_block& cells) { return cells.contains(cell); });
}

void Surface_arrays::begin_piece() {
  numbers_.clear();
  if (++pieces_ != 2) return;
  std::int32_t number = 0; // vertices are looked up from the second piece on
  for (const vtkIdType id : ids_.numbers()) number_of_.emplace(Vertex_id(id), number++);
}

std::vector<std::size_t> Surface_arrays::new_vertices(const Isosurface_slab_3<Kernel>& slab) {
  std::vector<std::size_t> places;
  for (std::size_t v = 0; v < slab.points.size(); ++v) {
    bool is_new = true;
    if (pieces_ > 1) {
      const auto next = std::int32_t(vertices_ + places.size());
      const auto [found, is_inserted] = number_of_.try_emplace(slab.vertex_ids[v], next);
      numbers_.push_back(found->second);
      is_new = is_inserted;
    }
    if (is_new) places.push_back(v);
  }
  return places;
}

void Surface_arrays::add(const Isosurface_slab_3<Kernel>& slab, const Compute& compute) {
  if (triangles_.numbers().size() + 3 * slab.triangles.size() > std::size_t(std::numeric_limits<std::int32_t>::max()))
    throw std::length_error("a piece of the surface has more than 715 million triangles; use more processes");
  const std::vector<std::size_t> places = new_vertices(slab);
  constexpr std::size_t most = std::size_t(1) << 16; // number of vertices whose attributes are in memory twice
  for (std::size_t first = 0; first < places.size(); first += most) {
    const auto some = std::span(places).subspan(first, std::min(most, places.size() - first));
    std::vector<Kernel::Point_3> points;
    std::vector<Point_status> status;
    std::vector<std::size_t> order;
    const std::span<vtkIdType> ids = ids_.grow(some.size());
    const std::span<unsigned char> ghosts = ghost_points_.grow(some.size());
    const std::span<double> coordinates = points_.grow(3 * some.size());
    for (std::size_t n = 0; n < some.size(); ++n) {
      const std::size_t v = some[n];
      points.push_back(slab.points[v]);
      status.push_back(slab.vertex_status[v]);
      order.push_back(n);
      ids[n] = vtkIdType(slab.vertex_ids[v]);
      ghosts[n] = is_own(slab.least_ids[v]) ? 0 : vtkDataSetAttributes::DUPLICATEPOINT;
      for (int c = 0; c < 3; ++c) coordinates[3 * n + std::size_t(c)] = slab.points[v][c];
    }
    Vertex_attributes block = compute(points, status);
    doubt_.add(block, ghosts);
    attributes_.add(block, order);
  }
  vertices_ += places.size();

  const std::span<std::int32_t> corners = triangles_.grow(3 * slab.triangles.size());
  for (std::size_t t = 0; t < slab.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t v = slab.triangles[t][c];
      corners[3 * t + c] = pieces_ > 1 ? numbers_[v] : std::int32_t(v);
    }
  if (!has_ghost_cells_) return;
  const std::span<unsigned char> ghosts = ghost_cells_.grow(slab.triangles.size());
  for (std::size_t t = 0; t < ghosts.size(); ++t) {
    const auto id = [&](std::size_t c) { return Vertex_id(ids_.numbers()[std::size_t(corners[3 * t + c])]); };
    ghosts[t] = is_own(std::min({id(0), id(1), id(2)})) ? 0 : vtkDataSetAttributes::DUPLICATECELL;
  }
}

Surface_arrays::Summary Surface_arrays::add_statistics(const Ranks& ranks, vtkFieldData& data) const {
  std::array<std::int64_t, 2 + number_of_point_statuses> counts{}; // vertices, triangles, vertices of each status
  const auto scalars = attributes_.scalars();
  std::vector<double> least(scalars.size(), std::numeric_limits<double>::infinity()), greatest = least;
  for (double& x : greatest) x = -x;
  const auto ghosts = ghost_points_.numbers();
  for (std::size_t v = 0; v < ghosts.size(); ++v) {
    if (ghosts[v]) continue;
    ++counts[0];
    if (!attributes_.status().empty()) ++counts[2 + attributes_.status()[v]];
    for (std::size_t s = 0; s < scalars.size(); ++s) {
      least[s] = std::fmin(least[s], scalars[s].values[v]); // ignores NaN
      greatest[s] = std::fmax(greatest[s], scalars[s].values[v]);
    }
  }
  const auto ghost_cells = ghost_cells_.numbers();
  counts[1] = has_ghost_cells_ ? std::count(ghost_cells.begin(), ghost_cells.end(), 0)
                               : std::int64_t(triangles_.numbers().size() / 3);
  ranks.sum(counts);
  ranks.least(least);
  ranks.greatest(greatest);
  const std::span<const std::int64_t> all(counts);
  add_counts(data, "vertices", all.first(1));
  add_counts(data, "triangles", all.subspan(1, 1));
  if (attributes_.has_status()) add_counts(data, "status_counts", all.subspan(2));
  std::vector<std::string> names; // scalars with at least one number
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    const bool exists = least[s] <= greatest[s];
    if (exists) names.push_back(scalars[s].name);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const vtkNew<vtkDoubleArray> range;
    range->SetName((scalars[s].name + "_range").c_str());
    range->SetNumberOfComponents(2);
    range->InsertNextTuple2(exists ? least[s] : nan, exists ? greatest[s] : nan);
    data.AddArray(range);
  }
  return {counts[0], doubt_.verdict(ranks, names, attributes_.has_status())};
}

void Surface_arrays::move_to(vtkPolyData& output) {
  const vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  points_.move_to(*coordinates);
  const vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  output.SetPoints(points);

  const vtkNew<vtkTypeInt32Array> offsets, connectivity;
  const auto triangles = vtkIdType(triangles_.numbers().size() / 3);
  triangles_.move_to(*connectivity);
  std::int32_t* const offset = offsets->WritePointer(0, triangles + 1);
  for (vtkIdType t = 0; t <= triangles; ++t) offset[t] = std::int32_t(3 * t);
  const vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  output.SetPolys(cells);

  vtkPointData& data = *output.GetPointData();
  const vtkNew<vtkIdTypeArray> ids;
  ids->SetName("vertex_id");
  ids_.move_to(*ids);
  data.SetGlobalIds(ids);
  attributes_.move_to(data);
  if (has_ghost_points_) add_marks(data, ghost_points_);
  if (has_ghost_cells_) add_marks(*output.GetCellData(), ghost_cells_);
}

} // namespace equiaffine
