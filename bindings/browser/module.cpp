// SPDX-License-Identifier: GPL-3.0-or-later
// The library as a WebAssembly module: C functions for equiaffine.mjs. The surface that a call computes stays in memory
// until the next call; JavaScript reads its arrays from there.
#include "sample.h"
#include <equiaffine/display/internal/Parabolic_parts.h>
#include <equiaffine/display/write_HTML.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>

#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace {

/// `names` is a sequence of `count` zero-terminated strings.
equiaffine::Expression_3 expression(const char* text, const char* names, const double* values, int count) {
  std::map<std::string, double> constants;
  for (int i = 0; i < count; ++i) {
    const std::string name(names);
    constants[name] = values[i];
    names += name.size() + 1;
  }
  return equiaffine::Expression_3(text, constants);
}

} // namespace

/// Meshes the level set of a formula in a box, xmin xmax ymin ymax zmin zmax, with `nodes` nodes along each axis, and
/// computes the attributes of a comma-separated list.
EXPORTED int eq_mesh(const char* text, const char* names, const double* values, int count, const double* box, int nodes,
                     double level, const char* attributes) {
  return outcome_of([&] {
    surface = {};
    const equiaffine::Level_set_traits_3 level_set(
        equiaffine::make_analytic_traits<Kernel>(expression(text, names, values, count),
                                                 CGAL::Bbox_3(box[0], box[2], box[4], box[1], box[3], box[5])),
        level);
    sample(level_set, attributes, {.resolution = nodes});
  });
}

/// Fails unless the formula is valid.
EXPORTED int eq_parse(const char* text, const char* names, const double* values, int count) {
  return outcome_of([&] { expression(text, names, values, count); });
}

/// Prepares the data of a page of the surface.
EXPORTED int eq_page() {
  return outcome_of([&] {
    namespace internal = equiaffine::internal;
    const auto center = internal::center_of(surface.mesh.points);
    const equiaffine::Parabolic_parts parabolic(surface.mesh.triangles, surface.attributes);
    const equiaffine::Numbers_of_mesh numbers(surface.mesh, surface.attributes);
    surface.facts = internal::page_facts(numbers, surface.attributes, equiaffine::Display_options(), center, parabolic);
    surface.floats.clear();
    surface.floats.reserve(surface.mesh.points.size() * (3 + surface.attributes.columns.size()));
    for (const auto& p : surface.mesh.points)
      for (int i = 0; i < 3; ++i) surface.floats.push_back(internal::nearest_float(p[i] - center[std::size_t(i)]));
    for (const auto& column : surface.attributes.columns)
      for (const double value : column.values) surface.floats.push_back(internal::nearest_float(value));
    surface.parts.clear();
    for (const equiaffine::Parabolic_part part : parabolic.parts()) surface.parts.push_back(std::uint8_t(part));
  });
}

EXPORTED const char* eq_message() { return failure.message.c_str(); }
EXPORTED const char* eq_excerpt() { return failure.excerpt.c_str(); }
EXPORTED const char* eq_unknown_name() { return failure.unknown_name.c_str(); }

/// Arrays of the surface for JavaScript; eq_data() returns their addresses and eq_size() their lengths.
enum Array { POSITIONS, TRIANGLES, STATUS, PARTS, POINTS, FIRST_COLUMN };
EXPORTED const void* eq_data(int array) {
  switch (array) {
  case POSITIONS: return surface.floats.data();
  case TRIANGLES: return surface.mesh.triangles.data();
  case STATUS: return surface.attributes.status ? surface.attributes.status->data() : nullptr;
  case PARTS: return surface.parts.data();
  case POINTS: static_assert(sizeof(Kernel::Point_3) == 3 * sizeof(double)); return surface.mesh.points.data();
  default: return surface.attributes.columns[std::size_t(array - FIRST_COLUMN)].values.data();
  }
}
EXPORTED int eq_size(int array) {
  switch (array) {
  case TRIANGLES: return int(surface.mesh.triangles.size());
  case STATUS: return surface.attributes.status ? int(surface.attributes.status->size()) : 0;
  case PARTS: return int(surface.parts.size());
  default: return int(surface.mesh.points.size());
  }
}
EXPORTED int eq_number_of_columns() { return int(surface.attributes.columns.size()); }
EXPORTED const char* eq_column_name(int i) { return surface.attributes.columns[std::size_t(i)].name.c_str(); }
EXPORTED const char* eq_facts() { return surface.facts.c_str(); }
