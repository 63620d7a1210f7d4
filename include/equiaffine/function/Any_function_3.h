// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_ANY_FUNCTION_3_H
#define EQUIAFFINE_FUNCTION_ANY_FUNCTION_3_H

#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/internal/Erased_function_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>

#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace equiaffine {

/// Holds any model of ImplicitFunctionTraits_3 behind one type, with its capabilities, so that code that is expensive
/// to compile is compiled once. It is a model of FirstOrderBatchImplicitFunctionTraits_3 and of
/// FirstOrderBoundedImplicitFunctionTraits_3 in doubles; known_bounds() says which bounds the held model has. Each call
/// is a virtual one, also those for many points and for a root on a segment. Copies share the model.
class Any_function_3 {
public:
  using Kernel = CGAL::Simple_cartesian<double>; ///< the kernel
  using FT = double;                             ///< the number type
  using Point_3 = Kernel::Point_3;               ///< points
  using Vector_3 = Kernel::Vector_3;             ///< vectors

  /// Holds a model; one that is an Any_function_3 already is returned as it is.
  template <ImplicitFunctionTraits_3 Traits>
  static Any_function_3 make(Traits traits) {
    return Any_function_3(std::make_shared<internal::Erased_model_3<Traits>>(std::move(traits)));
  }
  static Any_function_3 make(Any_function_3 function) { return function; } ///< returns it as it is

  double value(const Point_3& p) const { return function_->value(p); }                       ///< f(p)
  Jet_3<double, 1> first_order(const Point_3& p) const { return function_->first_order(p); } ///< value and gradient
  Jet_3<double> taylor(const Point_3& p) const { return function_->taylor(p); } ///< the expansion of order 4
  /// The expansion of order 5, if the held model has that.
  std::optional<Jet_3<double, 5>> fifth_order(const Point_3& p) const { return function_->fifth_order(p); }
  /// values[i] becomes value(points[i]).
  void values(std::span<const Point_3> points, std::span<double> values) const { function_->values(points, values); }
  /// jets[i] becomes first_order(points[i]).
  void first_orders(std::span<const Point_3> points, std::span<Jet_3<double, 1>> jets) const {
    function_->first_orders(points, jets);
  }
  /// jets[i] becomes taylor(points[i]).
  void taylors(std::span<const Point_3> points, std::span<Jet_3<double>> jets) const {
    function_->taylors(points, jets);
  }
  /// Bounds of the value, the whole line if the held model has none.
  Interval bounds(const CGAL::Bbox_3& box) const { return function_->bounds(box); }
  /// Returns what the free function first_order_bounds() says of the held model.
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const { return function_->first_order_bounds(box); }
  /// Returns what the free function tight_first_order_bounds() says of the held model.
  Jet_3<Interval, 1> tight_first_order_bounds(const CGAL::Bbox_3& box) const {
    return function_->tight_first_order_bounds(box);
  }
  Known_bounds known_bounds() const { return function_->known_bounds(); }      ///< the bounds that the held model has
  double rounding(const Point_3& p) const { return function_->rounding(p); }   ///< that of the held model, or 0
  double certainty(const Point_3& p) const { return function_->certainty(p); } ///< that of the held model, or 1
  CGAL::Bbox_3 bbox() const { return function_->bbox(); }                      ///< the box of the held model
  /// The lattice of that size on which to sample the held model.
  Lattice_3<Kernel> lattice(const Lattice_3<Kernel>::Size& size) const { return function_->lattice(size); }
  /// Finds a zero on the segment ab by one call of the held model.
  Surface_point_3<Kernel> intersect_segment(const Point_3& a, const Point_3& b, double fa, double fb) const {
    return function_->intersect_segment(a, b, fa, fb);
  }

private:
  explicit Any_function_3(std::shared_ptr<const internal::Erased_function_3> function)
      : function_(std::move(function)) {}

  std::shared_ptr<const internal::Erased_function_3> function_;
};

} // namespace equiaffine

#endif
