// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_FIT_TRAITS_H
#define EQUIAFFINE_PROGRAM_SOURCE_FIT_TRAITS_H

#include "system/kernel.h"
#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>

#include <CGAL/Bbox_3.h>

#include <memory>
#include <optional>
#include <vector>

namespace equiaffine {

template <class>
class Fitted_function_traits_3;

/// A Fitted_function_traits_3 whose members are compiled once, so that few units read its header. Copies share the fit.
class Fit_traits {
public:
  using FT = double;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;
  using Fit = Fitted_function_traits_3<Kernel>;

  explicit Fit_traits(Fit fit);

  double value(const Point_3& p) const;
  Jet_3<double, 1> first_order(const Point_3& p) const;
  Jet_3<double> taylor(const Point_3& p) const;
  Interval bounds(const CGAL::Bbox_3& box) const;
  double rounding(const Point_3& p) const;
  double certainty(const Point_3& p) const;
  CGAL::Bbox_3 bbox() const;

  Fit_traits in_box(const CGAL::Bbox_3& box) const;
  Fit_traits in_band(double height) const;
  Fitted_structure_3<double> structure(const Point_3& p) const;
  std::optional<double> scale() const;
  double spacing(const Point_3& p) const;
  std::vector<double> distances_of_sheets(double distance) const;
  CGAL::Bbox_3 band_box() const;

  const Fit& fit() const { return *fit_; }

private:
  std::shared_ptr<const Fit> fit_;
};

} // namespace equiaffine

#endif
