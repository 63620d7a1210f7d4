// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_BLEND_3_H
#define EQUIAFFINE_FIT_INTERNAL_BLEND_3_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/fit/internal/Normalization_3.h>
#include <equiaffine/fit/internal/Patch_cover_3.h>
#include <equiaffine/fit/internal/Point_tree_3.h>
#include <equiaffine/number/Jet_3.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_set>
#include <vector>

namespace equiaffine::internal {

/// One function from many patches: the mean of the patches around a point with weights (1 - |p - c|^2 / R^2)^6, where c
/// is the center of a patch and R a part of its radius. It is defined near the points only.
///
/// Another sheet of the surface may lie within R. Since a patch of that sheet is not to have a say on this one, its
/// weight is multiplied by (1 - (g / b)^2)^6, where g is its value and b is a part of the distance from its center to
/// the nearest point that is not connected with it.
class Blend_3 {
public:
  using Vector = Eigen::Vector3d;

  template <class ConcurrencyTag>
  Blend_3(const Data_points_3& data, const Fit_choice_3& choices, ConcurrencyTag tag)
      : data_(&data), points_(data.points) {
    auto cover = patch_cover(data, choices, reach * distance_of_centers, tag);
    std::vector<Data_points_3::Index> centers;
    for (std::size_t k = 0; k < cover.centers.size(); ++k) {
      if (!cover.fits[k]) continue;
      centers.push_back(cover.centers[k]);
      radii_.push_back(reach * cover.fits[k]->patch.radius);
      patches_.push_back(std::move(cover.fits[k]->patch));
    }
    gates_.resize(patches_.size());
    parallel_for<ConcurrencyTag>(0, patches_.size(), [&](std::size_t k) { gates_[k] = gate(centers[k], radii_[k]); });
    std::vector<Vector> places;
    for (const auto& patch : patches_) places.push_back(patch.center);
    balls_ = Ball_tree_3(places, radii_);
    std::vector<double> reaches;
    for (const double spacing : data.spacing) reaches.push_back(std::hypot(half_band, border) * spacing);
    band_ = Ball_tree_3(data.points, reaches);
  }

  /// Returns whether the function may have a value at a point: whether it is near the nearest of the data, as seen
  /// along the normal and across it.
  bool is_in_band(const Vector& p) const {
    const auto nearest = points_.nearest(p, 1);
    if (nearest.empty()) return false;
    const auto i = nearest.front();
    const Vector difference = p - data_->points[i];
    const double height = difference.dot(data_->normals[i]);
    const double across = difference.squaredNorm() - height * height;
    const double spacing = data_->spacing[i];
    return std::abs(height) <= half_band * spacing && across <= border * border * spacing * spacing;
  }

  /// Returns whether some point of a box, given by its corners, may be in the band.
  bool may_meet_band(const Vector& lower, const Vector& upper) const { return band_.meets(lower, upper); }

  double value(const Vector& p) const {
    double sum = 0, weights = 0;
    if (is_in_band(p))
      balls_.for_each_around(p, [&](std::size_t k) {
        const double rest = 1 - (p - patches_[k].center).squaredNorm() / (radii_[k] * radii_[k]);
        if (!(rest > 0)) return;
        const double g = patches_[k].value(p), opening = 1 - g * g / (gates_[k] * gates_[k]);
        if (!(opening > 0)) return;
        const double root = rest * opening, weight = root * root * root * root * root * root;
        sum += weight * g;
        weights += weight;
      });
    return sum / weights; // not a number without patches
  }

  template <int Order>
  Jet_3<double, Order> taylor(const Vector& p) const {
    using Jet = Jet_3<double, Order>;
    Jet sum(0.), weights(0.);
    if (is_in_band(p))
      balls_.for_each_around(p, [&](std::size_t k) {
        const Vector difference = p - patches_[k].center;
        const double factor = 1 / (radii_[k] * radii_[k]), rest = 1 - difference.squaredNorm() * factor;
        if (!(rest > 0)) return;
        const Jet g = patches_[k].template taylor<Order>(p);
        const double width = 1 / (gates_[k] * gates_[k]);
        if (!(g.value() * g.value() * width < 1)) return;
        Jet root(rest);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          root.coefficients()[1 + axis] = -2 * factor * difference[Eigen::Index(axis)];
          if constexpr (Order > 1) root.coefficients()[std::size_t(std::array<int, 3>{4, 7, 9}[axis])] = -factor;
        }
        if (std::isfinite(gates_[k])) root = root * (Jet(1.) - square(g) * width);
        const Jet cube = square(root) * root, weight = square(cube);
        sum += weight * g;
        weights += weight;
      });
    if (!(weights.value() > 0)) return Jet(std::numeric_limits<double>::quiet_NaN());
    return sum / weights;
  }

  /// Returns the box of the band in the coordinates of the data.
  CGAL::Bbox_3 band_box(const Normalization_3& normalization) const {
    CGAL::Bbox_3 box;
    const Eigen::Matrix3d inverse = normalization.matrix.inverse();
    const Vector reach_of_axes = inverse.rowwise().norm();
    for (std::size_t i = 0; i < data_->size(); ++i) {
      const Vector p = normalization.origin + inverse * data_->points[i];
      const Vector half = std::hypot(half_band, border) * data_->spacing[i] * reach_of_axes;
      box +=
          CGAL::Bbox_3(p[0] - half[0], p[1] - half[1], p[2] - half[2], p[0] + half[0], p[1] + half[1], p[2] + half[2]);
    }
    return box;
  }

  std::size_t number_of_patches() const { return patches_.size(); }

private:
  static constexpr double reach = 0.75, distance_of_centers = 0.3, half_band = 2, border = 1.25, safety = 0.7;

  double gate(Data_points_3::Index center, double radius) const {
    const auto ball = connected_ball(*data_, center, 1.3 * radius);
    const std::unordered_set<Data_points_3::Index> connected(ball.begin(), ball.end());
    double least = std::numeric_limits<double>::infinity();
    points_.for_each_in_cube(data_->points[center], radius, [&](Data_points_3::Index i) {
      if (!connected.contains(i)) least = std::min(least, (data_->points[i] - data_->points[center]).norm());
    });
    return safety * least;
  }

  const Data_points_3* data_;
  Point_tree_3 points_;
  std::vector<Patch_3> patches_;
  std::vector<double> radii_, gates_;
  Ball_tree_3 balls_, band_;
};

} // namespace equiaffine::internal

#endif
