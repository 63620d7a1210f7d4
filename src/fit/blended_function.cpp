// SPDX-License-Identifier: GPL-3.0-or-later
// Library side of Fitted_function_traits_3: the blend of fits, and close sheets of the data.
#include "fit/Blend_3.h"
#include "fit/Data_points_3.h"
#include "fit/Fitted_data_3.h"
#include "fit/fit_input.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/fit/Close_sheets.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/number/Jet_3.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

namespace {

/// The blend of the fits to data.
class Blended_function_3 final : public Fitted_function_3 {
public:
  Blended_function_3(bool in_threads, Normalized_data data, const Fit_options& options)
      : fit_(in_threads, std::move(data), options), blend_(in_threads, fit_.data(), fit_.choices()) {}

  double value(const Vector& p, const Band_margin& margin) const override {
    return blend_.value(normal(p), margin) / fit_.normalization().scale();
  }
  Jet_3<double, 1> first_order(const Vector& p) const override { return fit_.to_space(blend_.taylor<1>(normal(p))); }
  Jet_3<double> taylor(const Vector& p) const override { return fit_.to_space(blend_.taylor<4>(normal(p))); }

  double rounding(const Vector& p) const override {
    const Vector place = normal(p);
    const auto jet = blend_.taylor<4>(place);
    return std::isfinite(jet.value()) ? rounding_of(jet, fit_, blend_.accuracy(place, jet)) : jet.value();
  }

  Fitted_structure_3<double> structure(const Vector& p) const override {
    const Vector place = normal(p);
    const auto jet = blend_.taylor<4>(place);
    if (!std::isfinite(jet.value())) return structure_without_fit();
    return structure_of(jet, fit_, blend_.accuracy(place, jet), Orientation_of_level_set::ALONG_GRADIENT);
  }

  double spacing(const Vector& p) const override {
    return blend_.band().spacing(normal(p)) / fit_.normalization().scale();
  }

  Vector on_tangent_plane(const Vector& p) const override {
    return fit_.normalization().inverse(blend_.band().on_tangent_plane(normal(p)));
  }

  std::optional<double> scale() const override { return fit_.scale(); }

  CGAL::Bbox_3 box() const override { return blend_.band().box(fit_.normalization()); }

  Band_margin margin(double height) const override {
    const double least = fit_.normalization().least_stretch(), greatest = fit_.normalization().greatest_stretch();
    return {height * greatest, 0.5 * least / greatest};
  }

  bool may_meet(const CGAL::Bbox_3& box, const Band_margin& margin) const override {
    const Vector lower(box.xmin(), box.ymin(), box.zmin()), upper(box.xmax(), box.ymax(), box.zmax());
    const Vector center = normal((lower + upper) / 2);
    const Vector half = fit_.normalization().matrix.cwiseAbs() * ((upper - lower) / 2);
    return blend_.band().may_meet(center - half, center + half, margin);
  }

  const Fitted_data_3& data() const override { return fit_; }

private:
  Vector normal(const Vector& p) const { return fit_.normalization()(p); }

  Fitted_data_3 fit_;
  Blend_3 blend_;
};

/// Whether two points belong to parts that meet at a crease, or are both on creases of parts that meet the same
/// third part.
bool are_beside_crease(const Data_points_3& data, Data_points_3::Index i, Data_points_3::Index j) {
  const Charts_3& charts = data.charts;
  if (charts.of(i) == charts.of(j)) return false;
  if (charts.bend.contains({charts.of(i), charts.of(j)})) return true;
  return charts.has_crease_at(i) && charts.has_crease_at(j) &&
         charts.relation(charts.of(i), charts.of(j)) != Charts_3::Relation::NONE;
}

/// For each point, the distance along its normal, in the coordinates of the data, to the nearest point of another
/// sheet within a spacing across, if it is less than `greatest` and about ten spacings. Points are on different
/// sheets if they are not connected nearby, or if their normals are opposite, as on both sides of a thin plate or
/// tube.
std::vector<double> distances_of_sheets(bool in_threads, const Fitted_data_3& fit, double greatest) {
  using Index = Data_points_3::Index;
  const Data_points_3& data = fit.data();
  const Eigen::Matrix3d to_space = fit.normalization().matrix.inverse();
  const Point_tree_3 tree(data.points);
  std::vector<double> distances(data.size(), std::numeric_limits<double>::infinity());
  constexpr double most_spacings = 10; // bounds the number of neighbors per point
  const auto measure = [&](std::size_t i) {
    const double limit = std::min(greatest * fit.normalization().greatest_stretch(), most_spacings * data.spacing[i]);
    const double reach = std::hypot(limit, data.spacing[i]);
    const auto ball = connected_ball(data, Index(i), 1.3 * reach);
    const std::unordered_set<Index> connected(ball.begin(), ball.end());
    const Eigen::Vector3d normal = (fit.normalization().matrix.transpose() * data.normals[i]).normalized();
    tree.for_each_in_cube(data.points[i], reach, [&](Index j) {
      if (are_beside_crease(data, Index(i), j)) return;
      const Eigen::Vector3d difference = data.points[j] - data.points[i];
      const double across = (difference - difference.dot(data.normals[i]) * data.normals[i]).norm();
      const bool is_other = data.normals[i].dot(data.normals[j]) < 0 || !connected.contains(j);
      if (is_other && across < data.spacing[i])
        distances[i] = std::min(distances[i], std::abs((to_space * difference).dot(normal)));
    });
  };
  parallel_for(in_threads, 0, data.size(), measure, 64);
  std::erase_if(distances, [&](double distance) { return !(distance < greatest); });
  return distances;
}

} // namespace

std::shared_ptr<const Fitted_function_3> fitted_function(bool in_threads, Fit_data_3 given,
                                                         const Fit_options& options) {
  options.check();
  return std::make_shared<const Blended_function_3>(in_threads, fit_input(in_threads, std::move(given), options).data,
                                                    options);
}

Close_sheets close_sheets(bool in_threads, const Fitted_data_3& fit, const CGAL::Bbox_3& box, double longest_step) {
  constexpr double steps_between_sheets = 1.5;
  std::vector<double> distances = distances_of_sheets(in_threads, fit, longest_step);
  if (distances.empty()) return {0, std::numeric_limits<double>::quiet_NaN(), 0};
  const std::size_t count = distances.size();
  const double tenth = nth_smallest(std::move(distances), count / 10);
  const double longest = std::max({box.x_span(), box.y_span(), box.z_span()});
  return {count, tenth, std::size_t(std::min(1e9, steps_between_sheets * longest / tenth)) + 2};
}

} // namespace equiaffine::internal
