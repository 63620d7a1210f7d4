// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/draw_surface.h"

#include "picture/Canvas.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/display/internal/trust.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

namespace equiaffine {

namespace {

/// The fraction of the box, seen along an axis, that the convex hull of the lowest points covers.
double fraction_covered_by_base(const std::vector<Kernel::Point_3>& points, const CGAL::Bbox_3& box, int axis) {
  constexpr double part_of_height = 0.03;
  const int across = (axis + 1) % 3, along = (axis + 2) % 3;
  const auto span = [&](int k) { return box.max(k) - box.min(k); };
  using Point_2 = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2; // a hull needs exact predicates
  std::vector<Point_2> lowest, hull;
  for (const Kernel::Point_3& p : points)
    if (p[axis] <= box.min(axis) + part_of_height * span(axis)) lowest.emplace_back(p[across], p[along]);
  CGAL::convex_hull_2(lowest.begin(), lowest.end(), std::back_inserter(hull));
  double area = 0;
  for (std::size_t i = 2; i < hull.size(); ++i) area += CGAL::area(hull[0], hull[i - 1], hull[i]);
  const double whole = span(across) * span(along);
  return whole > 0 ? area / whole : 0;
}

} // namespace

std::array<double, 3> natural_up(const std::vector<Kernel::Point_3>& points) {
  constexpr double least = 0.1, wider = 2;
  CGAL::Bbox_3 box;
  for (const Kernel::Point_3& p : points) box += p.bbox();
  const double y = fraction_covered_by_base(points, box, 1), z = fraction_covered_by_base(points, box, 2);
  if (z >= least && z >= wider * y) return {0, 0, 1};
  return {0, 1, 0};
}

namespace {

using Vector = Kernel::Vector_3;

/// The normals nx ny nz; where they are missing, means of the normals of the faces.
std::vector<Vector> vertex_normals(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes) {
  std::vector<Vector> normals(mesh.points.size(), CGAL::NULL_VECTOR);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector normal = cross_product(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
    for (const std::uint32_t corner : {a, b, c}) normals[corner] = normals[corner] + normal;
  }
  if (const auto given = vector_columns(attributes, "normal"))
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Vector normal((*(*given)[0])[i], (*(*given)[1])[i], (*(*given)[2])[i]);
      if (std::isfinite(normal.squared_length())) normals[i] = normal;
    }
  for (Vector& normal : normals)
    if (normal.squared_length() > 0) normal = unit(normal);
  return normals;
}

/// The normals for shading the corners of triangles. If the normal of a vertex deviates from that of a triangle, as at
/// a crease, the corner gets the mean over the adjacent triangles that do not deviate from this triangle.
std::vector<std::array<Vector, 3>> corner_normals(const Indexed_triangle_mesh_3<Kernel>& mesh,
                                                  const std::vector<Vector>& normals) {
  const double greatest_bend = std::cos(40 * std::numbers::pi / 180);
  std::vector<Vector> of_faces;
  std::vector<std::vector<std::uint32_t>> faces_at(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const std::uint32_t corner : {a, b, c}) faces_at[corner].push_back(std::uint32_t(of_faces.size()));
    of_faces.push_back(cross_product(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
  }
  const auto is_near = [&](const Vector& a, const Vector& b) {
    return !(a * b < greatest_bend * std::sqrt(a.squared_length() * b.squared_length()));
  };
  std::vector<std::array<Vector, 3>> result(of_faces.size());
  for (std::size_t face = 0; face < of_faces.size(); ++face)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = mesh.triangles[face][k];
      Vector& normal = result[face][k] = normals[corner];
      if (is_near(normal, of_faces[face])) continue;
      normal = CGAL::NULL_VECTOR;
      for (const std::uint32_t other : faces_at[corner])
        if (is_near(of_faces[face], of_faces[other])) normal = normal + of_faces[other];
      normal = unit(normal);
    }
  return result;
}

/// The shading of the page.
Light lit(const Light& base, const Vector& normal, const Vector& view, bool is_front) {
  static const Vector source = unit(Vector(-0.35, 0.5, 1));
  const Vector n = (is_front ? 1. : -1.) / std::sqrt(std::max(normal.squared_length(), 1e-30)) * normal;
  const double diffuse = 0.5 + 0.5 * (n * source);
  const double shade = (0.36 + 0.67 * diffuse * diffuse) * (is_front ? 1 : 0.5);
  const double glint = 0.03 * std::pow(std::max(n * unit(source + view), 0.), 40);
  Light light;
  for (std::size_t k = 0; k < 3; ++k) light[k] = float(base[k] * shade + glint);
  return light;
}

/// A mesh, or points, as seen by a camera.
class Seen_surface {
public:
  Seen_surface(const Camera& camera, const Indexed_triangle_mesh_3<Kernel>& mesh, const std::vector<Vector>& normals)
      : triangles_(mesh.triangles), normals_(corner_normals(mesh, normals)) {
    for (auto& corners : normals_)
      for (Vector& normal : corners) normal = camera.turned(normal);
    for (const auto& point : mesh.points) {
      places_.push_back(camera(point));
      views_.push_back(camera.turned(camera.towards_eye(point)));
    }
    if (!triangles_.empty()) return;
    for (const Vector& normal : normals) normals_of_points_.push_back(camera.turned(normal));
  }

  void draw(Canvas& canvas, const Surface_paint& paint) const {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      Progress_observer::step();
      const auto& [a, b, c] = triangles_[i];
      const auto& [na, nb, nc] = normals_[i];
      const auto shade = [&](const std::array<double, 3>& weights, bool is_front) {
        const auto& [u, v, w] = weights;
        return lit(paint(triangles_[i], weights), u * na + v * nb + w * nc,
                   u * views_[a] + v * views_[b] + w * views_[c], is_front);
      };
      canvas.draw_triangle({places_[a], places_[b], places_[c]}, shade);
    }
    if (triangles_.empty()) draw_points(canvas, paint);
  }

private:
  /// Draws points as discs with a radius of 1 to 4 pixels, smaller for more points.
  void draw_points(Canvas& canvas, const Surface_paint& paint) const {
    const double radius = std::clamp(180 / std::sqrt(double(places_.size())), 1., 4.);
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      const Light color = paint({i, i, i}, {1, 0, 0});
      const Vector& normal = normals_of_points_[i];
      const bool has_normal = normal.squared_length() > 0, is_front = normal * views_[i] >= 0;
      canvas.draw_stroke(places_[i], places_[i], radius, radius,
                         has_normal ? lit(color, normal, views_[i], is_front) : color, 0);
    }
  }

  std::span<const std::array<std::uint32_t, 3>> triangles_;
  std::vector<Screen_point> places_;
  std::vector<std::array<Vector, 3>> normals_;    // of the corners of triangles, in camera coordinates
  std::vector<Vector> views_, normals_of_points_; // in camera coordinates
};

/// Breaks the text between words into lines that fit the picture, by the mean width of a letter.
std::vector<std::string> lines_of(std::string_view text, std::size_t width) {
  constexpr std::size_t letter_width = 8, margins = 40;
  const std::size_t most = std::max<std::size_t>(width, 5 * margins) / letter_width - margins / letter_width;
  std::vector<std::string> lines;
  while (text.size() > most) {
    const std::size_t space = text.rfind(' ', most), end = space == std::string_view::npos ? most : space;
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(space == std::string_view::npos ? end : end + 1);
  }
  lines.emplace_back(text);
  return lines;
}

/// The given notes, then those of the paint, which are dropped first if there is no room.
std::vector<Color_note> notes_from_bottom(std::span<const Surface_note> given, std::size_t width,
                                          const Surface_paint& paint) {
  std::vector<Color_note> notes;
  for (auto note = given.rbegin(); note != given.rend(); ++note) {
    const std::vector<std::string> lines = lines_of(note->text, width);
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) notes.push_back({std::nullopt, *line});
    if (note->number && paint.legend()) notes.back().color = paint.legend()->mapping.color(*note->number);
  }
  notes.insert(notes.end(), paint.notes().begin(), paint.notes().end());
  return notes;
}

} // namespace

std::optional<std::array<const std::vector<double>*, 3>> vector_columns(const Vertex_attributes& attributes,
                                                                        const std::string& name) {
  const std::string stem = name == "normal" ? "n" : name + '_';
  std::array<const std::vector<double>*, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto* column = find_column(attributes, stem + "xyz"[k]);
    if (!column) return std::nullopt;
    result[k] = &column->values;
  }
  return result;
}

Surface_picture draw_surface(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                             const Display_options& options, std::span<const Surface_note> given_notes,
                             std::span<const Polyline_3<Kernel>> curves) {
  const auto [width, height] = options.size;
  const Surface_paint paint(mesh, attributes, options, !given_notes.empty());
  std::vector<Color_note> notes = notes_from_bottom(given_notes, width, paint);
  const std::size_t below = paint.legend() ? legend_height : notes.empty() ? 0 : note_margin;
  notes.resize(std::min(notes.size(), (height - height / 4 - below) / note_height));
  const Camera camera(mesh.points, options.up, width, height - below - note_height * notes.size(), !options.arrows.empty());
  const Seen_surface surface(camera, mesh, vertex_normals(mesh, attributes));
  const Line_drawing parabolic_lines = zero_strokes(camera, mesh, paint.sides()), drawn = curve_strokes(camera, curves);
  const auto columns = vector_columns(attributes, options.arrows);
  const Line_drawing arrows = columns ? arrow_strokes(camera, mesh.points, *columns) : Line_drawing();
  Picture picture{width, height, {}};
  picture.rgb.reserve(3 * width * height);
  const std::size_t rows = Canvas::rows_of_band(width);
  for (std::size_t first = 0; first < height; first += rows) {
    Canvas band(width, std::min(rows, height - first), first);
    surface.draw(band, paint);
    parabolic_lines.draw(band, light_of(status_color(Point_status::PARABOLIC)));
    drawn.draw_with_rim(band);
    arrows.draw_with_rim(band);
    const auto bytes = band.picture().rgb;
    picture.rgb.insert(picture.rgb.end(), bytes.begin(), bytes.end());
  }
  return {std::move(picture), paint.legend(), std::move(notes)};
}

} // namespace equiaffine
