// SPDX-License-Identifier: GPL-3.0-or-later
#include "Attribute_arrays.h"

#include <equiaffine/base/internal/parallel_for.h>

#include <CGAL/tags.h>

#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace equiaffine {

Attribute_arrays::Attribute_arrays(const Attribute_selection& selection, const Error_rows& errors)
    : selection_(selection) {
  const auto& columns = selection.columns;
  for (std::size_t first = 0; first < columns.size();) {
    std::size_t end = first + 1;
    while (end < columns.size() && columns[end].row == columns[first].row) ++end;
    const auto& row = attribute_table<double>[columns[first].row];
    const bool is_whole = end - first == row.size() && // otherwise single components were selected by name
                          std::is_sorted(&columns[first], &columns[first] + row.size(),
                                         [](const auto& a, const auto& b) { return a.component < b.component; });
    if (!is_whole) end = first + 1;
    Array array = {std::string(is_whole ? row.name : columns[first].name), row.is_scalar(), {}, {}};
    for (; first < end; ++first) array.columns.push_back(first);
    arrays_.push_back(std::move(array));
  }
  for (std::size_t r = 0; r < errors.size(); ++r) arrays_.push_back({errors[r].name, false, {columns.size() + r}, {}});
}

void Attribute_arrays::add(const Vertex_attributes& block, std::span<const std::size_t> places) {
  parallel_for<CGAL::Parallel_if_available_tag>(0, arrays_.size(), [&](std::size_t a) {
    Array& array = arrays_[a];
    const std::size_t components = array.columns.size();
    const std::span<double> numbers = array.numbers.grow(components * places.size());
    for (std::size_t c = 0; c < components; ++c) {
      const std::vector<double>& values = block.columns[array.columns[c]].values;
      for (std::size_t n = 0; n < places.size(); ++n) numbers[n * components + c] = values[places[n]];
    }
  });
  if (!selection_.has_status) return;
  const std::span<unsigned char> status = status_.grow(places.size());
  for (std::size_t n = 0; n < places.size(); ++n) status[n] = static_cast<unsigned char>((*block.status)[places[n]]);
}

std::vector<Attribute_arrays::Scalar> Attribute_arrays::scalars() const {
  std::vector<Scalar> scalars;
  for (const Array& array : arrays_)
    if (array.is_scalar) scalars.push_back({array.name, array.numbers.numbers()});
  return scalars;
}

void Attribute_arrays::move_to(vtkDataSetAttributes& data) {
  for (Array& array : arrays_) {
    const vtkNew<vtkDoubleArray> numbers;
    numbers->SetName(array.name.c_str());
    numbers->SetNumberOfComponents(int(array.columns.size()));
    for (std::size_t c = 0; c < array.columns.size() && array.columns.size() > 1; ++c)
      numbers->SetComponentName(vtkIdType(c), std::string(selection_.columns[array.columns[c]].name).c_str());
    array.numbers.move_to(*numbers);
    data.AddArray(numbers);
    if (array.name == "normal") data.SetActiveNormals("normal");
  }
  if (!selection_.has_status) return;
  const vtkNew<vtkUnsignedCharArray> status;
  status->SetName("status");
  status_.move_to(*status);
  data.AddArray(status);
}

} // namespace equiaffine
