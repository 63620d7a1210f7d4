// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_ATTRIBUTE_ARRAYS_H
#define EQUIAFFINE_BINDINGS_VTK_ATTRIBUTE_ARRAYS_H

#include "Doubt.h"
#include "Growing_array.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

class vtkDataSetAttributes;

namespace equiaffine {

/// Collects attributes of points block by block as arrays for VTK. A vector or a form becomes one array with named
/// components. Arrays of errors come last.
class Attribute_arrays {
public:
  explicit Attribute_arrays(const Attribute_selection& selection, const Error_rows& errors = {});

  /// Adds the points of a block that have these indices. The columns of the block are those of the selection, followed
  /// by the errors.
  void add(const Vertex_attributes& block, std::span<const std::size_t> places);

  /// Name and values of a scalar.
  struct Scalar {
    std::string name;
    std::span<const double> values;
  };
  std::vector<Scalar> scalars() const;

  bool has_status() const { return selection_.has_status; }                   ///< whether it was selected
  std::span<const unsigned char> status() const { return status_.numbers(); } ///< empty if it was not selected

  /// Transfers the arrays to VTK. Normals become the active normals.
  void move_to(vtkDataSetAttributes& data);

private:
  struct Array {
    std::string name;
    bool is_scalar;
    std::vector<std::size_t> columns; // of the selection, one per component
    Growing_array<double> numbers;
  };

  const Attribute_selection selection_;
  std::vector<Array> arrays_;
  Growing_array<unsigned char> status_;
};

} // namespace equiaffine

#endif
