// SPDX-License-Identifier: GPL-3.0-or-later
// Fits to the vertices of a mesh, or to points: a unit of its own, which is compiled beside the other one, and to be
// smaller.
#include "module.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/attributes/internal/error_table.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/io/read_points.h>

#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

/// The columns of structures: those of a list, then estimates of the errors.
equiaffine::Vertex_attributes columns_of(const std::vector<equiaffine::Fitted_structure_3<double>>& structures,
                                         const char* attributes) {
  equiaffine::Vertex_attributes result;
  result.status.emplace();
  for (const auto& s : structures) result.status->push_back(s.structure.status);
  const auto add = [&](std::string name, const auto& number_of) {
    auto& column = result.columns.emplace_back();
    column.name = std::move(name);
    for (const auto& s : structures) column.values.push_back(number_of(s));
  };
  for (const auto& attribute : equiaffine::select_attributes(attributes).columns)
    add(std::string(attribute.name), [&](const auto& s) { return attribute.get(s.structure); });
  for (const auto& row : equiaffine::error_table<double>)
    add(std::string(row.attribute) + "_error", [&](const auto& s) { return row.get(s.error); });
  return result;
}

} // namespace

/// Fits the vertices of a mesh, or points, in the bytes of a file; a negative scale lets the data choose one.
EXPORTED int eq_annotate(const char* name, const char* bytes, int size, double scale, const char* attributes) {
  return outcome_of([&] {
    constexpr std::size_t most = 50000;
    surface = {};
    std::istringstream stream(std::string(bytes, std::size_t(size)));
    auto file = equiaffine::read_points<Kernel>(stream, name, name);
    if (file.mesh.points.size() > most)
      throw equiaffine::Input_error("'" + std::string(name) + "' has " + std::to_string(file.mesh.points.size()) +
                                    " points: here up to 50000 can be fitted, and any number by the program");
    const equiaffine::Fit_options options = {.scale = scale < 0 ? std::nullopt : std::optional(scale)};
    surface.attributes = columns_of(file.mesh.triangles.empty()
                                        ? equiaffine::fitted_structures(file.mesh.points, options)
                                        : equiaffine::fitted_structures(file.mesh.points, file.mesh.triangles, options),
                                    attributes);
    static_cast<equiaffine::Indexed_triangle_mesh_3<Kernel>&>(surface.mesh) = std::move(file.mesh);
  });
}
