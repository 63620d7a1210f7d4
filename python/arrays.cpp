// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace equiaffine::python {

namespace {

/// The array whose numbers are those of a vector of another type with the same memory, which it owns.
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

/// Calls `use(number)` with a number of the type that numpy has that letter for.
template <class Use>
void with_type(char type, const Use& use) {
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
  default: throw std::invalid_argument("the samples have another type than integers, float32 and float64");
  }
}

} // namespace

Points_view::Points_view(Points_array points, Faces_array faces, const py::dict& columns,
                         std::optional<Status_array> status)
    : points_(std::move(points)), faces_(std::move(faces)), status_(std::move(status)) {
  const py::ssize_t size = points_.shape(0);
  const std::int64_t* const begin = faces_.data();
  const std::int64_t* const end = begin + faces_.size();
  const auto* const wrong = std::find_if(begin, end, [&](std::int64_t v) { return v < 0 || v >= size; });
  if (wrong != end)
    throw std::invalid_argument("face " + std::to_string((wrong - begin) / 3) + " has the vertex " +
                                std::to_string(*wrong) + ", and there are " + std::to_string(size));
  for (const auto& [name, values] : columns) {
    columns_.emplace_back(py::cast<std::string>(name), py::cast<Points_array>(values));
    if (columns_.back().second.size() != size)
      throw std::invalid_argument("the attribute '" + columns_.back().first + "' has " +
                                  std::to_string(columns_.back().second.size()) + " numbers for " +
                                  std::to_string(size) + " vertices");
  }
}

Annotated_mesh_3<Kernel> Points_view::mesh() const {
  Annotated_mesh_3<Kernel> result;
  const double* const points = points_.data();
  const std::int64_t* const faces = faces_.data();
  for (py::ssize_t i = 0; i < points_.size(); i += 3)
    result.mesh.points.emplace_back(points[i], points[i + 1], points[i + 2]);
  for (py::ssize_t k = 0; k < faces_.size(); k += 3)
    result.mesh.triangles.push_back(
        {std::uint32_t(faces[k]), std::uint32_t(faces[k + 1]), std::uint32_t(faces[k + 2])});
  for (const auto& [name, values] : columns_)
    result.attributes.columns.push_back({name, {values.data(), values.data() + values.size()}});
  if (status_) {
    auto& status = result.attributes.status.emplace();
    for (py::ssize_t i = 0; i < status_->size(); ++i) status.push_back(Point_status(status_->data()[i]));
  }
  return result;
}

Volume_view::Volume_view(py::array samples, py::array_t<double> origin, py::array_t<double> steps)
    : samples_(std::move(samples)), lattice_(lattice_of(samples_, origin, steps)), type_(samples_.dtype().char_()) {
  with_type(type_, [](auto) {});
}

Volume_3<Kernel> Volume_view::volume() const {
  Volume_3<Kernel> result{lattice_, {}};
  result.values.resize(lattice_.number_of_nodes());
  const auto* const data = static_cast<const char*>(samples_.data());
  const py::ssize_t *const n = samples_.shape(), *const stride = samples_.strides();
  with_type(type_, [&]<class T>(T) {
    double* out = result.values.data();
    for (py::ssize_t k = 0; k < n[2]; ++k)
      for (py::ssize_t j = 0; j < n[1]; ++j)
        for (py::ssize_t i = 0; i < n[0]; ++i) {
          T number;
          std::memcpy(&number, data + i * stride[0] + j * stride[1] + k * stride[2], sizeof(T));
          *out++ = double(number);
        }
  });
  return result;
}

py::array array_of(std::vector<double>&& values) {
  const auto size = py::ssize_t(values.size());
  return shared_array<double>(std::move(values), {size});
}

py::dict columns_of(Vertex_attributes&& attributes) {
  py::dict columns;
  for (auto& column : attributes.columns) columns[py::str(column.name)] = array_of(std::move(column.values));
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

py::dict arrays_of(Indexed_triangle_mesh_3<Kernel>&& mesh, Vertex_attributes&& attributes) {
  py::dict result = columns_of(std::move(attributes));
  const auto vertices = py::ssize_t(mesh.points.size()), faces = py::ssize_t(mesh.triangles.size());
  static_assert(sizeof(Kernel::Point_3) == 3 * sizeof(double));
  result["V"] = shared_array<double>(std::move(mesh.points), {vertices, 3});
  py::array_t<std::int64_t> triangles({faces, py::ssize_t(3)});
  std::int64_t* out = triangles.mutable_data();
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) *out++ = v;
  result["F"] = triangles;
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
