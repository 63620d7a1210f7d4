// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_BORDER_CURVES_3_H
#define EQUIAFFINE_SRC_DELAUNAY_BORDER_CURVES_3_H

#include "delaunay/Border_curve_tracer_3.h"
#include "delaunay/Domain_border_3.h"
#include <equiaffine/delaunay/internal/Seed_grid_3.h>
#include <equiaffine/function/internal/sign_change.h>
#include <equiaffine/mesh/Polyline_3.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

template <class Kernel>
struct Border_curve_3 : Polyline_3<Kernel> {
  int axis; ///< normal to the face of the box; for a sphere, to the face of the cube where the curve was found
};

/// The curves in which a surface meets the border of a clip domain, as polylines of short segments with vertices on
/// both. A curve ends on an edge of a box, and the curves on both sides of the edge have that end in common.
///
/// A curve with bends smaller than `spacing`, and a closed curve smaller than that, may be missed.
template <ImplicitFunctionTraits_3 Traits>
class Border_curves_3 {
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using Border = Domain_border_3<Kernel>;
  using Face = typename Border::Face;
  using Grid = Seed_grid_3<Point_3, Vector_3>;
  using Seed = typename Grid::Seed;

public:
  using Curve = Border_curve_3<Kernel>;

  Border_curves_3(const Traits& traits, const Clip_domain_3& domain, double spacing)
      : traits_(traits), border_(domain), pitch_(spacing / 2), step_(spacing / 8),
        tracer_(traits, border_, step_, pitch_) {}
  Border_curves_3(const Border_curves_3&) = delete; // the tracer refers to the border

  std::vector<Curve> find() {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool is_upper : {false, true}) {
        if (traced_.empty() || !border_.is_sphere()) traced_.emplace_back();
        search({axis, is_upper}, {0, 1}, {0, 1});
      }
    return std::move(curves_);
  }

  /// Returns the point of a curve near p, or nothing if there is none within half the spacing. `axis` is the axis of
  /// the curve.
  std::optional<Point_3> project(const Point_3& p, int axis) const {
    const auto q = tracer_.project(p, axis);
    return q && border_.axes_beyond(*q, axis).empty() ? q : std::nullopt;
  }

private:
  using Range = std::pair<double, double>;

  /// Finds the curves in a part of a face: subdivides it until the parts are small or without surface.
  void search(const Face& face, const Range& u, const Range& v) {
    const std::array<Point_3, 4> corners = {
        border_.point(face, u.first, v.first), border_.point(face, u.second, v.first),
        border_.point(face, u.second, v.second), border_.point(face, u.first, v.second)};
    CGAL::Bbox_3 box;
    for (const Point_3& corner : corners) box += corner.bbox();
    const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
    if (is_empty(box, border_.is_sphere() ? diagonal / 2 : 0)) return;
    if (diagonal <= pitch_) return search_sides(face, corners);
    const double s = (u.first + u.second) / 2, t = (v.first + v.second) / 2;
    for (const Range& u_half : {Range(u.first, s), Range(s, u.second)})
      for (const Range& v_half : {Range(v.first, t), Range(t, v.second)}) search(face, u_half, v_half);
  }

  /// Finds the curves that cross the sides of a small part of a face.
  void search_sides(const Face& face, const std::array<Point_3, 4>& corners) {
    std::array<double, 4> value;
    for (std::size_t n = 0; n < 4; ++n) value[n] = traits_.value(corners[n]);
    for (std::size_t n = 0, m = 1; n < 4; ++n, m = (m + 1) % 4) {
      if (!is_sign_change(value[n], value[m])) continue;
      const auto root = intersect_segment(traits_, corners[n], corners[m], value[n], value[m]);
      if (!root.has_converged) continue;
      const auto start = project(root.point, face.axis);
      if (start && !is_traced(*start, face.axis)) add({tracer_.trace(*start, face.axis), face.axis});
    }
  }

  /// Whether there is no surface in a box that is enlarged by a margin.
  bool is_empty(const CGAL::Bbox_3& b, double margin) const {
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>)
      return !traits_
                  .bounds(CGAL::Bbox_3(b.xmin() - margin, b.ymin() - margin, b.zmin() - margin, b.xmax() + margin,
                                       b.ymax() + margin, b.zmax() + margin))
                  .contains(0);
    else return false;
  }

  /// Whether a curve of the same face passes near p. A curve that runs in an edge of the box belongs to two faces, and
  /// is found on the first one only.
  bool is_traced(const Point_3& p, int axis) {
    const Seed seed = seed_at(p);
    if (traced_.back().is_crowded(seed)) return true;
    return runs_in_edge(p, axis) &&
           std::any_of(traced_.begin(), traced_.end(), [&](Grid& grid) { return grid.is_crowded(seed); });
  }

  bool runs_in_edge(const Point_3& p, int axis) const {
    if (border_.is_sphere()) return false;
    constexpr double negligible = 1e-6;
    const CGAL::Bbox_3& box = border_.box();
    const Vector_3 t = tracer_.tangent(p, axis);
    for (int b = 0; b < 3; ++b) {
      const double distance = std::min(std::abs(p[b] - box.min(b)), std::abs(p[b] - box.max(b)));
      if (b != axis && distance < negligible * step_ && std::abs(t[b]) < negligible) return true;
    }
    return false;
  }

  Seed seed_at(const Point_3& p) const { return {p, tracer_.gradient(p), pitch_}; }

  void add(Curve curve) {
    for (const Point_3& p : curve.points) traced_.back().insert(seed_at(p));
    if (!curve.is_closed) {
      drop_neighbors_of_ends(curve.points);
      if (is_short(curve.points.front(), curve.points.back())) return;
    }
    curves_.push_back(std::move(curve));
  }

  bool is_short(const Point_3& p, const Point_3& q) const { return CGAL::squared_distance(p, q) < step_ * step_ / 100; }

  /// Drops points very near to the ends of an open curve: a step may stop right before an edge of the box, or the curve
  /// may have been found there.
  void drop_neighbors_of_ends(std::vector<Point_3>& p) const {
    while (p.size() > 2 && is_short(p[0], p[1])) p.erase(p.begin() + 1);
    while (p.size() > 2 && is_short(p[p.size() - 1], p[p.size() - 2])) p.erase(p.end() - 2);
  }

  const Traits& traits_;
  const Border border_;
  const double pitch_, step_; // size of the parts of faces that are searched; length of segments
  Border_curve_tracer_3<Traits> tracer_;
  std::vector<Grid> traced_; // points of the curves, per face of the box, or of the whole sphere
  std::vector<Curve> curves_;
};

} // namespace equiaffine::internal

#endif
