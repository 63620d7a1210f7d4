// SPDX-License-Identifier: GPL-3.0-or-later
// Fits to the vertices of a mesh or to points. A separate translation unit, compiled for size and in parallel.
#include "module.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/attributes/Fit_statistics.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/io/read_points.h>

#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

/// Fits the vertices of a mesh or points, given as the bytes of a file. A negative scale: choose it from the data.
EXPORTED int eq_annotate(const char* name, const char* bytes, int size, double scale, const char* attributes) {
  return outcome_of([&] {
    constexpr std::size_t most = 50000;
    surface = {};
    std::istringstream stream(std::string(bytes, std::size_t(size)));
    auto file = equiaffine::read_points<Kernel>(stream, name, name);
    if (file.mesh.points.size() > most)
      throw equiaffine::Input_error("'" + std::string(name) + "' has " + std::to_string(file.mesh.points.size()) +
                                    " points, but at most 50000 can be fitted here; use the program for more");
    const equiaffine::Fit_options options = {.scale = scale < 0 ? std::nullopt : std::optional(scale)};
    auto selection = equiaffine::select_attributes(attributes);
    selection.has_status = true;
    const auto areas = equiaffine::selected_vertex_areas(selection, file.mesh.points, file.mesh.triangles);
    const auto structures = file.mesh.triangles.empty()
                                ? equiaffine::fitted_structures(file.mesh.points, options)
                                : equiaffine::fitted_structures(file.mesh.points, file.mesh.triangles, options);
    surface.attributes = equiaffine::attributes_of_fit(structures, selection, areas);
    for (const auto& estimate : equiaffine::estimate_attributes())
      if (estimate.kind == equiaffine::Estimate_kind::ERROR)
        surface.attributes.columns.push_back(estimate.column(structures));
    static_cast<equiaffine::Indexed_triangle_mesh_3<Kernel>&>(surface.mesh) = std::move(file.mesh);
  });
}
