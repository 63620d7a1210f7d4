// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"

#include <equiaffine/base/internal/large_pages.h>
#include <equiaffine/base/internal/parallel_for.h>

#include <CGAL/tags.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <stdexcept>

namespace equiaffine::python {

namespace {

/// An array that takes over a vector and reinterprets its memory as elements of type T.
template <class T, class Element>
py::array_t<T> shared_array(std::vector<Element>&& values, std::vector<py::ssize_t> shape) {
  auto* const owner = new std::vector<Element>(std::move(values));
  const py::capsule free(owner, [](void* pointer) { delete static_cast<std::vector<Element>*>(pointer); });
  return py::array_t<T>(std::move(shape), reinterpret_cast<const T*>(owner->data()), free);
}

Lattice_3<Kernel> lattice_of(const py::array& samples, const py::array_t<double>& origin,
                             const py::array_t<double>& steps) {
  const auto o = origin.unchecked<1>();
  const auto s = steps.unchecked<2>();
  const auto step = [&](py::ssize_t k) { return Kernel::Vector_3(s(k, 0), s(k, 1), s(k, 2)); };
  return Lattice_3<Kernel>(
      {std::size_t(samples.shape(0)), std::size_t(samples.shape(1)), std::size_t(samples.shape(2))},
      Kernel::Point_3(o(0), o(1), o(2)), {step(0), step(1), step(2)});
}

/// Calls `use` with a zero of the type that has this numpy type character.
template <class Use>
auto with_type(char type, const Use& use) {
  switch (type) {
  case '?':
  case 'B': return use((unsigned char)(0));
  case 'b': return use((signed char)(0));
  case 'h': return use(short(0));
  case 'H': return use((unsigned short)(0));
  case 'i': return use(0);
  case 'I': return use(0U);
  case 'l': return use(0L);
  case 'L': return use(0UL);
  case 'q': return use(0LL);
  case 'Q': return use(0ULL);
  case 'f': return use(0.F);
  case 'd': return use(0.);
  default: throw std::invalid_argument("samples: give integers, float32 or float64");
  }
}

Volume_view_3<Kernel> view_of(const py::array& samples, const Lattice_3<Kernel>& lattice) {
  return with_type(samples.dtype().char_(), [&]<class Number>(Number) {
    return Volume_view_3<Kernel>(lattice, static_cast<const Number*>(samples.data()),
                                 {samples.strides(0), samples.strides(1), samples.strides(2)});
  });
}

} // namespace

Annotated_mesh_3<Kernel> mesh_of(const Points_array& points, const Faces_array& faces, const py::dict& columns,
                                 const std::optional<Status_array>& status, std::vector<std::string> comments) {
  Annotated_mesh_3<Kernel> result;
  const py::ssize_t size = points.shape(0);
  const double* const coordinates = points.data();
  result.mesh.points.reserve(std::size_t(size));
  for (py::ssize_t i = 0; i < 3 * size; i += 3)
    result.mesh.points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  const std::int64_t* const vertices = faces.data();
  result.mesh.triangles.resize(std::size_t(faces.shape(0)));
  for (std::size_t k = 0; k < 3 * result.mesh.triangles.size(); ++k) {
    if (vertices[k] < 0 || vertices[k] >= size)
      throw std::invalid_argument("F: face " + std::to_string(k / 3) + " refers to vertex " +
                                  std::to_string(vertices[k]) + ", but the number of vertices is " +
                                  std::to_string(size) + "; count vertices from 0");
    result.mesh.triangles[k / 3][k % 3] = std::uint32_t(vertices[k]);
  }
  const auto check_shape = [&](const std::string& name, const py::array& values) {
    if (values.ndim() != 1 || values.size() != size)
      throw std::invalid_argument(name + ": give one number for each of the " + std::to_string(size) +
                                  " vertices, not " + std::to_string(values.size()));
  };
  for (const auto& [name, given] : columns) {
    const auto values = py::cast<Points_array>(given);
    auto& column = result.attributes.columns.emplace_back();
    column.name = py::cast<std::string>(name);
    check_shape("attribute '" + column.name + "'", values);
    column.values.assign(values.data(), values.data() + size);
  }
  if (status) {
    check_shape("status", *status);
    auto& statuses = result.attributes.status.emplace();
    for (py::ssize_t i = 0; i < size; ++i) {
      const std::uint8_t number = status->data()[i];
      if (number >= number_of_point_statuses)
        throw std::invalid_argument("status: vertex " + std::to_string(i) + " has the invalid value " +
                                    std::to_string(number) + "; use values of Status");
      statuses.push_back(Point_status(number));
    }
  }
  result.attributes.comments = std::move(comments);
  return result;
}

Volume_array::Volume_array(py::array samples, const py::array_t<double>& origin, const py::array_t<double>& steps)
    : samples_(std::move(samples)), is_float_(samples_.dtype().char_() == 'f'),
      view_(view_of(samples_, lattice_of(samples_, origin, steps))) {}

py::dict columns_of(Vertex_attributes&& attributes) {
  py::dict columns;
  for (auto& column : attributes.columns) {
    const auto size = py::ssize_t(column.values.size());
    columns[py::str(column.name)] = shared_array<double>(std::move(column.values), {size});
  }
  py::object status = py::none();
  if (attributes.status) {
    const auto size = py::ssize_t(attributes.status->size());
    status = shared_array<std::uint8_t>(std::move(*attributes.status), {size});
  }
  py::dict result;
  result["columns"] = columns;
  result["status"] = status;
  result["comments"] = attributes.comments;
  return result;
}

py::dict arrays_of(Indexed_triangle_mesh_3<Kernel>&& mesh, Vertex_attributes&& attributes,
                   std::optional<double> scale) {
  py::dict result = columns_of(std::move(attributes));
  result["scale"] = scale;
  const auto vertices = py::ssize_t(mesh.points.size()), faces = py::ssize_t(mesh.triangles.size());
  static_assert(sizeof(Kernel::Point_3) == 3 * sizeof(double));
  result["V"] = shared_array<double>(std::move(mesh.points), {vertices, 3});
#ifdef __GLIBC__
  ::malloc_trim(0); // return freed memory to the system before the triangles are copied
#endif
  std::vector<std::int64_t> indices;
  resize_with_large_pages(indices, 3 * mesh.triangles.size());
  parallel_for<CGAL::Parallel_if_available_tag>(
      0, mesh.triangles.size(),
      [&](std::size_t t) { std::copy(mesh.triangles[t].begin(), mesh.triangles[t].end(), &indices[3 * t]); }, 4096);
  result["F"] = shared_array<std::int64_t>(std::move(indices), {faces, 3});
  return result;
}

py::dict arrays_of(Volume_3<Kernel>&& volume) {
  const auto& [nx, ny, nz] = volume.lattice.size();
  const auto& steps = volume.lattice.steps();
  const auto& origin = volume.lattice.origin();
  py::array_t<double> directions({3, 3});
  for (py::ssize_t k = 0; k < 3; ++k)
    for (py::ssize_t axis = 0; axis < 3; ++axis) directions.mutable_at(k, axis) = steps[std::size_t(k)][int(axis)];
  py::dict result;
  result["origin"] = std::vector<double>{origin.x(), origin.y(), origin.z()};
  result["steps"] = directions;
  result["values"] = shared_array<double>(std::move(volume.values), {py::ssize_t(nz), py::ssize_t(ny), py::ssize_t(nx)})
                         .attr("transpose")();
  return result;
}

} // namespace equiaffine::python
