// SPDX-License-Identifier: GPL-3.0-or-later
// Archetypes of the concepts of functions: classes that meet the requirements of a concept, and nothing more. They have
// no default constructor and no assignment. For "convertible to" they return an object that can be converted only once.
// Code that compiles with an archetype needs only what the concept guarantees.
#ifndef EQUIAFFINE_TEST_SUPPORT_ARCHETYPES_H
#define EQUIAFFINE_TEST_SUPPORT_ARCHETYPES_H

#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/function/expand.h>

#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace archetypes {

using equiaffine::Interval;
using equiaffine::Jet_3;
using equiaffine::Pack;

/// A type that is only convertible to T, and only as a temporary.
template <class T>
class Convertible_to {
public:
  explicit Convertible_to(T value) : value_(std::move(value)) {}
  Convertible_to(const Convertible_to&) = delete;
  Convertible_to& operator=(const Convertible_to&) = delete;
  operator T() && { return std::move(value_); }

private:
  T value_;
};

/// x^2 + y^2 + z^2 - 1.
struct Sphere {
  static auto at(const auto& x, const auto& y, const auto& z) { return x * x + y * y + z * z - 1.0; }
};

/// A torus around the z axis, of radii 1 and 1/2.
struct Torus {
  static auto at(const auto& x, const auto& y, const auto& z) {
    const auto sum = x * x + y * y + z * z + 0.75;
    return sum * sum - 4.0 * (x * x + y * y);
  }
};

/// The function of all archetypes.
template <class Kernel, class Shape>
class Shape_in_box {
protected:
  using Number = typename Kernel::FT;
  using Point = typename Kernel::Point_3;

  static Number value_at(const Point& p) { return Number(Shape::at(p.x(), p.y(), p.z())); }
  template <int Order>
  static Jet_3<Number, Order> expansion_at(const Point& p) {
    return equiaffine::expand<Order, Number>(Functor(), p.x(), p.y(), p.z());
  }
  template <int Order>
  static Jet_3<Interval, Order> bounds_on(const CGAL::Bbox_3& box) {
    return equiaffine::expand<Order, Interval>(Functor(), Interval(box.xmin(), box.xmax()),
                                               Interval(box.ymin(), box.ymax()), Interval(box.zmin(), box.zmax()));
  }
  static Jet_3<Pack<Number>> expansion_at(const Pack<Number>& x, const Pack<Number>& y, const Pack<Number>& z) {
    return equiaffine::expand<4, Pack<Number>>(Functor(), x, y, z);
  }

private:
  struct Functor {
    auto operator()(const auto& x, const auto& y, const auto& z) const { return Shape::at(x, y, z); }
  };
};

/// An archetype of ImplicitFunctionTraits_3.
template <class Kernel, class Shape = Sphere>
class Implicit_function : protected Shape_in_box<Kernel, Shape> {
public:
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;
  using Vector_3 = typename Kernel::Vector_3;

  explicit Implicit_function(Shape) {}
  Implicit_function(const Implicit_function&) = default;
  Implicit_function& operator=(const Implicit_function&) = delete;

  Convertible_to<FT> value(const Point_3& p) const { return Convertible_to<FT>(this->value_at(p)); }
  Jet_3<FT> taylor(const Point_3& p) const { return this->template expansion_at<4>(p); }
  Convertible_to<CGAL::Bbox_3> bbox() const {
    return Convertible_to<CGAL::Bbox_3>(CGAL::Bbox_3(-1.6, -1.6, -1.6, 1.6, 1.6, 1.6));
  }
};

/// An archetype of BoundedImplicitFunctionTraits_3.
template <class Kernel>
struct Bounded_function : Implicit_function<Kernel> {
  using Implicit_function<Kernel>::Implicit_function;
  Interval bounds(const CGAL::Bbox_3& box) const { return this->template bounds_on<1>(box).value(); }
};

/// An archetype of FirstOrderBoundedImplicitFunctionTraits_3.
template <class Kernel>
struct First_order_bounded_function : Bounded_function<Kernel> {
  using Bounded_function<Kernel>::Bounded_function;
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const { return this->template bounds_on<1>(box); }
};

/// An archetype of SecondOrderBoundedImplicitFunctionTraits_3.
template <class Kernel>
struct Second_order_bounded_function : First_order_bounded_function<Kernel> {
  using First_order_bounded_function<Kernel>::First_order_bounded_function;
  Jet_3<Interval, 2> second_order_bounds(const CGAL::Bbox_3& box) const { return this->template bounds_on<2>(box); }
};

/// An archetype of RestrictableImplicitFunctionTraits_3, which is itself on every box.
template <class Kernel>
struct Restrictable_function : Bounded_function<Kernel> {
  using Bounded_function<Kernel>::Bounded_function;
  std::optional<Restrictable_function> restricted(const CGAL::Bbox_3&) const { return *this; }
};

/// An archetype of FirstOrderImplicitFunctionTraits_3.
template <class Kernel>
struct First_order_function : Implicit_function<Kernel> {
  using Implicit_function<Kernel>::Implicit_function;
  Jet_3<typename Kernel::FT, 1> first_order(const typename Kernel::Point_3& p) const {
    return this->template expansion_at<1>(p);
  }
};

/// An archetype of BatchImplicitFunctionTraits_3.
template <class Kernel>
struct Batch_function : Implicit_function<Kernel> {
  using Implicit_function<Kernel>::Implicit_function;
  using typename Implicit_function<Kernel>::FT;
  using typename Implicit_function<Kernel>::Point_3;
  void values(std::span<const Point_3> points, std::span<FT> values) const {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = this->value_at(points[i]);
  }
  void taylors(std::span<const Point_3> points, std::span<Jet_3<FT>> jets) const {
    for (std::size_t i = 0; i < points.size(); ++i) jets[i] = this->template expansion_at<4>(points[i]);
  }
};

/// An archetype of FirstOrderBatchImplicitFunctionTraits_3.
template <class Kernel>
struct First_order_batch_function : Batch_function<Kernel> {
  using Batch_function<Kernel>::Batch_function;
  void first_orders(std::span<const typename Kernel::Point_3> points,
                    std::span<Jet_3<typename Kernel::FT, 1>> jets) const {
    for (std::size_t i = 0; i < points.size(); ++i) jets[i] = this->template expansion_at<1>(points[i]);
  }
};

/// An archetype of PackImplicitFunctionTraits_3.
template <class Kernel>
struct Pack_function : Implicit_function<Kernel> {
  using Implicit_function<Kernel>::Implicit_function;
  using Packs = std::span<const Pack<typename Kernel::FT>>;
  void taylor_packs(Packs x, Packs y, Packs z, std::span<Jet_3<Pack<typename Kernel::FT>>> jets) const {
    for (std::size_t n = 0; n < jets.size(); ++n) jets[n] = this->expansion_at(x[n], y[n], z[n]);
  }
};

/// An archetype of LatticeImplicitFunctionTraits_3, whose samples are the values at the nodes of its box.
template <class Kernel>
struct Lattice_function : Implicit_function<Kernel> {
  using Implicit_function<Kernel>::Implicit_function;
  using Lattice = equiaffine::Lattice_3<Kernel>;
  using typename Implicit_function<Kernel>::FT;
  Convertible_to<Lattice> lattice() const { return Convertible_to<Lattice>(own_lattice()); }
  Convertible_to<FT> sample(std::size_t i, std::size_t j, std::size_t k) const {
    return this->value(own_lattice().point(FT(double(i)), FT(double(j)), FT(double(k))));
  }

private:
  Lattice own_lattice() const { return Lattice({12, 13, 14}, this->bbox()); }
};

/// A function with every capability, whose results differ from those of the fallbacks.
template <class Kernel>
struct Capable_function : Implicit_function<Kernel> {
  using Implicit_function<Kernel>::Implicit_function;
  using Lattice = equiaffine::Lattice_3<Kernel>;
  using Zero = equiaffine::Surface_point_3<Kernel>;
  using typename Implicit_function<Kernel>::FT;
  using typename Implicit_function<Kernel>::Point_3;
  Convertible_to<Lattice> lattice(const typename Lattice::Size& size) const {
    return Convertible_to<Lattice>(Lattice(size, CGAL::Bbox_3(-1.5, -1.5, -1.5, 1.5, 1.5, 1.5)));
  }
  Jet_3<Interval, 1> tight_first_order_bounds(const CGAL::Bbox_3& box) const {
    return this->template bounds_on<1>(box);
  }
  Jet_3<FT, 5> fifth_order(const Point_3& p) const { return this->template expansion_at<5>(p); }
  equiaffine::Known_bounds known_bounds() const { return {true, false}; }
  Convertible_to<FT> rounding(const Point_3&) const { return Convertible_to<FT>(FT(1e-9)); }
  Convertible_to<double> certainty(const Point_3&) const { return Convertible_to<double>(0.25); }
  Zero intersect_segment(const Point_3& a, const Point_3& b, const FT& fa, const FT& fb) const {
    auto found = equiaffine::intersect_segment(static_cast<const Implicit_function<Kernel>&>(*this), a, b, fa, fb);
    found.evaluations += 1000;
    return found;
  }
};

} // namespace archetypes

#endif
