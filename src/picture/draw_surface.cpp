// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/draw_surface.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

namespace equiaffine {

namespace {

using Vector = Kernel::Vector_3;

Vector unit(const Vector& v) { return v / std::sqrt(v.squared_length()); }

CGAL::Bbox_3 box_of(const std::vector<Kernel::Point_3>& points) {
  CGAL::Bbox_3 box;
  for (const Kernel::Point_3& p : points) box += p.bbox();
  return box;
}

/// Arrows are spread over a grid of this many cells per diameter of the surface, and that much longer than a cell.
constexpr double arrow_cells = 16, arrow_length = 1.5;

/// The first view of the page, with room around the surface for arrows where there are some.
class Camera {
public:
  Camera(const std::vector<Kernel::Point_3>& points, const std::array<double, 3>& up_direction, std::size_t width,
         std::size_t height, bool has_arrows)
      : width_(double(width)), height_(double(height)),
        margin_(1.05 + (has_arrows ? 2 * arrow_length / arrow_cells : 0)) {
    const CGAL::Bbox_3 box = box_of(points);
    center_ =
        Kernel::Point_3((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2);
    const Vector axis(up_direction[0], up_direction[1], up_direction[2]);
    const Vector front = unit(cross_product(std::abs(axis.x()) < 0.9 ? Vector(1, 0, 0) : Vector(0, 1, 0), axis));
    back_ = unit(front + 0.5 * cross_product(axis, front) + 0.62 * axis);
    right_ = unit(cross_product(axis, back_));
    up_ = cross_product(back_, right_);
    fit(points);
  }

  Screen_point operator()(const Kernel::Point_3& p) const {
    const Vector v = p - center_;
    const double nearness = 1 / (distance_ - back_ * v), scale = 0.5 * height_ / half_view * nearness;
    return {0.5 * width_ + scale * (right_ * v), 0.5 * height_ - scale * (up_ * v), nearness};
  }

  /// Gives the components of a vector to the right, upwards and towards the eye.
  Vector turned(const Vector& v) const { return {right_ * v, up_ * v, back_ * v}; }
  Vector towards_eye(const Kernel::Point_3& p) const { return unit(center_ + distance_ * back_ - p); }
  double radius() const { return radius_; }
  const Kernel::Point_3& center() const { return center_; }

private:
  /// Sets the least distance from which everything and a margin is seen.
  void fit(const std::vector<Kernel::Point_3>& points) {
    double least = 0;
    for (const Kernel::Point_3& p : points) {
      const Vector v = p - center_;
      const double across = std::abs(right_ * v) * height_ / width_, along = std::abs(up_ * v);
      least = std::max(least, back_ * v + margin_ * std::max(across, along) / half_view);
      radius_ = std::max(radius_, std::sqrt(v.squared_length()));
    }
    distance_ = std::max(least, 1.2 * radius_);
    if (!(distance_ > 0)) distance_ = 1;
  }

  static inline const double half_view = std::tan(std::numbers::pi / 14); // the tangent of half the angle of view
  double width_, height_, margin_, distance_ = 1, radius_ = 0;
  Kernel::Point_3 center_;
  Vector right_, up_, back_;
};

/// The attributes nx ny nz; where they are missing, means of the normals of the faces.
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

/// The light of the page's shader.
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

void draw_triangles(Canvas& canvas, const Camera& camera, const Indexed_triangle_mesh_3<Kernel>& mesh,
                    const std::vector<Vector>& normals, const Surface_paint& paint) {
  std::vector<Screen_point> seen;
  std::vector<Vector> turned, views;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    seen.push_back(camera(mesh.points[i]));
    turned.push_back(camera.turned(normals[i]));
    views.push_back(camera.turned(camera.towards_eye(mesh.points[i])));
  }
  for (const auto& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle;
    canvas.draw_triangle({seen[a], seen[b], seen[c]}, [&](const std::array<double, 3>& weights, bool is_front) {
      const auto& [u, v, w] = weights;
      return lit(paint(triangle, weights), u * turned[a] + v * turned[b] + w * turned[c],
                 u * views[a] + v * views[b] + w * views[c], is_front);
    });
  }
}

/// Dark strokes with a white rim, so that they are seen on any color.
class Line_drawing {
public:
  void add(const Screen_point& a, const Screen_point& b, double first, double last) {
    strokes_.push_back({a, b, first, last});
  }

  void draw(Canvas& canvas) const {
    constexpr double rim = 1, lift = 2e-3;
    for (const auto& [a, b, first, last] : strokes_) canvas.draw_stroke(a, b, first + rim, last + rim, {1, 1, 1}, lift);
    for (const auto& [a, b, first, last] : strokes_) canvas.draw_stroke(a, b, first, last, {0, 0, 0}, 2 * lift);
  }

private:
  struct Stroke {
    Screen_point a, b;
    double first, last; // half-widths
  };
  std::vector<Stroke> strokes_;
};

Line_drawing curve_strokes(const Camera& camera, std::span<const Polyline_3<Kernel>> curves) {
  constexpr double half_width = 1.4;
  Line_drawing strokes;
  for (const auto& curve : curves) {
    const std::size_t n = curve.points.size();
    for (std::size_t i = 0; i + (curve.is_closed ? 0 : 1) < n; ++i)
      strokes.add(camera(curve.points[i]), camera(curve.points[(i + 1) % n]), half_width, half_width);
  }
  return strokes;
}

/// Arrows at vertices that are spread evenly in space: one in each cell of a grid.
Line_drawing arrow_strokes(const Camera& camera, const std::vector<Kernel::Point_3>& points,
                           const std::array<const std::vector<double>*, 3>& columns) {
  const double cell = 2 * camera.radius() / arrow_cells;
  std::set<std::array<long, 3>> taken;
  std::vector<std::pair<Kernel::Point_3, Vector>> arrows;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector arrow((*columns[0])[i], (*columns[1])[i], (*columns[2])[i]);
    const Vector place = (points[i] - camera.center()) / cell;
    const double length = std::sqrt(arrow.squared_length());
    if (!std::isfinite(length)) continue;
    if (!taken.insert({std::lround(place.x()), std::lround(place.y()), std::lround(place.z())}).second) continue;
    arrows.emplace_back(points[i], arrow);
    lengths.push_back(length);
  }
  Line_drawing strokes;
  if (arrows.empty()) return strokes;
  const double usual = std::max(quantile(lengths, 50), std::numeric_limits<double>::min());
  for (const auto& [base, arrow] : arrows) {
    const double scale = arrow_length * cell / std::max(usual, std::sqrt(arrow.squared_length()));
    const Screen_point neck = camera(base + 0.6 * scale * arrow);
    strokes.add(camera(base), neck, 1, 1);
    strokes.add(neck, camera(base + scale * arrow), 3.2, 0.2);
  }
  return strokes;
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
                             const Surface_view& view, std::span<const Polyline_3<Kernel>> curves) {
  const auto [width, height] = view.size;
  const CGAL::Bbox_3 box = box_of(mesh.points);
  const Surface_paint paint(attributes, view.color, view.range, std::hypot(box.x_span(), box.y_span(), box.z_span()));
  const Camera camera(mesh.points, view.up, width, height - (paint.legend() ? legend_height : 0), !view.arrows.empty());
  Canvas canvas(width, height);
  draw_triangles(canvas, camera, mesh, vertex_normals(mesh, attributes), paint);
  curve_strokes(camera, curves).draw(canvas);
  if (const auto columns = vector_columns(attributes, view.arrows))
    arrow_strokes(camera, mesh.points, *columns).draw(canvas);
  return {canvas.picture(), paint.legend()};
}

} // namespace equiaffine
