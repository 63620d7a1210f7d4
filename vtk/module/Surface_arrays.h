// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VTK_SURFACE_ARRAYS_H
#define EQUIAFFINE_VTK_SURFACE_ARRAYS_H

#include "Ranks.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/marching_cubes/Isosurface_slab_3.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>
#include <equiaffine/volume/Cell_block.h>

#include <CGAL/Simple_cartesian.h>

#include <vtkType.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

class vtkDataSetAttributes;
class vtkFieldData;
class vtkPolyData;

namespace equiaffine {

/// Adds columns of numbers as arrays: those of the components of a vector or form are one array. The columns are given
/// up one after the other, so that no two copies of all of them exist.
void add_arrays(const Attribute_selection& selection, std::vector<std::vector<std::vector<double>>>&& blocks_of_columns,
                vtkDataSetAttributes& data);

/// Gathers the slabs of the surfaces of the pieces of a process and makes arrays of them. The slabs stay as they are until
/// then, and are given up array by array.
class Surface_arrays {
public:
  using Kernel = CGAL::Simple_cartesian<double>;

  /// The blocks of cells belong to this process, and the lattice has so many nodes. Ghosts are marked if there may be some.
  Surface_arrays(const Attribute_selection& selection, std::vector<Cell_block> own,
                 const std::array<std::size_t, 3>& nodes, bool has_ghost_points, bool has_ghost_cells)
      : selection_(selection), own_(std::move(own)), nodes_(nodes), has_ghost_points_(has_ghost_points),
        has_ghost_cells_(has_ghost_cells), columns_(selection.columns.size()) {}

  /// Begins the surface of another piece. Pieces of one process share their vertices.
  void begin_piece();

  /// Adds the next slab of the piece with the attributes of its points.
  void add(const Isosurface_slab_3<Kernel>& slab, Vertex_attributes&& attributes);

  /// Adds what the surfaces of all processes have in common: numbers and ranges. Returns the number of all vertices.
  std::int64_t add_statistics(const Ranks& ranks, vtkFieldData& data) const;

  /// Gives the surface to a vtkPolyData.
  void move_to(vtkPolyData& output) &&;

private:
  /// Whether the vertex or the triangle with that least id belongs to this process.
  bool is_own(Vertex_id least_id) const;

  const Attribute_selection selection_;
  const std::vector<Cell_block> own_;
  const std::array<std::size_t, 3> nodes_;
  const bool has_ghost_points_, has_ghost_cells_;
  std::size_t pieces_ = 0;
  /// A vertex of a piece.
  struct Vertex {
    Vertex_id id;
    std::int32_t number; ///< among all vertices of the process
  };
  std::vector<Vertex> of_piece_;
  std::unordered_map<Vertex_id, std::int32_t> number_of_; // if there are several pieces
  std::vector<std::vector<Kernel::Point_3>> points_;      // of each slab, as what follows
  std::vector<std::vector<vtkIdType>> ids_;
  std::vector<std::vector<unsigned char>> status_, ghost_points_, ghost_cells_;
  std::vector<std::vector<std::array<std::int32_t, 3>>> triangles_;
  std::vector<std::vector<std::vector<double>>> columns_; // of each column
  std::size_t vertices_ = 0;
};

} // namespace equiaffine

#endif
