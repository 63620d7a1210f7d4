// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_MOMENTS_3_H
#define EQUIAFFINE_SRC_REGISTRATION_MOMENTS_3_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace equiaffine::internal {

/// The moments of a measure in space, of an area or a volume.
struct Moments_3 {
  double measure = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// The root of the mean squared distance from the centroid.
  double size() const { return std::sqrt(covariance.trace()); }
};

/// The integrals of 1, x and x x^T, summed up part by part. Positions are taken relative to `origin`, so that little
/// cancels.
class Moment_sums_3 {
public:
  explicit Moment_sums_3(const Eigen::Vector3d& origin) : origin_(origin) {}

  void add_point(const Eigen::Vector3d& p) {
    const Eigen::Vector3d x = p - origin_;
    add(1, x, x * x.transpose());
  }

  void add_segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d x = (a + b) / 2 - origin_, half = (b - a) / 2;
    add(2 * half.norm(), x, x * x.transpose() + half * half.transpose() / 3);
  }

  /// Adds the area of a triangle.
  void add_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d x = a - origin_, y = b - origin_, z = c - origin_, sum = x + y + z;
    add((b - a).cross(c - a).norm() / 2, sum / 3, (squares(x, y, z) + sum * sum.transpose()) / 12);
  }

  /// Adds the signed volume between the origin and a triangle.
  void add_cone(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d x = a - origin_, y = b - origin_, z = c - origin_, sum = x + y + z;
    add(x.dot(y.cross(z)) / 6, sum / 4, (squares(x, y, z) + sum * sum.transpose()) / 20);
  }

  /// Adds the sums of another measure about the same origin, or subtracts them.
  void add(const Moment_sums_3& other, double sign) {
    measure_ += sign * other.measure_;
    first_ += sign * other.first_;
    second_ += sign * other.second_;
  }

  double measure() const { return measure_; }

  Moments_3 moments() const {
    const Eigen::Vector3d mean = first_ / measure_;
    return {measure_, origin_ + mean, second_ / measure_ - mean * mean.transpose()};
  }

private:
  static Eigen::Matrix3d squares(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
    return x * x.transpose() + y * y.transpose() + z * z.transpose();
  }

  void add(double measure, const Eigen::Vector3d& mean, const Eigen::Matrix3d& mean_square) {
    measure_ += measure;
    first_ += measure * mean;
    second_ += measure * mean_square;
  }

  Eigen::Vector3d origin_, first_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
  double measure_ = 0;
};

} // namespace equiaffine::internal

#endif
