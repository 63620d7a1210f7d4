// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/maps_display.h"

#include "system/front_end.h"
#include <equiaffine/registration/internal/searches.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>

namespace equiaffine {

namespace {

using Map = CGAL::Aff_transformation_3<Kernel>;
using Mesh = Indexed_triangle_mesh_3<Kernel>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;

constexpr double tolerance = 1e-3; // unit vectors this close count as equal

/// A surface of revolution; the profile consists of positions along the axis, and multiples of the radius there.
template <std::size_t Rings>
Indexed_triangle_mesh_3<Kernel> turned(const Kernel::Point_3& base, const Kernel::Vector_3& along, double radius,
                                       const std::array<std::array<double, 2>, Rings>& profile, std::uint32_t sides) {
  const double length = std::sqrt(along.squared_length());
  Indexed_triangle_mesh_3<Kernel> mesh;
  if (!std::isfinite(length) || !(length > 0)) return mesh;
  const Kernel::Vector_3 axis = along / length;
  const bool is_steep = std::abs(axis.x()) > 0.6;
  Kernel::Vector_3 u = CGAL::cross_product(axis, is_steep ? Kernel::Vector_3(0, 1, 0) : Kernel::Vector_3(1, 0, 0));
  u = u / std::sqrt(u.squared_length());
  const Kernel::Vector_3 v = CGAL::cross_product(axis, u);
  for (const auto& [place, width] : profile)
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      mesh.points.push_back(base + place * along + width * radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  for (std::uint32_t ring = 0; ring + 1 < Rings; ++ring)
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t a = ring * sides + k, b = ring * sides + (k + 1) % sides;
      mesh.triangles.push_back({a, b, b + sides});
      mesh.triangles.push_back({a, b + sides, a + sides});
    }
  return mesh;
}

/// A rod between two points, as a closed mesh.
Indexed_triangle_mesh_3<Kernel> rod_mesh(const Kernel::Point_3& from, const Kernel::Point_3& to, double radius) {
  constexpr std::array<std::array<double, 2>, 4> profile = {{{0, 0}, {0, 1}, {1, 1}, {1, 0}}};
  return turned(from, to - from, radius, profile, 6);
}

Eigen::Matrix3d matrix_of(const Map& map) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix(i, j) = map.m(i, j);
  return matrix;
}

Vector vector_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

/// The direction of the smallest singular value, which the matrix maps nearly to 0.
Eigen::Vector3d null_direction(const Eigen::Matrix3d& matrix) {
  return Eigen::JacobiSVD<Eigen::Matrix3d>(matrix, Eigen::ComputeFullV).matrixV().col(2);
}

/// The common fixed point of a group of maps.
Point fixed_point(const Affine_symmetries_3<Kernel>& symmetries) {
  Vector sum(0, 0, 0);
  for (const auto& symmetry : symmetries.maps)
    sum = sum + (symmetry.map(Point(0, 0, 0)) - CGAL::ORIGIN) / double(symmetries.maps.size());
  return CGAL::ORIGIN + sum;
}

/// Adds a line, unless there is already one with its direction.
void add_axis(const Point& point, const Eigen::Vector3d& direction, std::vector<Kernel::Line_3>& axes) {
  const Vector v = vector_of(direction.normalized());
  const bool is_known = std::any_of(axes.begin(), axes.end(), [&](const Kernel::Line_3& axis) {
    return CGAL::cross_product(axis.to_vector(), v).squared_length() < tolerance * tolerance;
  });
  if (!is_known) axes.emplace_back(point, v);
}

void add(const Mesh& part, Mesh& whole) {
  const auto first = std::uint32_t(whole.points.size());
  whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
  for (const auto& [a, b, c] : part.triangles) whole.triangles.push_back({a + first, b + first, c + first});
}

} // namespace

Indexed_triangle_mesh_3<Kernel> arrow_mesh(const Kernel::Point_3& base, const Kernel::Vector_3& arrow, double radius) {
  // The rings: base (radius 0), ends of the shaft, base of the cone, and tip (radius 0).
  constexpr std::array<std::array<double, 2>, 5> profile = {{{0, 0}, {0, 1}, {0.75, 1}, {0.75, 2.5}, {1, 0}}};
  return turned(base, arrow, radius, profile, 12);
}

Symmetry_marks marks_of(const Affine_symmetries_3<Kernel>& symmetries) {
  Symmetry_marks marks;
  if (symmetries.continuous.dimension() == 1) {
    const auto& [matrix, translation] = symmetries.continuous.generators[0];
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Vector3d values = svd.singularValues();
    if (values[2] > tolerance * values[0]) return marks; // there is no axis
    const Eigen::Vector3d inverse(1 / values[0], 1 / values[1], 0);
    const Eigen::Vector3d on_axis = -(svd.matrixV() * inverse.cwiseProduct(svd.matrixU().transpose() * translation));
    add_axis(CGAL::ORIGIN + vector_of(on_axis), svd.matrixV().col(2), marks.axes);
    return marks;
  }
  const Point center = fixed_point(symmetries);
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  for (std::size_t i = 1; i < symmetries.maps.size(); ++i) {
    const Eigen::Matrix3d matrix = matrix_of(symmetries.maps[i].map);
    const bool is_involution = (matrix * matrix - identity).norm() < 0.1;
    if (matrix.determinant() > 0) add_axis(center, null_direction(matrix - identity), marks.axes);
    else if (is_involution && matrix.trace() > 0)
      marks.planes.emplace_back(center, vector_of(null_direction(matrix.transpose() + identity)));
  }
  return marks;
}

Mesh mesh_of_planes(const std::vector<Kernel::Plane_3>& planes, const Mesh& surface, double radius) {
  Mesh result;
  std::vector<double> heights(surface.points.size());
  for (const Kernel::Plane_3& plane : planes) {
    const Vector normal = plane.orthogonal_vector();
    const Point origin = plane.point();
    std::transform(surface.points.begin(), surface.points.end(), heights.begin(),
                   [&](const Point& p) { return normal * (p - origin); });
    for (const auto& triangle : surface.triangles) {
      std::vector<Point> ends;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = triangle[k], b = triangle[(k + 1) % 3];
        if ((heights[a] < 0) == (heights[b] < 0)) continue;
        const double part = heights[a] / (heights[a] - heights[b]);
        ends.push_back(surface.points[a] + part * (surface.points[b] - surface.points[a]));
      }
      if (ends.size() == 2) add(rod_mesh(ends[0], ends[1], radius), result);
    }
  }
  return result;
}

Mesh mesh_of_axes(const std::vector<Kernel::Line_3>& axes, const Mesh& surface, double radius) {
  constexpr double overhang = 0.1;
  Mesh result;
  for (const Kernel::Line_3& axis : axes) {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    const Point origin = axis.point();
    for (const Point& p : surface.points) {
      const double place = axis.to_vector() * (p - origin);
      least = std::min(least, place);
      greatest = std::max(greatest, place);
    }
    const double more = overhang * (greatest - least);
    add(rod_mesh(origin + (least - more) * axis.to_vector(), origin + (greatest + more) * axis.to_vector(), radius),
        result);
  }
  return result;
}

namespace {

/// A surface on a page or picture; its index is the value of the column `surface`.
struct Shown_surface {
  std::string name, color; ///< the color of its index in the range from 0 to the last index
};

std::vector<Shown_surface> shown_surfaces(const Registration_report& report) {
  if (!report.registration.found()) return {{"target", "pale yellow"}, {"source, not moved", "dark violet"}};
  if (!report.registration.best().pair) return {{"target", "pale yellow"}, {"moved source", "dark violet"}};
  return {{"target", "pale yellow"},
          {"moved source", "orange"},
          {"frame of the target", "magenta"},
          {"frame of the source", "dark violet"}};
}

bool shows_surfaces(const Display_request& options) { return options.color == "surface"; }

void add_text(const std::string& text, std::vector<Surface_note>& notes) { notes.emplace_back().text = text; }

void add_surfaces(const std::vector<Shown_surface>& surfaces, std::vector<Surface_note>& notes) {
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    add_text(surfaces[n].name, notes);
    notes.back().number = double(n);
  }
}

/// "0 target (pale yellow), 1 moved source (orange)"
std::string numbers_text(const std::vector<Shown_surface>& surfaces, bool has_colors) {
  std::string text;
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    text += (n > 0 ? ", " : "") + std::to_string(n) + ' ' + surfaces[n].name;
    if (has_colors) text += " (" + surfaces[n].color + ')';
  }
  return text;
}

std::vector<Shown_surface> shown_surfaces(const Symmetries& symmetries) {
  const Symmetry_marks marks = marks_of(symmetries);
  std::vector<Shown_surface> surfaces = {{"surface", "pale yellow"}};
  if (!marks.planes.empty())
    surfaces.push_back({"planes of reflection", marks.axes.empty() ? "dark violet" : "magenta"});
  if (!marks.axes.empty()) surfaces.push_back({"axes of rotation", "dark violet"});
  return surfaces;
}

std::string text_of_distances() {
  return "distance from the other surface; use " + option_text("color", "surface") + " to distinguish the two";
}

} // namespace

Display_request display_of(const Registration_report& report, Display_request options) {
  if (options.color.empty() && !options.range) options.color = "surface";
  if (shows_surfaces(options) && !options.range) options.range = {0., double(shown_surfaces(report).size() - 1)};
  return options;
}

Description description_of(const Registration_report& report, const Display_request& options) {
  Description description = {{"Source", report.source}, {"Target", report.target}};
  if (!report.registration.found()) {
    description.emplace_back("Map", reason_for_none(report));
    for (const auto advice : report.registration.advice) description.emplace_back("Try", advice_text(advice));
  } else {
    const auto& best = report.registration.best();
    description.emplace_back("Map", "found");
    description.emplace_back("Determinant", number_text(internal::determinant_of(best.map), 3));
    description.emplace_back("Overlap", overlap_text(best) + contradictions_text(best));
    description.emplace_back("Rms distance", rms_text(report.registration));
    if (const auto& next = report.registration.next_best_rms)
      description.emplace_back("Next best rms distance", number_text(*next, 3));
    description.emplace_back("Significance", significance_text(best));
    description.emplace_back("log10 of false alarms", number_text(best.log10_false_alarms, 3));
  }
  description.emplace_back("surface", numbers_text(shown_surfaces(report), shows_surfaces(options)));
  if (!shows_surfaces(options)) description.emplace_back("Colors", text_of_distances());
  return description;
}

std::vector<Surface_note> notes_of(const Registration_report& report, const Display_request& options) {
  std::vector<Surface_note> notes;
  if (!report.registration.found()) {
    add_text(reason_for_none(report), notes);
    for (const auto advice : report.registration.advice) add_text("try " + advice_text(advice), notes);
  } else {
    const auto& best = report.registration.best();
    add_text("determinant " + number_text(internal::determinant_of(best.map), 3) + "; " + significance_text(best),
             notes);
    add_text("overlap: " + overlap_text(best) + contradictions_text(best), notes);
    add_text("rms distance " + rms_text(report.registration), notes);
  }
  if (!shows_surfaces(options)) {
    add_text("colors: " + text_of_distances(), notes);
    return notes;
  }
  add_surfaces(shown_surfaces(report), notes);
  return notes;
}

Display_request display_of(const Symmetries_report& report, Display_request options) {
  const auto surfaces = shown_surfaces(report.symmetries);
  if (options.color.empty() && !options.range && surfaces.size() > 1) options.color = "surface";
  if (shows_surfaces(options) && !options.range) options.range = {0., double(surfaces.size() - 1)};
  return options;
}

Description description_of(const Symmetries_report& report, const Display_request& options) {
  const Symmetries& symmetries = report.symmetries;
  const auto order = symmetries.order();
  Description description = {{"Symmetries of", report.source}};
  if (symmetries.is_undecided()) description.emplace_back("Order", "undecided: " + reason_for_undecided(symmetries));
  else description.emplace_back("Order", order ? std::to_string(*order) : "infinite");
  if (!symmetries.levels.empty()) description.emplace_back("Levels", levels_text(symmetries));
  if (symmetries.continuous.dimension() > 0)
    description.emplace_back("Generators", std::to_string(symmetries.continuous.dimension()));
  if (order) description.emplace_back("Determinants", determinants_text(symmetries));
  if (report.has_rigid_maps_only)
    description.emplace_back("Kind", "only rigid symmetries, since the mesh does not bound a solid");
  for (const std::string& limit : limits_of(symmetries)) description.emplace_back("Limit", limit);
  for (const auto advice : symmetries.advice) description.emplace_back("To find more, try", advice_text(advice));
  description.emplace_back("surface", numbers_text(shown_surfaces(symmetries), shows_surfaces(options)));
  return description;
}

std::vector<Surface_note> notes_of(const Symmetries_report& report, const Display_request& options) {
  std::vector<Surface_note> notes;
  for (const auto& [name, text] : description_of(report, options))
    if (name != "surface") add_text(name + ": " + text, notes);
  if (shows_surfaces(options)) add_surfaces(shown_surfaces(report.symmetries), notes);
  return notes;
}

} // namespace equiaffine
