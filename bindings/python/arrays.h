// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays of numpy as data of the library, and data of the library as arrays that share their memory.
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

/// Points, triangles, columns and statuses, copied from arrays: these may change while the library computes. Throws for
/// a triangle with a point that there is not, for columns and statuses of another length, and for a status that is
/// none.
Annotated_mesh_3<Kernel> mesh_of(const Points_array& points, const Faces_array& faces, const py::dict& columns,
                                 const std::optional<Status_array>& status, std::vector<std::string> comments);

/// Samples in an array of three dimensions of any numeric type in native byte order, with any strides, which it keeps
/// alive.
class Volume_array {
public:
  /// `steps` has the step along each axis of the array in its rows.
  Volume_array(py::array samples, const py::array_t<double>& origin, const py::array_t<double>& steps);

  /// The samples, where they are; needs no lock of the interpreter.
  const Volume_view_3<Kernel>& view() const { return view_; }

  /// Whether they are of single precision; needs no lock either.
  bool is_float() const { return is_float_; }

private:
  py::array samples_;
  bool is_float_;
  Volume_view_3<Kernel> view_;
};

/// {"columns": {name: array}, "status": array or None, "comments": [text]}
py::dict columns_of(Vertex_attributes&& attributes);

/// The same with "V" (n, 3), "F" (m, 3), and the "scale" of curvatures of a fit.
py::dict arrays_of(Indexed_triangle_mesh_3<Kernel>&& mesh, Vertex_attributes&& attributes, std::optional<double> scale);

/// {"values", "origin", "steps"}
py::dict arrays_of(Volume_3<Kernel>&& volume);

} // namespace equiaffine::python

#endif
