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

/// Attributes of points, added a block of points at a time, as arrays for VTK: a vector or a form is one array, whose
/// components have names. Errors have arrays after all others.
class Attribute_arrays {
public:
  explicit Attribute_arrays(const Attribute_selection& selection, const Error_rows& errors = {});

  /// Adds those points of a block whose places in it are given. Its columns are those of the selection, and then the
  /// errors.
  void add(const Vertex_attributes& block, std::span<const std::size_t> places);

  /// A scalar, by its name and its numbers.
  struct Scalar {
    std::string name;
    std::span<const double> values;
  };
  std::vector<Scalar> scalars() const;

  bool has_status() const { return selection_.has_status; }                   ///< whether it was selected
  std::span<const unsigned char> status() const { return status_.numbers(); } ///< empty if it was not selected

  /// Gives the arrays to VTK. Normals become the active ones.
  void move_to(vtkDataSetAttributes& data);

private:
  struct Array {
    std::string name;
    bool is_scalar;
    std::vector<std::size_t> columns; // of the selection, for the components
    Growing_array<double> numbers;
  };

  const Attribute_selection selection_;
  std::vector<Array> arrays_;
  Growing_array<unsigned char> status_;
};

} // namespace equiaffine

#endif
