// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/Fit_traits.h"

#include <equiaffine/fit/Fitted_function_traits_3.h>

#include <CGAL/tags.h>

#include <utility>

namespace equiaffine {

Fit_traits::Fit_traits(Fit fit) : fit_(std::make_shared<const Fit>(std::move(fit))) {}

double Fit_traits::value(const Point_3& p) const { return fit_->value(p); }
Jet_3<double, 1> Fit_traits::first_order(const Point_3& p) const { return fit_->first_order(p); }
Jet_3<double> Fit_traits::taylor(const Point_3& p) const { return fit_->taylor(p); }
Interval Fit_traits::bounds(const CGAL::Bbox_3& box) const { return fit_->bounds(box); }
double Fit_traits::rounding(const Point_3& p) const { return fit_->rounding(p); }
double Fit_traits::certainty(const Point_3& p) const { return fit_->certainty(p); }
CGAL::Bbox_3 Fit_traits::bbox() const { return fit_->bbox(); }
Fit_traits Fit_traits::in_box(const CGAL::Bbox_3& box) const { return Fit_traits(fit_->in_box(box)); }
Fit_traits Fit_traits::in_band(double height) const { return Fit_traits(fit_->in_band(height)); }
Fitted_structure_3<double> Fit_traits::structure(const Point_3& p) const { return fit_->structure(p); }
std::optional<double> Fit_traits::scale() const { return fit_->scale(); }
double Fit_traits::spacing(const Point_3& p) const { return fit_->spacing(p); }
std::vector<double> Fit_traits::distances_of_sheets(double distance) const {
  return fit_->distances_of_sheets<CGAL::Parallel_if_available_tag>(distance);
}
CGAL::Bbox_3 Fit_traits::band_box() const { return fit_->band_box(); }

} // namespace equiaffine
