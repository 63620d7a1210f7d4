// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_SEED_PACKING_3_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_SEED_PACKING_3_H

#include <equiaffine/delaunay/internal/Seed_grid_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/internal/sign_change.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/internal/curve_step.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Packs a surface with seeds, points that are about `packing * size(p)` apart, or nearer where a smaller distance is
/// asked for. From a box that is to be covered, seeds spread over the whole component of the surface.
template <ImplicitFunctionTraits_3 Traits, class Sizing>
class Seed_packing_3 {
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using FT = typename Traits::FT;
  using Grid = Seed_grid_3<Point_3, Vector_3>;

public:
  using Seed = typename Grid::Seed;
  static constexpr double packing = 1.1; ///< distance of seeds / bound of circumradii

  Seed_packing_3(const Traits& traits, const Clip_domain_3& domain, Sizing size)
      : traits_(traits), domain_(domain), size_(std::move(size)) {}

  const std::vector<Seed>& seeds() const { return grid_.seeds(); }

  /// Makes a vertex that the mesh has already a fixed seed, from which others keep the distance `spacing`.
  void keep_away(const Point_3& vertex, double spacing) {
    const auto jet = first_order(traits_, vertex);
    grid_.insert({vertex, unit(gradient_of<Vector_3>(jet)), spacing, true});
  }

  /// If a box has no seed, finds one in it and spreads from there. The surface is searched for up to the distance
  /// `reach` from points in the box.
  void cover(const CGAL::Bbox_3& box, double reach, double spacing) {
    constexpr int candidates = 3;
    if (grid_.has_seed_in(box)) return;
    bool is_found = false;
    for (int n = 0; n < candidates && !is_found; ++n)
      is_found = seed_surface_near(random_point(box), box, spacing, reach);
    if (!is_found) seed_edges(box, spacing);
    spread();
  }

  /// Surrounds every new seed with seeds at the distance that they keep, until there are no new ones.
  void spread() {
    for (; spread_seeds_ < grid_.seeds().size(); ++spread_seeds_) {
      const Seed seed = grid_.seeds()[spread_seeds_]; // a copy, since insertion may move the seeds
      surround(seed);
    }
  }

  /// Points are random since a regular arrangement would make the triangulation degenerate.
  Point_3 random_point(const CGAL::Bbox_3& b) {
    // Compilers differ in the order in which they evaluate arguments, and all are to make the same mesh.
    const double z = random(), y = random(), x = random();
    return Point_3(FT(b.xmin() + x * b.x_span()), FT(b.ymin() + y * b.y_span()), FT(b.zmin() + z * b.z_span()));
  }

  /// A number in [0, 1); the sequence is the same on every machine (Vigna: splitmix64, 2015).
  double random() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
    z = (z ^ z >> 27) * 0x94D049BB133111EBU;
    return std::ldexp(double((z ^ z >> 31) >> 11), -53);
  }

private:
  void surround(const Seed& seed) {
    constexpr int directions = 16;
    constexpr double jitter = 0.3;     // largest random addition to a distance, as a fraction
    constexpr double growth = 1.2;     // largest ratio of the spacings of neighbors
    constexpr double tolerance = 0.98; // the candidate is not on the surface yet
    const Vector_3 &n = seed.normal, u = tangent_at(seed), v = CGAL::cross_product(n, u);
    const double turn = random();
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * std::numbers::pi * (k + turn) / directions;
      const double distance = seed.spacing * (1 + jitter * random());
      const Point_3 p = seed.point + FT(distance * std::cos(angle)) * u + FT(distance * std::sin(angle)) * v;
      if (!domain_.contains(p)) continue;
      const double spacing = std::min(packing * size_(p), growth * seed.spacing);
      if (grid_.is_crowded({p, n, tolerance * spacing})) continue;
      const double r = spacing / 2;
      const CGAL::Bbox_3 box(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r);
      seed_surface_near(p, box, spacing, spacing);
    }
  }

  /// A unit vector orthogonal to the normal of a seed; far from parallel to the axis that it is computed from.
  static Vector_3 tangent_at(const Seed& seed) {
    const Vector_3& n = seed.normal;
    const auto is_smaller = [](const FT& a, const FT& b) { return CGAL::abs(a) < CGAL::abs(b); };
    const auto axis = std::min_element(n.cartesian_begin(), n.cartesian_end(), is_smaller) - n.cartesian_begin();
    return unit(CGAL::cross_product(n, Vector_3(FT(axis == 0), FT(axis == 1), FT(axis == 2))));
  }

  /// Makes a seed of the point of the surface near p, if a step of Newton's method leads into the box. Returns whether
  /// there is a seed now at or near that point.
  bool seed_surface_near(const Point_3& p, const CGAL::Bbox_3& box, double spacing, double reach) {
    constexpr double tolerance = 0.99; // the point is not on the surface yet
    const auto jet = first_order(traits_, p);
    const auto gradient = gradient_of<Vector_3>(jet);
    const FT squared_norm = gradient.squared_length();
    if (!(squared_norm > FT(0)) || !(jet.value() - jet.value() == FT(0))) return false;
    const Point_3 newton = p - jet.value() / squared_norm * gradient;
    if (!CGAL::do_overlap(newton.bbox(), box)) return false;
    const Vector_3 normal = unit(gradient);
    if (grid_.is_crowded({newton, normal, tolerance * spacing})) return true; // saves the projection
    const auto found = project_to_surface(traits_, p, FT(reach), jet);
    if (!found.has_converged) return false;
    insert({found.point, normal, spacing});
    return true;
  }

  /// Makes seeds where the surface crosses the edges of a box.
  void seed_edges(const CGAL::Bbox_3& box, double spacing) {
    std::array<Point_3, 8> corners;
    std::array<FT, 8> values;
    for (unsigned c = 0; c < 8; ++c) {
      corners[c] = Point_3(FT(c & 1 ? box.xmax() : box.xmin()), FT(c & 2 ? box.ymax() : box.ymin()),
                           FT(c & 4 ? box.zmax() : box.zmin()));
      values[c] = traits_.value(corners[c]);
    }
    for (unsigned c = 0; c < 8; ++c)
      for (unsigned axis = 1; axis < 8; axis *= 2) {
        const unsigned d = c | axis;
        if (c == d || !is_sign_change(values[c], values[d])) continue;
        const auto found = intersect_segment(traits_, corners[c], corners[d], values[c], values[d]);
        if (!found.has_converged) continue;
        insert({found.point, unit(gradient_of<Vector_3>(first_order(traits_, found.point))), spacing});
      }
  }

  void insert(const Seed& seed) {
    if (domain_.contains(seed.point) && !grid_.is_crowded(seed)) grid_.insert(seed);
  }

  /// v with the length 1, or the vector zero if v has no direction: at a singular point, or where f has no derivatives.
  static Vector_3 unit(const Vector_3& v) {
    const double norm = std::sqrt(CGAL::to_double(v.squared_length()));
    return norm > 0 && std::isfinite(norm) ? v / FT(norm) : Vector_3(FT(0), FT(0), FT(0));
  }

  const Traits& traits_;
  const Clip_domain_3& domain_;
  Sizing size_;
  Grid grid_;
  std::size_t spread_seeds_ = 0; // so many of the first seeds are surrounded by others
  std::uint64_t state_ = 1;      // the state of the random numbers
};

} // namespace equiaffine::internal

#endif
