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
#include <stdexcept>
#include <string>
#include <utility>

namespace equiaffine {

namespace {

template <class T>
std::size_t size_of(const std::vector<std::vector<T>>& blocks) {
  std::size_t size = 0;
  for (const auto& block : blocks) size += block.size();
  return size;
}

/// Moves blocks of numbers into an array, and frees each of them.
template <class Array, class T>
void fill(Array& array, const char* name, std::vector<std::vector<T>>&& blocks) {
  array.SetName(name);
  auto* to = array.WritePointer(0, vtkIdType(size_of(blocks)));
  for (auto& block : blocks) {
    to = std::copy(block.begin(), block.end(), to);
    block = {};
  }
}

void add_numbers(vtkFieldData& data, const std::string& name, std::span<const std::int64_t> numbers) {
  const vtkNew<vtkIdTypeArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(int(numbers.size()));
  array->InsertNextTuple(std::vector<double>(numbers.begin(), numbers.end()).data());
  data.AddArray(array);
}

} // namespace

void add_arrays(const Attribute_selection& selection, std::vector<std::vector<std::vector<double>>>&& blocks_of_columns,
                vtkDataSetAttributes& data) {
  const auto& columns = selection.columns;
  for (std::size_t first = 0; first < columns.size();) {
    std::size_t end = first + 1;
    while (end < columns.size() && columns[end].row == columns[first].row) ++end;
    const auto& row = attribute_table<double>[columns[first].row];
    const bool is_whole = end - first == row.size(); // else a component was asked for by its own name
    if (!is_whole) end = first + 1;
    const vtkNew<vtkDoubleArray> array;
    array->SetName(std::string(is_whole ? row.name : columns[first].name).c_str());
    array->SetNumberOfComponents(int(end - first));
    array->SetNumberOfTuples(vtkIdType(size_of(blocks_of_columns[first])));
    for (std::size_t c = first; c < end; ++c) {
      if (end - first > 1) array->SetComponentName(vtkIdType(c - first), std::string(columns[c].name).c_str());
      double* to = array->GetPointer(vtkIdType(c - first));
      for (auto& block : blocks_of_columns[c]) {
        for (const double x : block) {
          *to = x;
          to += end - first;
        }
        block = {};
      }
    }
    data.AddArray(array);
    first = end;
  }
  if (data.HasArray("normal")) data.SetActiveNormals("normal");
}

bool Surface_arrays::is_own(Vertex_id least_id) const {
  const auto cell = cell_of(least_id, nodes_);
  return std::any_of(own_.begin(), own_.end(), [&](const Cell_block& cells) { return cells.contains(cell); });
}

void Surface_arrays::begin_piece() {
  of_piece_.clear();
  if (++pieces_ != 2) return;
  std::int32_t number = 0; // from now on vertices are looked up
  for (const auto& block : ids_)
    for (const vtkIdType id : block) number_of_.emplace(Vertex_id(id), number++);
}

void Surface_arrays::add(const Isosurface_slab_3<Kernel>& slab, Vertex_attributes&& attributes) {
  const std::size_t n = slab.points.size();
  if (vertices_ + n > std::size_t(std::numeric_limits<std::int32_t>::max()))
    throw std::length_error("a piece of the surface has more than 2^31 vertices; use more processes");
  std::vector<std::size_t> added; // the vertices that no piece before has
  for (std::size_t v = 0; v < n; ++v) {
    const Vertex_id id = slab.vertex_ids[v];
    const auto next = std::int32_t(vertices_ + added.size());
    const bool is_known = pieces_ > 1 && !number_of_.try_emplace(id, next).second;
    of_piece_.push_back({id, is_known ? number_of_.at(id) : next});
    if (!is_known) added.push_back(v);
  }
  const auto keep = [&](auto& blocks, auto&& values) {
    if (added.size() < values.size()) {
      for (std::size_t v = 0; v < added.size(); ++v) values[v] = values[added[v]];
      values.resize(added.size());
    }
    blocks.push_back(std::move(values));
  };
  std::vector<unsigned char> ghosts, status;
  for (const Vertex_id id : slab.least_ids) ghosts.push_back(is_own(id) ? 0 : vtkDataSetAttributes::DUPLICATEPOINT);
  if (attributes.status)
    for (const Point_status s : *attributes.status) status.push_back(static_cast<unsigned char>(s));
  keep(points_, std::vector(slab.points));
  keep(ids_, std::vector<vtkIdType>(slab.vertex_ids.begin(), slab.vertex_ids.end()));
  keep(ghost_points_, std::move(ghosts));
  if (attributes.status) keep(status_, std::move(status));
  for (std::size_t c = 0; c < columns_.size(); ++c) keep(columns_[c], std::move(attributes.columns[c].values));
  vertices_ += added.size();

  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<unsigned char> ghost_cells;
  triangles.reserve(slab.triangles.size());
  for (const auto& [a, b, c] : slab.triangles) {
    const Vertex u = of_piece_[a], v = of_piece_[b], w = of_piece_[c];
    triangles.push_back({u.number, v.number, w.number});
    if (has_ghost_cells_)
      ghost_cells.push_back(is_own(std::min({u.id, v.id, w.id})) ? 0 : vtkDataSetAttributes::DUPLICATECELL);
  }
  triangles_.push_back(std::move(triangles));
  ghost_cells_.push_back(std::move(ghost_cells));
}

std::int64_t Surface_arrays::add_statistics(const Ranks& ranks, vtkFieldData& data) const {
  constexpr std::size_t statuses = number_of_point_statuses;
  std::array<std::int64_t, 2 + statuses> counts{}; // vertices, triangles, and of each status
  std::vector<double> least(columns_.size(), std::numeric_limits<double>::infinity()), greatest = least;
  for (double& x : greatest) x = -x;
  for (std::size_t block = 0; block < points_.size(); ++block) {
    const auto& is_ghost = ghost_points_[block];
    for (std::size_t v = 0; v < is_ghost.size(); ++v) {
      if (is_ghost[v]) continue;
      ++counts[0];
      if (!status_.empty()) ++counts[2 + status_[block][v]];
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        const double x = columns_[c][block][v];
        least[c] = std::fmin(least[c], x); // leaves NaN out
        greatest[c] = std::fmax(greatest[c], x);
      }
    }
    const auto& ghosts = ghost_cells_[block];
    counts[1] +=
        has_ghost_cells_ ? std::count(ghosts.begin(), ghosts.end(), 0) : std::int64_t(triangles_[block].size());
  }
  ranks.sum(counts);
  ranks.least(least);
  ranks.greatest(greatest);
  const std::span<const std::int64_t> numbers(counts);
  add_numbers(data, "vertices", numbers.first(1));
  add_numbers(data, "triangles", numbers.subspan(1, 1));
  if (selection_.has_status) add_numbers(data, "status_counts", numbers.subspan(2));
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (!attribute_table<double>[selection_.columns[c].row].is_scalar()) continue;
    const bool exists = least[c] <= greatest[c];
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const vtkNew<vtkDoubleArray> range;
    range->SetName((std::string(selection_.columns[c].name) + "_range").c_str());
    range->SetNumberOfComponents(2);
    range->InsertNextTuple2(exists ? least[c] : nan, exists ? greatest[c] : nan);
    data.AddArray(range);
  }
  return counts[0];
}

void Surface_arrays::move_to(vtkPolyData& output) && {
  const vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(vtkIdType(vertices_));
  double* to = coordinates->GetPointer(0);
  for (auto& block : points_) {
    for (const Kernel::Point_3& p : block)
      for (int c = 0; c < 3; ++c) *to++ = p[c];
    block = {};
  }
  const vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  output.SetPoints(points);

  const auto triangles = vtkIdType(size_of(triangles_));
  const vtkNew<vtkTypeInt32Array> offsets, connectivity;
  std::int32_t* vertex = connectivity->WritePointer(0, 3 * triangles);
  for (auto& block : triangles_) {
    for (const auto& triangle : block) vertex = std::copy(triangle.begin(), triangle.end(), vertex);
    block = {};
  }
  std::int32_t* const offset = offsets->WritePointer(0, triangles + 1);
  for (vtkIdType t = 0; t <= triangles; ++t) offset[t] = std::int32_t(3 * t);
  const vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  output.SetPolys(cells);

  vtkPointData& data = *output.GetPointData();
  const vtkNew<vtkIdTypeArray> ids;
  fill(*ids, "vertex_id", std::move(ids_));
  data.SetGlobalIds(ids);
  add_arrays(selection_, std::move(columns_), data);
  const auto add_bytes = [](vtkDataSetAttributes& attributes, const char* name, auto&& blocks) {
    const vtkNew<vtkUnsignedCharArray> array;
    fill(*array, name, std::move(blocks));
    attributes.AddArray(array);
  };
  if (selection_.has_status) add_bytes(data, "status", status_);
  if (has_ghost_points_) add_bytes(data, vtkDataSetAttributes::GhostArrayName(), ghost_points_);
  if (has_ghost_cells_) add_bytes(*output.GetCellData(), vtkDataSetAttributes::GhostArrayName(), ghost_cells_);
}

} // namespace equiaffine
