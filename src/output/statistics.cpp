// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/statistics.h"

#include <nlohmann/json.hpp>

#include <sstream>

namespace equiaffine {

std::array<std::size_t, number_of_point_statuses> count(std::span<const Point_status> status) {
  std::array<std::size_t, number_of_point_statuses> counts{};
  for (const Point_status s : status) ++counts[static_cast<std::size_t>(s)];
  return counts;
}

namespace {

const char* name_of(Spline_scheme scheme) {
  switch (scheme) {
  case Spline_scheme::CONVOLUTION: return "convolution";
  case Spline_scheme::QUASI_INTERPOLATION: return "quasi-interpolation";
  case Spline_scheme::INTERPOLATION: return "interpolation";
  default: return "paper";
  }
}

} // namespace

std::string to_JSON(const Statistics& s) {
  nlohmann::ordered_json json = {{"equiaffine", EQUIAFFINE_VERSION},
                                 {"source", s.source},
                                 {"isovalue", s.isovalue},
                                 {"vertices", s.vertices},
                                 {"faces", s.faces},
                                 {"components", s.topology.components},
                                 {"euler_characteristic", s.topology.euler_characteristic},
                                 {"boundary_edges", s.topology.boundary_edges},
                                 {"manifold", s.topology.is_manifold}};
  for (std::size_t i = 0; i < number_of_point_statuses; ++i)
    json["status"][std::string(to_string(Point_status(i)))] = s.status[i];
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
  if (s.completeness) {
    json["certified"] = s.completeness->is_certified;
    json["undecided_boxes"] = nlohmann::ordered_json::array();
    for (const CGAL::Bbox_3& b : s.completeness->undecided_boxes) // in the order of --box
      json["undecided_boxes"].push_back({b.xmin(), b.xmax(), b.ymin(), b.ymax(), b.zmin(), b.zmax()});
  }
  // Texts come from the command line and need not be UTF-8.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

std::string summary(const Statistics& s) {
  std::ostringstream text;
  text << s.vertices << " vertices, " << s.faces << " triangles, " << s.topology.components
       << (s.topology.components == 1 ? " component" : " components") << ", Euler characteristic "
       << s.topology.euler_characteristic << ", ";
  if (!s.topology.is_manifold) text << "not a manifold, ";
  if (s.topology.boundary_edges == 0) text << "closed\n";
  else text << s.topology.boundary_edges << " boundary edges\n";
  const char* separator = "status: ";
  for (std::size_t i = 0; i < number_of_point_statuses; ++i) {
    if (s.status[i] == 0) continue;
    text << separator << s.status[i] << ' ' << to_string(Point_status(i));
    separator = ", ";
  }
  text.precision(2);
  text << "\ndistance from the surface: ";
  if (s.max_distance_to_surface == s.max_distance_to_surface) text << "at most " << s.max_distance_to_surface;
  else text << "unknown";
  if (const std::size_t n = s.status[std::size_t(Point_status::UNCONVERGED)]; n > 0)
    text << "; nothing is known of the " << n << " unconverged " << (n == 1 ? "vertex" : "vertices");
  text << '\n';
  if (s.spline && s.spline->smoothing > 0)
    text << "noise in the samples: " << s.spline->noise.deviation << ", smoothed by " << s.spline->smoothing
         << " voxels\n";
  if (s.completeness) {
    const std::size_t n = s.completeness->undecided_boxes.size();
    if (s.completeness->is_certified) text << "certified: no component is missing\n";
    else text << "not certified: parts may be missing in " << n << (n == 1 ? " box\n" : " boxes\n");
  }
  return text.str();
}

} // namespace equiaffine
