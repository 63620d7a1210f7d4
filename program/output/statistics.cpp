// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/statistics.h"

#include "output/json_text.h"
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/io/read_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string_view>
#include <utility>

namespace equiaffine {

std::array<std::size_t, number_of_point_statuses> count(std::span<const Point_status> status) {
  std::array<std::size_t, number_of_point_statuses> counts{};
  for (const Point_status s : status) ++counts[static_cast<std::size_t>(s)];
  return counts;
}

std::string left_out_text(const Mesh_facts& facts) {
  const std::size_t n = facts.components_left_out;
  if (n == 0) return "";
  return ", " + std::to_string(n) + (n == 1 ? " smaller one" : " smaller ones") + " left out";
}

namespace {

long percent(double part) { return std::lround(100 * part); }

const char* name_of(Spline_scheme scheme) {
  switch (scheme) {
  case Spline_scheme::CONVOLUTION: return "convolution";
  case Spline_scheme::QUASI_INTERPOLATION: return "quasi-interpolation";
  case Spline_scheme::INTERPOLATION: return "interpolation";
  default: return "paper";
  }
}

void add(const Mesh_facts& facts, Json& json) {
  json["vertices"] = facts.vertices;
  json["faces"] = facts.faces;
  json["components"] = facts.topology.components;
  json["euler_characteristic"] = facts.topology.euler_characteristic;
  json["boundary_edges"] = facts.topology.boundary_edges;
  json["manifold"] = facts.topology.is_manifold;
  for (std::size_t i = 0; i < number_of_point_statuses; ++i)
    json["status"][std::string(to_string(Point_status(i)))] = facts.status[i];
}

void add(const Fit_statistics& fit, Json& json) {
  const auto& [least, median, greatest] = fit.scales;
  json["fit"] = {{"scale", fit.scale ? Json(*fit.scale) : Json()},
                 {"scales", {{"least", least}, {"median", median}, {"greatest", greatest}}},
                 {"noise", fit.noise},
                 {"below_10", fit.known[0][0]},
                 {"below_20", fit.known[0][1]},
                 {"below_50", fit.known[0][2]}};
  for (std::size_t row = 0; row < fit.known.size(); ++row) {
    const auto& [to_10, to_20, to_50] = fit.known[row];
    json["fit"]["known"][std::string(rows_with_error[row]->name)] = {
        {"below_10", to_10},
        {"below_20", to_20},
        {"below_50", to_50},
        {"part_of", rows_with_error[row]->error.name_of_size}};
  }
}

void add_topology(const Mesh_facts& facts, std::ostream& text) {
  text << facts.vertices << " vertices, " << facts.faces << " triangles, " << facts.topology.components
       << (facts.topology.components == 1 ? " component" : " components") << left_out_text(facts)
       << ", Euler characteristic " << facts.topology.euler_characteristic << ", ";
  if (!facts.topology.is_manifold) text << "not a manifold, ";
  if (facts.topology.boundary_edges == 0) text << "closed\n";
  else text << facts.topology.boundary_edges << " boundary edges\n";
}

void add_status(const Mesh_facts& facts, std::ostream& text) {
  const char* separator = "status: ";
  for (std::size_t i = 0; i < number_of_point_statuses; ++i) {
    if (facts.status[i] == 0) continue;
    text << separator << facts.status[i] << ' ' << to_string(Point_status(i));
    separator = ", ";
  }
  text << '\n';
}

/// The names and symbols of `affine_quantities`.
struct Words {
  std::string_view label, symbol;
};
constexpr std::array<Words, affine_quantities.size()> words_of_quantities = {
    {{"affine Gaussian curvature", "K"},
     {"affine mean curvature", "H"},
     {"Pick invariant", "J"},
     {"affine normal", "affine normal"},
     {"affine area density", "affine area density"}}};

void add_fit(const Fit_statistics& fit, std::ostream& text) {
  text.precision(3);
  if (fit.scale) {
    const std::string_view first = first_known(fit);
    const auto place = std::find(affine_quantities.begin(), affine_quantities.end(), first) - affine_quantities.begin();
    const auto& [to_10, to_20, to_50] = fit.known_of(first);
    text << "at scale " << *fit.scale << ": error of the " << words_of_quantities[std::size_t(place)].label
         << " below 20 % at " << percent(to_20) << " %, below 50 % at " << percent(to_50)
         << " % of the vertices; noise " << fit.noise << '\n';
  } else {
    text.precision(2);
    if (std::isfinite(fit.noise))
      text << "fits of radius " << fit.scales[0] << " to " << fit.scales[2] << ", noise " << fit.noise << '\n';
    const auto& [to_10, to_20, to_50] = fit.known[0];
    text << "error of the affine Gaussian curvature below 10 % at " << percent(to_10) << " %, below 20 % at "
         << percent(to_20) << " %, below 50 % at " << percent(to_50) << " % of the vertices\n";
  }
  text << "% of vertices with errors below 20 / 50 %: " << table_of_errors(fit) << '\n';
}

/// "98 % of the vertices on the fit, at most 0.0003 from the data; others at most 0.001: 20 no_value, 3 turned"
void add_remesh(const Remesh_statistics& remesh, std::ostream& text) {
  const std::size_t all = remesh.number_of_vertices(), on_fit = remesh.number_on_fit();
  const auto& [of_fit, of_others] = remesh.distances_from_data;
  const double part = 100 * double(on_fit) / double(std::max<std::size_t>(all, 1));
  text << "edge length " << remesh.edge_length << "; " << std::setprecision(3) << part << std::setprecision(2)
       << " % of the vertices on the fit, at most " << of_fit << " from the data";
  if (on_fit < all) text << "; others at most " << of_others;
  const char* separator = ": ";
  for (std::size_t i = 1; i < number_of_fit_outcomes; ++i) {
    if (remesh.number_of[i] == 0) continue;
    text << std::exchange(separator, ", ") << remesh.number_of[i] << ' ' << fit_outcome_names[i];
  }
  text << "\ntriangles at most " << remesh.distance_from_data << " from the data, data at most "
       << remesh.distance_of_data << " from the triangles\n";
  if (remesh.crossings > 0)
    text << remesh.crossings << (remesh.crossings == 1 ? " pair" : " pairs")
         << " of intersecting triangles, as in the data\n";
}

} // namespace

std::string table_of_errors(const Fit_statistics& fit) {
  std::ostringstream text;
  for (std::size_t n = 0; n < affine_quantities.size(); ++n) {
    const auto& [to_10, to_20, to_50] = fit.known_of(affine_quantities[n]);
    text << (n == 0 ? "" : ", ") << words_of_quantities[n].symbol << ' ' << percent(to_20) << " / " << percent(to_50);
  }
  text << "; relative to |K| + H^2 for K, its square root for H";
  return text.str();
}

std::string to_JSON(const Statistics& s) {
  Json json = begin_JSON(s.source);
  json["isovalue"] = s.isovalue;
  add(s, json);
  json["components_left_out"] = s.components_left_out;
  json["max_distance_to_surface"] = s.max_distance_to_surface;
  json["seconds"] = {{"sample", s.sample_seconds},
                     {"project", s.project_seconds},
                     {"annotate", s.annotate_seconds},
                     {"write", s.write_seconds}};
  json["function_evaluations"] = s.function_evaluations;
  if (s.spline)
    json["spline"] = {{"degree", s.spline->degree},
                      {"scheme", name_of(s.spline->scheme)},
                      {"smoothing", s.spline->smoothing},
                      {"noise", s.spline->noise.deviation},
                      {"quantum", s.spline->noise.quantum}};
  if (s.fit) add(*s.fit, json);
  if (s.close_sheets)
    json["fit"]["close_sheets"] = {{"points", s.close_sheets->points}, {"distance", s.close_sheets->distance}};
  if (s.remesh) {
    json["remesh"] = {{"edge_length", s.remesh->edge_length}, {"crossings", s.remesh->crossings}};
    for (std::size_t i = 0; i < number_of_fit_outcomes; ++i)
      json["remesh"]["vertices"][std::string(fit_outcome_names[i])] = s.remesh->number_of[i];
    const auto& [of_fit, of_others] = s.remesh->distances_from_data;
    json["remesh"]["distance_from_data"] = {
        {"on_fit", of_fit}, {"others", of_others}, {"triangles", s.remesh->distance_from_data}};
    json["remesh"]["distance_of_data"] = s.remesh->distance_of_data;
  }
  if (s.completeness) {
    json["certified"] = s.completeness->is_certified;
    json["undecided_boxes"] = Json::array();
    for (const CGAL::Bbox_3& b : s.completeness->undecided_boxes) // in the order of --box
      json["undecided_boxes"].push_back({b.xmin(), b.xmax(), b.ymin(), b.ymax(), b.zmin(), b.zmax()});
  }
  return text_of(json);
}

std::string to_JSON(const Annotation_statistics& s) {
  Json json = begin_JSON(s.source);
  add(s, json);
  add(s.fit, json);
  json["seconds"] = {{"annotate", s.annotate_seconds}, {"write", s.write_seconds}};
  return text_of(json);
}

std::string summary(const Statistics& s) {
  std::ostringstream text;
  add_topology(s, text);
  add_status(s, text);
  text.precision(2);
  text << "distance from the surface: ";
  if (s.max_distance_to_surface == s.max_distance_to_surface) text << "at most " << s.max_distance_to_surface;
  else text << "unknown";
  if (const std::size_t n = s.status[std::size_t(Point_status::UNCONVERGED)]; n > 0)
    text << "; unknown for " << n << " unconverged " << (n == 1 ? "vertex" : "vertices");
  text << '\n';
  if (s.spline && s.spline->smoothing > 0)
    text << "noise in the samples: " << s.spline->noise.deviation << ", smoothed by " << s.spline->smoothing
         << " voxels\n";
  else if (s.spline && s.spline->is_smoothing_chosen)
    text << "noise in the samples: " << s.spline->noise.deviation << ", which needs no smoothing\n";
  if (s.remesh) add_remesh(*s.remesh, text);
  if (s.fit) add_fit(*s.fit, text);
  if (s.completeness) {
    const std::size_t n = s.completeness->undecided_boxes.size();
    if (s.completeness->is_certified) text << "certified: no component is missing\n";
    else text << "not certified: parts may be missing in " << n << (n == 1 ? " box\n" : " boxes\n");
  }
  return text.str();
}

std::string summary(const Annotation_statistics& s) {
  std::ostringstream text;
  if (s.faces > 0) add_topology(s, text);
  else text << s.vertices << (s.vertices == 1 ? " point\n" : " points\n");
  if (s.has_colors) text << xyz_colors_note << '\n';
  add_status(s, text);
  add_fit(s.fit, text);
  return text.str();
}

} // namespace equiaffine
