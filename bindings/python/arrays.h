// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of numpy arrays to data of the library, and back without copying.
#ifndef EQUIAFFINE_BINDINGS_PYTHON_ARRAYS_H
#define EQUIAFFINE_BINDINGS_PYTHON_ARRAYS_H

#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/volume/Volume_3.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::python {

namespace py = pybind11;

using Points_array = py::array_t<double, py::array::c_style>;
using Faces_array = py::array_t<std::int64_t, py::array::c_style>;
using Status_array = py::array_t<std::uint8_t, py::array::c_style>;

/// A mesh with copies of the arrays, which may change while the library computes. Throws `std::invalid_argument` for an
/// index of a vertex that does not exist, for a column or status array of the wrong length, and for an invalid status.
Annotated_mesh_3<Kernel> mesh_of(const Points_array& points, const Faces_array& faces, const py::dict& columns,
                                 const std::optional<Status_array>& status, std::vector<std::string> comments);

/// Samples in a three-dimensional array, which it keeps alive: integers, float32 or float64 in native byte order, with
/// any strides.
class Volume_array {
public:
  /// The rows of `steps` are the steps along the axes of the array.
  Volume_array(py::array samples, const py::array_t<double>& origin, const py::array_t<double>& steps);

  /// The samples, not copied. Does not need the GIL.
  const Volume_view_3<Kernel>& view() const { return view_; }

  /// Whether the samples are float32. Does not need the GIL.
  bool is_float() const { return is_float_; }

private:
  py::array samples_;
  bool is_float_;
  Volume_view_3<Kernel> view_;
};

/// {"columns": {name: array}, "status": array or None, "comments": [text]}
py::dict columns_of(Vertex_attributes&& attributes);

/// In addition "V" (n, 3), "F" (m, 3), and "scale", that of the curvatures of a fit.
py::dict arrays_of(Indexed_triangle_mesh_3<Kernel>&& mesh, Vertex_attributes&& attributes, std::optional<double> scale);

/// {"values", "origin", "steps"}
py::dict arrays_of(Volume_3<Kernel>&& volume);

} // namespace equiaffine::python

#endif
