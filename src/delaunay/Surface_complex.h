// SPDX-License-Identifier: GPL-3.0-or-later
// The triangulation that CGAL's mesher refines to a surface, and the call of the mesher.
#ifndef EQUIAFFINE_SRC_DELAUNAY_SURFACE_COMPLEX_H
#define EQUIAFFINE_SRC_DELAUNAY_SURFACE_COMPLEX_H

#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>
#include <equiaffine/function/Any_function_3.h>

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/refine_mesh_3.h>
#include <CGAL/version.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace equiaffine::internal {

/// A function that caches its latest values and counts its evaluations: the mesher evaluates each circumcenter up to
/// four times. Copies share the memory, which must outlive them. Not thread-safe.
class Memoized_function_3 {
public:
  using FT = Any_function_3::FT;
  using Point_3 = Any_function_3::Point_3;
  using Vector_3 = Any_function_3::Vector_3;

  class Memory {
  public:
    explicit Memory(const Any_function_3& function) : function_(function), entries_(size) {}
    std::size_t evaluations() const { return evaluations_; }

  private:
    friend Memoized_function_3;
    static constexpr std::size_t size = 1 << 15;

    struct Entry {
      Point_3 point = Point_3(std::numeric_limits<double>::quiet_NaN(), 0, 0);
      double value = 0;
    };

    const Any_function_3 function_;
    std::vector<Entry> entries_;
    std::size_t evaluations_ = 0;
  };

  explicit Memoized_function_3(Memory& memory) : memory_(&memory) {}

  double value(const Point_3& p) const {
    Progress_observer::step(); // the only place where CGAL's mesher can be canceled
    auto& entry = memory_->entries_[slot(p)];
    if (!(entry.point == p)) {
      entry = {p, memory_->function_.value(p)};
      ++memory_->evaluations_;
    }
    return entry.value;
  }

  Jet_3<double, 1> first_order(const Point_3& p) const {
    ++memory_->evaluations_;
    return memory_->function_.first_order(p);
  }

  Jet_3<double> taylor(const Point_3& p) const {
    ++memory_->evaluations_;
    return memory_->function_.taylor(p);
  }

  /// Called by `equiaffine::intersect_segment`. The model iterates by itself; only the number of evaluations is
  /// recorded.
  Surface_point_3<Any_function_3::Kernel> intersect_segment(const Point_3& a, const Point_3& b, double fa,
                                                            double fb) const {
    const auto found = memory_->function_.intersect_segment(a, b, fa, fb);
    memory_->evaluations_ += found.evaluations;
    return found;
  }

  Interval bounds(const CGAL::Bbox_3& box) const { return memory_->function_.bounds(box); }
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const {
    return memory_->function_.first_order_bounds(box);
  }
  Jet_3<Interval, 1> tight_first_order_bounds(const CGAL::Bbox_3& box) const {
    return memory_->function_.tight_first_order_bounds(box);
  }
  Known_bounds known_bounds() const { return memory_->function_.known_bounds(); }
  CGAL::Bbox_3 bbox() const { return memory_->function_.bbox(); }

private:
  static std::size_t slot(const Point_3& p) {
    std::uint64_t hash = std::bit_cast<std::uint64_t>(p.x()) * 0x9E3779B97F4A7C15U;
    hash = (hash ^ std::bit_cast<std::uint64_t>(p.y())) * 0xC2B2AE3D27D4EB4FU;
    hash = (hash ^ std::bit_cast<std::uint64_t>(p.z())) * 0x165667B19E3779F9U;
    return std::size_t(hash >> 32) & (Memory::size - 1);
  }

  Memory* memory_;
};

/// The domain for CGAL's mesher. It has a surface but no interior, so that the mesher never queries the side of a
/// point.
struct Surface_domain_3 : Implicit_mesh_domain_3<Memoized_function_3> {
  using Implicit_mesh_domain_3::Implicit_mesh_domain_3;

  struct Is_in_domain {
    Subdomain operator()(const Point_3&) const { return Subdomain(); }
  };
  Is_in_domain is_in_domain_object() const { return {}; }
  Construct_intersection construct_intersection_object() const { return construct_intersection_with_zero_set_object(); }
  Do_intersect_surface do_intersect_surface_object() const { return {construct_intersection_object()}; }
};

/// A triangulation, and its facets that approximate the surface. The `in_dimension()` of a vertex is 0 for corners of
/// features and singular points, 1 on curves that are features, 2 on the rest of the surface, and 3 elsewhere.
using Surface_triangulation = CGAL::Mesh_triangulation_3<Surface_domain_3>::type;
using Surface_vertex = Surface_triangulation::Vertex_handle;
using Surface_complex = CGAL::Mesh_complex_3_in_triangulation_3<Surface_triangulation>;

} // namespace equiaffine::internal

/// Prevents CGAL's mesher from writing the triangulation to files in the current folder before it throws an
/// assertion.
template <>
struct CGAL::Dump_c3t3<equiaffine::internal::Surface_complex, true> {
  void dump_c3t3(const equiaffine::internal::Surface_complex&, const std::string&, bool = false) const {}
};

namespace equiaffine::internal {

/// The topology that the facets must have.
enum class Manifoldness { ANY, MANIFOLD, MANIFOLD_WITH_BOUNDARY };

/// Refines only the facets, starting from the points in the triangulation. The calls of CGAL 5, 6.0, and 6.1 differ.
template <class C3t3, class Domain, class Criteria>
void refine_facets(C3t3& c3t3, const Domain& domain, const Criteria& criteria, Manifoldness manifoldness) {
  namespace parameters = CGAL::parameters;
  const auto refine = [&](auto topology) {
#if CGAL_VERSION_NR >= 1060000000
    const auto options = topology.no_perturb().no_exude();
    if constexpr (requires { options.surface_only(); }) {
      CGAL::refine_mesh_3(c3t3, domain, criteria, options.surface_only());
    } else {
      CGAL::refine_mesh_3(c3t3, domain, criteria, options);
    }
#else
    CGAL::refine_mesh_3(c3t3, domain, criteria, parameters::no_reset_c3t3(), parameters::no_perturb(),
                        parameters::no_exude(), topology);
#endif
  };
  switch (manifoldness) {
  case Manifoldness::ANY: return refine(parameters::non_manifold());
  case Manifoldness::MANIFOLD: return refine(parameters::manifold());
  case Manifoldness::MANIFOLD_WITH_BOUNDARY: return refine(parameters::manifold_with_boundary());
  }
}

} // namespace equiaffine::internal

#endif
