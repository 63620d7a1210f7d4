// SPDX-License-Identifier: GPL-3.0-or-later
// Any_function_3, a type-erased model of ImplicitFunctionTraits_3.
#ifndef EQUIAFFINE_FUNCTION_ANY_FUNCTION_3_H
#define EQUIAFFINE_FUNCTION_ANY_FUNCTION_3_H

#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/function/capabilities.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/number_utils.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The interface of a model for Any_function_3.
class Erased_function_3 {
public:
  using Kernel = CGAL::Simple_cartesian<double>;
  using Point_3 = Kernel::Point_3;
  using Points = std::span<const Point_3>;

  virtual ~Erased_function_3() = default;
  virtual double value(const Point_3& p) const = 0;
  virtual Jet_3<double, 1> first_order(const Point_3& p) const = 0;
  virtual Jet_3<double> taylor(const Point_3& p) const = 0;
  virtual std::optional<Jet_3<double, 5>> fifth_order(const Point_3& p) const = 0;
  virtual void values(Points points, std::span<double> values) const = 0;
  virtual void first_orders(Points points, std::span<Jet_3<double, 1>> jets) const = 0;
  virtual void taylors(Points points, std::span<Jet_3<double>> jets) const = 0;
  virtual Interval bounds(const CGAL::Bbox_3& box) const = 0;
  virtual Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const = 0;
  virtual Jet_3<Interval, 1> tight_first_order_bounds(const CGAL::Bbox_3& box) const = 0;
  virtual Known_bounds known_bounds() const = 0;
  virtual double rounding(const Point_3& p) const = 0;
  virtual double certainty(const Point_3& p) const = 0;
  virtual CGAL::Bbox_3 bbox() const = 0;
  virtual Lattice_3<Kernel> lattice(const Lattice_3<Kernel>::Size& size) const = 0;
  virtual Surface_point_3<Kernel> intersect_segment(const Point_3& a, const Point_3& b, double fa, double fb) const = 0;
};

/// Implements the interface by a model, converting points and numbers.
template <class Traits>
class Erased_model_3 final : public Erased_function_3 {
public:
  explicit Erased_model_3(Traits traits) : traits_(std::move(traits)) {}

  double value(const Point_3& p) const override { return CGAL::to_double(FT(traits_.value(to_traits(p)))); }
  Jet_3<double, 1> first_order(const Point_3& p) const override {
    return in_doubles(equiaffine::first_order(traits_, to_traits(p)));
  }
  Jet_3<double> taylor(const Point_3& p) const override { return in_doubles(traits_.taylor(to_traits(p))); }
  std::optional<Jet_3<double, 5>> fifth_order(const Point_3& p) const override {
    const auto jet = equiaffine::fifth_order(traits_, to_traits(p));
    return jet ? std::optional(in_doubles(*jet)) : std::nullopt;
  }
  void values(Points points, std::span<double> values) const override {
    if constexpr (BatchImplicitFunctionTraits_3<Traits>)
      evaluate<FT>(points, values, [&](const auto& at, const auto& results) { traits_.values(at, results); });
    else
      for (std::size_t i = 0; i < points.size(); ++i) values[i] = value(points[i]);
  }
  void first_orders(Points points, std::span<Jet_3<double, 1>> jets) const override {
    if constexpr (FirstOrderBatchImplicitFunctionTraits_3<Traits>)
      evaluate<Jet_3<FT, 1>>(points, jets,
                             [&](const auto& at, const auto& results) { traits_.first_orders(at, results); });
    else
      for (std::size_t i = 0; i < points.size(); ++i) jets[i] = first_order(points[i]);
  }
  void taylors(Points points, std::span<Jet_3<double>> jets) const override {
    if constexpr (BatchImplicitFunctionTraits_3<Traits>)
      evaluate<Jet_3<FT>>(points, jets, [&](const auto& at, const auto& results) { traits_.taylors(at, results); });
    else
      for (std::size_t i = 0; i < points.size(); ++i) jets[i] = taylor(points[i]);
  }
  Interval bounds(const CGAL::Bbox_3& box) const override {
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>) return traits_.bounds(box);
    else return Interval::whole();
  }
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const override {
    return equiaffine::first_order_bounds(traits_, box);
  }
  Jet_3<Interval, 1> tight_first_order_bounds(const CGAL::Bbox_3& box) const override {
    return equiaffine::tight_first_order_bounds(traits_, box);
  }
  Known_bounds known_bounds() const override { return equiaffine::known_bounds(traits_); }
  double rounding(const Point_3& p) const override {
    return CGAL::to_double(equiaffine::rounding(traits_, to_traits(p)));
  }
  double certainty(const Point_3& p) const override { return equiaffine::certainty(traits_, to_traits(p)); }
  CGAL::Bbox_3 bbox() const override { return traits_.bbox(); }
  Lattice_3<Kernel> lattice(const Lattice_3<Kernel>::Size& size) const override {
    const auto lattice = equiaffine::sampling_lattice(traits_, size);
    if constexpr (std::is_same_v<Kernel_of<Traits>, Kernel>) return lattice;
    else return in_doubles(lattice);
  }
  Surface_point_3<Kernel> intersect_segment(const Point_3& a, const Point_3& b, double fa, double fb) const override {
    const auto found = equiaffine::intersect_segment(traits_, to_traits(a), to_traits(b), FT(fa), FT(fb));
    return {convert_point<Kernel>(found.point), found.has_converged, found.evaluations, found.is_at_pole,
            found.is_at_end};
  }

private:
  using FT = typename Traits::FT;

  static typename Traits::Point_3 to_traits(const Point_3& p) { return convert_point<Kernel_of<Traits>>(p); }

  static double in_doubles(const FT& x) { return CGAL::to_double(x); }

  template <int Order>
  static Jet_3<double, Order> in_doubles(const Jet_3<FT, Order>& jet) {
    Jet_3<double, Order> result;
    for (std::size_t n = 0; n < result.size; ++n) result.coefficients()[n] = CGAL::to_double(jet.coefficients()[n]);
    return result;
  }

  static Lattice_3<Kernel> in_doubles(const Lattice_3<Kernel_of<Traits>>& lattice) {
    const auto& [x, y, z] = lattice.steps();
    const auto vector = [](const auto& v) {
      return Kernel::Vector_3(CGAL::to_double(v.x()), CGAL::to_double(v.y()), CGAL::to_double(v.z()));
    };
    return Lattice_3<Kernel>(lattice.size(), convert_point<Kernel>(lattice.origin()),
                             {vector(x), vector(y), vector(z)});
  }

  /// Calls a batch member of the model; converts points and results if their types differ.
  template <class Own_result, class Result, class Evaluate>
  static void evaluate(Points points, std::span<Result> results, const Evaluate& evaluate_at) {
    if constexpr (std::is_same_v<typename Traits::Point_3, Point_3> && std::is_same_v<Own_result, Result>) {
      evaluate_at(points, results);
    } else {
      std::vector<typename Traits::Point_3> at;
      at.reserve(points.size());
      for (const Point_3& p : points) at.push_back(to_traits(p));
      std::vector<Own_result> own(results.size());
      evaluate_at(std::span<const typename Traits::Point_3>(at), std::span(own));
      for (std::size_t i = 0; i < own.size(); ++i) results[i] = in_doubles(own[i]);
    }
  }

  Traits traits_;
};

} // namespace equiaffine::internal

namespace equiaffine {

/// Holds any model of ImplicitFunctionTraits_3 with its capabilities behind one type, so that code that is slow to
/// compile is compiled once. Models FirstOrderBatchImplicitFunctionTraits_3 and
/// FirstOrderBoundedImplicitFunctionTraits_3 with doubles; known_bounds() returns which bounds the held model has. Each
/// call is a virtual one, also for batches and for a root on a segment. Copies share the model.
class Any_function_3 {
public:
  using Kernel = CGAL::Simple_cartesian<double>; ///< the kernel
  using FT = double;                             ///< the number type
  using Point_3 = Kernel::Point_3;               ///< points
  using Vector_3 = Kernel::Vector_3;             ///< vectors

  /// Wraps a model. An Any_function_3 is returned unchanged.
  template <ImplicitFunctionTraits_3 Traits>
  static Any_function_3 make(Traits traits) {
    return Any_function_3(std::make_shared<internal::Erased_model_3<Traits>>(std::move(traits)));
  }
  static Any_function_3 make(Any_function_3 function) { return function; } ///< returns `function`

  double value(const Point_3& p) const { return function_->value(p); }                       ///< f(p)
  Jet_3<double, 1> first_order(const Point_3& p) const { return function_->first_order(p); } ///< value and gradient
  Jet_3<double> taylor(const Point_3& p) const { return function_->taylor(p); } ///< the expansion of order 4
  /// The expansion of order 5, if the held model has one.
  std::optional<Jet_3<double, 5>> fifth_order(const Point_3& p) const { return function_->fifth_order(p); }
  /// Sets values[i] to value(points[i]).
  void values(std::span<const Point_3> points, std::span<double> values) const { function_->values(points, values); }
  /// Sets jets[i] to first_order(points[i]).
  void first_orders(std::span<const Point_3> points, std::span<Jet_3<double, 1>> jets) const {
    function_->first_orders(points, jets);
  }
  /// Sets jets[i] to taylor(points[i]).
  void taylors(std::span<const Point_3> points, std::span<Jet_3<double>> jets) const {
    function_->taylors(points, jets);
  }
  /// Bounds of the value; the whole real line if the held model has none.
  Interval bounds(const CGAL::Bbox_3& box) const { return function_->bounds(box); }
  /// first_order_bounds(model, box) of the held model.
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const { return function_->first_order_bounds(box); }
  /// tight_first_order_bounds(model, box) of the held model.
  Jet_3<Interval, 1> tight_first_order_bounds(const CGAL::Bbox_3& box) const {
    return function_->tight_first_order_bounds(box);
  }
  Known_bounds known_bounds() const { return function_->known_bounds(); }      ///< the bounds of the held model
  double rounding(const Point_3& p) const { return function_->rounding(p); }   ///< that of the held model, or 0
  double certainty(const Point_3& p) const { return function_->certainty(p); } ///< that of the held model, or 1
  CGAL::Bbox_3 bbox() const { return function_->bbox(); }                      ///< the box of the held model
  /// The lattice of the given size on which to sample the held model.
  Lattice_3<Kernel> lattice(const Lattice_3<Kernel>::Size& size) const { return function_->lattice(size); }
  /// Finds a zero on the segment ab, with one call of the held model.
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
