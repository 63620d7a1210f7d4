// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/Blend_3.h"
#include "fit/Fitted_data_3.h"
#include "fit/fit_input.h"
#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/fit/internal/Fit_request.h>
#include <equiaffine/fit/internal/Fitted_function_3.h>
#include <equiaffine/fit/internal/fits.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/number/Jet_3.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace equiaffine::internal {

namespace {

/// The blend of the fits to data.
class Blended_function_3 final : public Fitted_function_3 {
public:
  Blended_function_3(bool in_threads, Normalized_data data, const Fit_request& request)
      : fit_(in_threads, std::move(data), request), blend_(in_threads, fit_.data(), fit_.choices()) {}

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

} // namespace

std::shared_ptr<const Fitted_function_3> fitted_function(bool in_threads, Fit_data_3 given,
                                                         const Fit_request& request) {
  return std::make_shared<const Blended_function_3>(in_threads, fit_input(in_threads, std::move(given)).data, request);
}

} // namespace equiaffine::internal
