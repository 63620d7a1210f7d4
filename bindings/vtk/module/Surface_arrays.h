// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_SURFACE_ARRAYS_H
#define EQUIAFFINE_BINDINGS_VTK_SURFACE_ARRAYS_H

#include "Attribute_arrays.h"
#include "Doubt.h"
#include "Growing_array.h"
#include "Ranks.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/marching_cubes/marching_cubes_in_slabs.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/volume/Cell_block.h>

#include <CGAL/Simple_cartesian.h>

#include <vtkType.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <utility>
#include <vector>

class vtkFieldData;
class vtkPolyData;

namespace equiaffine {

/// Collects the slabs of the surfaces of a process's pieces as arrays for VTK.
class Surface_arrays {
public:
  using Kernel = CGAL::Simple_cartesian<double>;
  /// Computes the attributes of points, followed by the errors.
  using Compute = std::function<Vertex_attributes(std::span<const Kernel::Point_3>, std::span<const Point_status>)>;

  /// `own` are the blocks of cells of this process, and `nodes` the numbers of nodes of the lattice. Ghosts are marked
  /// if `has_ghost_points` or `has_ghost_cells`. The numbers of `rows` have errors unless UNTESTED.
  Surface_arrays(const Attribute_selection& selection, const Error_rows& rows, Doubtful doubtful,
                 std::vector<Cell_block> own, const std::array<std::size_t, 3>& nodes, bool has_ghost_points,
                 bool has_ghost_cells)
      : own_(std::move(own)), nodes_(nodes), has_ghost_points_(has_ghost_points), has_ghost_cells_(has_ghost_cells),
        attributes_(selection, doubtful == Doubtful::UNTESTED ? Error_rows() : rows), doubt_(rows, doubtful) {}

  /// Starts the surface of the next piece. Pieces of one process share their vertices.
  void begin_piece();

  /// Adds the next slab of the piece.
  void add(const Isosurface_slab_3<Kernel>& slab, const Compute& compute);

  /// Summary of the surfaces of all processes.
  struct Summary {
    std::int64_t vertices;
    Doubt::Verdict verdict;
  };

  /// Adds counts and ranges over all processes to the field data.
  Summary add_statistics(const Ranks& ranks, vtkFieldData& data) const;

  /// Transfers the surface to a vtkPolyData.
  void move_to(vtkPolyData& output);

private:
  /// Whether the vertex or the triangle with this least id belongs to this process.
  bool is_own(Vertex_id least_id) const;

  /// Numbers the vertices of a slab, and returns the indices of those that no previous piece contains.
  std::vector<std::size_t> new_vertices(const Isosurface_slab_3<Kernel>& slab);

  const std::vector<Cell_block> own_;
  const std::array<std::size_t, 3> nodes_;
  const bool has_ghost_points_, has_ghost_cells_;
  std::size_t pieces_ = 0;
  std::vector<std::int32_t> numbers_; // for each vertex of a later piece, its number among those of the process
  std::unordered_map<Vertex_id, std::int32_t> number_of_; // number of each vertex, if there are several pieces
  std::size_t vertices_ = 0;
  Growing_array<double> points_;
  Growing_array<vtkIdType> ids_;
  Growing_array<std::int32_t> triangles_;
  Growing_array<unsigned char> ghost_points_, ghost_cells_;
  Attribute_arrays attributes_;
  Doubt doubt_;
};

} // namespace equiaffine

#endif
