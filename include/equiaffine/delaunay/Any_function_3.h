// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_ANY_FUNCTION_3_H
#define EQUIAFFINE_DELAUNAY_ANY_FUNCTION_3_H

#include <equiaffine/delaunay/internal/convert_point.h>
#include <equiaffine/function/first_order_bounds.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/number_utils.h>

#include <memory>
#include <utility>

namespace equiaffine {

/// Holds any model of ImplicitFunctionTraits_3 behind one type, so that code that is expensive to compile is compiled
/// once. The model finds a root on a segment within a single virtual call. Copies share the model.
class Any_function_3 {
public:
  using Kernel = CGAL::Simple_cartesian<double>;
  using FT = double;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;

  template <ImplicitFunctionTraits_3 Traits>
  static Any_function_3 make(Traits traits) {
    return Any_function_3(std::make_shared<Model<Traits>>(std::move(traits)));
  }

  double value(const Point_3& p) const { return function_->value(p); }
  Jet_3<double, 1> first_order(const Point_3& p) const { return function_->first_order(p); }
  Jet_3<double> taylor(const Point_3& p) const { return function_->taylor(p); }
  Interval bounds(const CGAL::Bbox_3& box) const { return function_->bounds(box); }
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const { return function_->first_order_bounds(box); }
  Jet_3<Interval, 1> mean_value_bounds(const CGAL::Bbox_3& box) const { return function_->mean_value_bounds(box); }
  internal::Known_bounds known_bounds() const { return function_->known_bounds(); }
  CGAL::Bbox_3 bbox() const { return function_->bbox(); }

  /// The model's own `equiaffine::intersect_segment`.
  Surface_point_3<Kernel> intersect_segment(const Point_3& a, const Point_3& b, double fa, double fb) const {
    return function_->intersect_segment(a, b, fa, fb);
  }

private:
  struct Concept {
    virtual ~Concept() = default;
    virtual double value(const Point_3& p) const = 0;
    virtual Jet_3<double, 1> first_order(const Point_3& p) const = 0;
    virtual Jet_3<double> taylor(const Point_3& p) const = 0;
    virtual Interval bounds(const CGAL::Bbox_3& box) const = 0;
    virtual Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const = 0;
    virtual Jet_3<Interval, 1> mean_value_bounds(const CGAL::Bbox_3& box) const = 0;
    virtual internal::Known_bounds known_bounds() const = 0;
    virtual CGAL::Bbox_3 bbox() const = 0;
    virtual Surface_point_3<Kernel> intersect_segment(const Point_3& a, const Point_3& b, double fa,
                                                      double fb) const = 0;
  };

  template <class Traits>
  struct Model final : Concept {
    explicit Model(Traits t) : traits(std::move(t)) {}

    static typename Traits::Point_3 to_traits(const Point_3& p) {
      return internal::convert_point<Kernel_of<Traits>>(p);
    }

    template <int Order, class FT>
    static Jet_3<double, Order> to_double(const Jet_3<FT, Order>& jet) {
      Jet_3<double, Order> result;
      for (std::size_t n = 0; n < result.size; ++n) result.coefficients()[n] = CGAL::to_double(jet.coefficients()[n]);
      return result;
    }

    double value(const Point_3& p) const override { return CGAL::to_double(traits.value(to_traits(p))); }
    Jet_3<double, 1> first_order(const Point_3& p) const override {
      return to_double(equiaffine::first_order(traits, to_traits(p)));
    }
    Jet_3<double> taylor(const Point_3& p) const override { return to_double(traits.taylor(to_traits(p))); }
    Interval bounds(const CGAL::Bbox_3& box) const override {
      if constexpr (BoundedImplicitFunctionTraits_3<Traits>) return traits.bounds(box);
      else return Interval::whole();
    }
    Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const override {
      return internal::first_order_bounds(traits, box);
    }
    Jet_3<Interval, 1> mean_value_bounds(const CGAL::Bbox_3& box) const override {
      return internal::tight_first_order_bounds(traits, box);
    }
    internal::Known_bounds known_bounds() const override { return internal::known_bounds(traits); }
    CGAL::Bbox_3 bbox() const override { return traits.bbox(); }
    Surface_point_3<Kernel> intersect_segment(const Point_3& a, const Point_3& b, double fa, double fb) const override {
      using FT = typename Traits::FT;
      const auto found = equiaffine::intersect_segment(traits, to_traits(a), to_traits(b), FT(fa), FT(fb));
      return {internal::convert_point<Kernel>(found.point), found.has_converged, found.evaluations, found.is_at_pole,
              found.is_at_end};
    }

    Traits traits;
  };

  explicit Any_function_3(std::shared_ptr<const Concept> function) : function_(std::move(function)) {}

  std::shared_ptr<const Concept> function_;
};

} // namespace equiaffine

#endif
