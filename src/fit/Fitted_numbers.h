// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers whose errors fits estimate, and the calibration of these estimates.
#ifndef EQUIAFFINE_SRC_FIT_FITTED_NUMBERS_H
#define EQUIAFFINE_SRC_FIT_FITTED_NUMBERS_H

#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/geometry/euclidean_structure.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/Linear_substitution_3.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace equiaffine::internal {

/// The numbers of a surface, and two directions, whose errors fits estimate, in the order of `Number_errors`.
enum Fitted_number : Eigen::Index {
  AFFINE_GAUSSIAN, ///< K
  AFFINE_MEAN,     ///< H
  PICK,            ///< J
  AREA_DENSITY,    ///< |K_e|^(1/4)
  GAUSSIAN,        ///< K_e
  MEAN,            ///< H_e
  K1,
  K2,
  AFFINE_NORMAL, ///< components start here
  NORMAL,
  number_of_fitted_numbers
};

/// One entry for each `Fitted_number`. For a direction it is an angle in radians.
using Number_errors = Eigen::Array<double, number_of_fitted_numbers, 1>;

/// The scalars, and the components of the two vectors.
struct Fitted_numbers {
  static constexpr Eigen::Index size = AFFINE_NORMAL + 6;
  using Components = Eigen::Matrix<double, size, 1>;
  Components components;

  explicit Fitted_numbers(const Jet_3<double>& jet) {
    const Monge_chart_3<double> chart(jet);
    const auto affine = affine_invariants(chart);
    const auto euclidean = euclidean_structure(chart);
    components << affine.gaussian_curvature, affine.mean_curvature, affine.pick_invariant,
        std::pow(std::abs(euclidean.gaussian_curvature), 0.25), euclidean.gaussian_curvature, euclidean.mean_curvature,
        euclidean.k1, euclidean.k2, affine.normal[0], affine.normal[1], affine.normal[2], euclidean.normal[0],
        euclidean.normal[1], euclidean.normal[2];
  }

  Eigen::Vector3d affine_normal() const { return components.segment<3>(AFFINE_NORMAL); }
  Eigen::Vector3d normal() const { return components.segment<3>(AFFINE_NORMAL + 3); }

  /// The reference magnitudes for relative errors. They do not vanish where a curvature changes sign: |K| + H^2 plus
  /// a fraction of K of a sphere with that K_e, because K and H of a paraboloid are zero; the curvedness; and 1 for
  /// angles.
  Number_errors sizes() const {
    const double of_affine = std::abs(components[AFFINE_GAUSSIAN]) + components[AFFINE_MEAN] * components[AFFINE_MEAN] +
                             0.01 * std::pow(components[AREA_DENSITY], 6);
    const double curved = curvedness(components[K1], components[K2]), root = std::sqrt(of_affine);
    Number_errors sizes;
    sizes << of_affine, root, root, components[AREA_DENSITY], curved * curved, curved, curved, curved, 1, 1;
    return sizes;
  }

  /// The distances from the numbers of another fit.
  Number_errors differences(const Fitted_numbers& other) const {
    const auto angle = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return std::atan2(a.cross(b).norm(), a.dot(b));
    };
    Number_errors result;
    result.head<AFFINE_NORMAL>() = (components - other.components).head<AFFINE_NORMAL>().cwiseAbs();
    result[AFFINE_NORMAL] = angle(affine_normal(), other.affine_normal());
    result[NORMAL] = angle(normal(), other.normal());
    return result;
  }

  /// The standard deviations of the numbers if independent errors of unit variance change the components by the rows
  /// of `influence`. For a direction, twice this value covers 19 of 20 angles, which have a Rayleigh distribution.
  Number_errors deviations(const Eigen::Matrix<double, Eigen::Dynamic, size>& influence) const {
    Number_errors result;
    result.head<AFFINE_NORMAL>() = influence.leftCols<AFFINE_NORMAL>().colwise().norm().transpose();
    const auto angle = [&](const Eigen::Vector3d& v, Eigen::Index first) {
      const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - v * v.transpose() / v.squaredNorm();
      constexpr double rayleigh = 2.448 / 2;
      return rayleigh * (influence.middleCols<3>(first) * across).norm() / (std::sqrt(2) * v.norm());
    };
    result[AFFINE_NORMAL] = angle(affine_normal(), AFFINE_NORMAL);
    result[NORMAL] = angle(normal(), AFFINE_NORMAL + 3);
    return result;
  }
};

/// The map from the coordinates of a fit to those of the data, to convert jets to numbers of the data.
class Jets_of_data {
public:
  /// `matrix` maps the data to the coordinates of the fit.
  explicit Jets_of_data(const Eigen::Matrix3d& matrix) : substitution_(rows(matrix)) {}

  Fitted_numbers numbers(const Jet_3<double>& jet) const { return Fitted_numbers(substitution_(jet)); }

  /// The derivatives of the components with respect to the coefficients of the jet, by central differences with a
  /// step of 1e-4 of a coefficient: a standard deviation needs few digits.
  Eigen::Matrix<double, Eigen::Dynamic, Fitted_numbers::size> gradient(const Jet_3<double>& jet) const {
    Eigen::Matrix<double, Eigen::Dynamic, Fitted_numbers::size> result(jet.size, Fitted_numbers::size);
    result.row(0).setZero();
    for (std::size_t n = 1; n < jet.size; ++n) {
      Jet_3<double> above = jet, below = jet;
      const double step = 1e-4 * std::max(0.01, std::abs(jet.coefficients()[n]));
      above.coefficients()[n] += step;
      below.coefficients()[n] -= step;
      result.row(Eigen::Index(n)) = (numbers(above).components - numbers(below).components) / (2 * step);
    }
    return result;
  }

private:
  static Linear_substitution_3<double>::Matrix rows(const Eigen::Matrix3d& matrix) {
    Linear_substitution_3<double>::Matrix rows;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) rows[i][j] = matrix(Eigen::Index(i), Eigen::Index(j));
    return rows;
  }

  Linear_substitution_3<double> substitution_;
};

/// The sources of errors of the numbers of a fit, each with its own factors.
enum class Source_of_error {
  DETAIL, ///< approximation error, because the data are exact
  BOTH,   ///< detail, and noise below a fiftieth of the spacing of the points
  NOISE,  ///< detail, and more noise
  SCALE   ///< noise alone, because the numbers are those at a scale
};

/// Data are exact if their noise is below this fraction of their spacing.
constexpr double noise_of_exact_data = 1e-4;

/// Returns the source of errors without a scale. `noise` is relative to the spacing of the points.
inline Source_of_error source_of_error(double noise) {
  constexpr double much_noise = 0.02;
  if (noise <= noise_of_exact_data) return Source_of_error::DETAIL;
  return noise < much_noise ? Source_of_error::BOTH : Source_of_error::NOISE;
}

/// The factors by which error estimates must be multiplied to cover the errors at 95 % of the points with estimates
/// below one half, and at 91.5 % on all meshes but one, up to a factor of 4. They are computed by
/// benchmark/fit/calibrate-fits, from surfaces whose numbers are known, with and without noise, and for a scale from
/// halves of scans.
inline Number_errors calibration(Source_of_error source) {
  // of K, H, J, |K_e|^(1/4), K_e, H_e, k1, k2, the affine normal and the normal
  using Row = std::array<double, std::size_t(number_of_fitted_numbers)>;
  static constexpr std::array<Row, 4> rows = {{
      {2.1, 2.8, 3.0, 1.4, 0.9, 1.5, 1.4, 1.5, 2.6, 1.7}, // DETAIL
      {2.5, 2.2, 2.7, 1.9, 1.9, 1.8, 1.8, 2.1, 1.9, 2.1}, // BOTH
      {4.0, 2.4, 4.0, 4.0, 4.0, 3.8, 3.5, 3.5, 4.0, 4.0}, // NOISE
      {2.0, 2.3, 2.0, 2.2, 2.1, 2.0, 2.3, 2.1, 2.5, 2.5}, // SCALE
  }};
  return Eigen::Map<const Number_errors>(rows[std::size_t(source)].data());
}

} // namespace equiaffine::internal

#endif
