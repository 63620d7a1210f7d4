// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_FITTED_FUNCTION_TRAITS_3_H
#define EQUIAFFINE_FIT_FITTED_FUNCTION_TRAITS_3_H

#include <equiaffine/fit/internal/Blend_3.h>
#include <equiaffine/fit/internal/Surface_fit_3.h>
#include <equiaffine/fit/internal/fit_input.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/number/Interval.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <cstddef>
#include <memory>
#include <ranges>
#include <utility>

namespace equiaffine {

/// A smooth function whose zero set is the surface that the vertices of a mesh, or points without faces, are samples
/// of: a model of FirstOrderImplicitFunctionTraits_3 and BoundedImplicitFunctionTraits_3. Near the surface its value is
/// about the signed distance, negative on the side that normals point away from.
///
/// It is a blend of polynomials fitted to the points around centers, chosen by the data as for `fitted_structures`, of
/// which it is the continuous counterpart: sum of w_i g_i / sum of w_i, where g_i is a polynomial that approximates the
/// distance and w_i a weight that vanishes at 3/4 of the radius of its points (a partition of unity; Ohtake et al.
/// 2003). It has four continuous derivatives. Another sheet of the surface that is near in space but not connected
/// nearby has no influence.
///
/// It is defined in a band along the points: up to 2 spacings of the points from the nearest one along its normal, and
/// 1.25 across, so that holes larger than that stay holes, and an open border stays where it is to within that.
/// Elsewhere the value is not a number.
///
/// Construction takes 1 ms per vertex for exact data and 3 ms for noisy ones, memory is linear; copies share it. A
/// value takes some 5 microseconds, an expansion 25.
template <class Kernel>
class Fitted_function_traits_3 {
public:
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;
  using Vector_3 = typename Kernel::Vector_3;

  /// From a mesh, a model of CGAL's FaceGraph. Named parameters: `vertex_point_map`, `noise`, `scale`, `degree`.
  /// \throw std::invalid_argument if a coordinate is not finite, or a parameter makes no sense.
  template <internal::Face_graph Graph, class Parameters = internal::No_parameters,
            class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Fitted_function_traits_3(const Graph& mesh, const Parameters& parameters = {}, ConcurrencyTag tag = {}) {
    internal::check_parameters<Parameters, internal::Vertex_point_tag, internal::Noise_tag, internal::Scale_tag,
                               internal::Degree_tag>();
    make(internal::fit_input_of_graph(mesh, parameters), parameters, tag);
  }

  /// From points. Named parameters: `point_map`, `normal_map`, `normal_orientation`, `noise`, `scale`, `degree`.
  /// \throw std::invalid_argument if a coordinate is not finite, or a parameter makes no sense.
  template <std::ranges::input_range Points, class Parameters = internal::No_parameters,
            class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Fitted_function_traits_3(const Points& points, const Parameters& parameters = {},
                                    ConcurrencyTag tag = {}) requires(!internal::Face_graph<Points>) {
    internal::check_parameters<Parameters, internal::Point_tag, internal::Normal_tag, internal::Normal_orientation_tag,
                               internal::Noise_tag, internal::Scale_tag, internal::Degree_tag>();
    make(internal::fit_input_of_points<ConcurrencyTag>(points, parameters).data, parameters, tag);
  }

  FT value(const Point_3& p) const { return FT(state_->blend.value(normal(p)) / state_->fit.normalization().scale()); }
  Jet_3<FT, 1> first_order(const Point_3& p) const { return expansion<1>(p); }
  Jet_3<FT> taylor(const Point_3& p) const { return expansion<4>(p); }

  /// The whole line for a box that meets the band, as far as boxes around the data tell, and 1 for one where the
  /// function has no value, so that Marching Cubes with `skip_empty_space` visits the band alone.
  Interval bounds(const CGAL::Bbox_3& box) const {
    const Eigen::Matrix3d& matrix = state_->fit.normalization().matrix;
    const Eigen::Vector3d lower(box.xmin(), box.ymin(), box.zmin()), upper(box.xmax(), box.ymax(), box.zmax());
    const Eigen::Vector3d center = state_->fit.normalization()((lower + upper) / 2);
    const Eigen::Vector3d half = matrix.cwiseAbs() * ((upper - lower) / 2);
    return state_->blend.may_meet_band(center - half, center + half) ? Interval::whole() : Interval(1);
  }

  /// The box of the band.
  CGAL::Bbox_3 bbox() const { return state_->box; }

private:
  struct State {
    template <class ConcurrencyTag>
    State(internal::Normalized_data data, const internal::Fit_request& request, ConcurrencyTag tag)
        : fit(std::move(data), request, tag), blend(fit.data(), fit.choices(), tag),
          box(blend.band_box(fit.normalization())) {}

    internal::Surface_fit_3 fit;
    internal::Blend_3 blend;
    CGAL::Bbox_3 box;
  };

  template <class Parameters, class ConcurrencyTag>
  void make(internal::Normalized_data data, const Parameters& parameters, ConcurrencyTag tag) {
    state_ = std::make_shared<const State>(std::move(data), internal::fit_request(parameters), tag);
  }

  Eigen::Vector3d normal(const Point_3& p) const { return state_->fit.normalization()(internal::coordinates_of(p)); }

  template <int Order>
  Jet_3<FT, Order> expansion(const Point_3& p) const {
    const auto jet = state_->fit.to_space(state_->blend.template taylor<Order>(normal(p)));
    Jet_3<FT, Order> result;
    for (std::size_t n = 0; n < jet.size; ++n) result.coefficients()[n] = FT(jet.coefficients()[n]);
    return result;
  }

  std::shared_ptr<const State> state_;
};

} // namespace equiaffine

#endif
