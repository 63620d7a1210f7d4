// SPDX-License-Identifier: GPL-3.0-or-later
// The affine frame of a surface at a point, computed from the affine structure.
#ifndef EQUIAFFINE_GEOMETRY_AFFINE_FRAME_H
#define EQUIAFFINE_GEOMETRY_AFFINE_FRAME_H

#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/number/select.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine {

/// The basis of space, of determinant 1 or -1, that the affine structure defines at a generic point of a surface. An
/// affine map p -> A p + t with a = |det A|, reflections included, maps it to the frame at the image point:
///
///     e1' = a^(-1/4) A e1,  e2' = a^(-1/4) A e2,  xi' = a^(-1/2) A xi,  scale' = a^(-1/2) scale,
///
/// and preserves the signature. One pair of corresponding points therefore determines the map. doc/conventions.md has
/// the definition. Units: e1 and e2 length^(1/4), xi length^(-1/2), scale length^(-3/2).
template <class FT>
struct Affine_frame_3 {
  std::array<FT, 3> e1, ///< tangent: an eigenvector of B (elliptic points) or asymptotic (hyperbolic)
      e2;               ///< the other such vector
  std::array<FT, 3> xi; ///< the affine normal or its opposite, such that J >= 0
  FT scale;             ///< r = sqrt(H^2 + J^2 + |D|) with D = H^2 - K
  /// H / r, J / r >= 0, sign(D) sqrt|D| / r and Theta / (|D| r^2): all invariants of order 4.
  std::array<FT, 4> signature;
  /// How well the structure determines the frame: 0 if it does not, and hardly more than 1.
  FT quality;
  Mask_of<FT> is_elliptic; ///< whether K_e > 0; otherwise K_e < 0
};

} // namespace equiaffine

namespace equiaffine::internal {

// The steps from the affine structure to the frame. `beta` is the trace-free part of B with its index lowered by the
// metric, and T is the trace-free cubic form, both in the basis of the chart.

template <class FT>
using Tangent_vector = std::array<FT, 2>;

template <class FT>
Tangent_vector<FT> combination(const FT& a, const Tangent_vector<FT>& x, const FT& b, const Tangent_vector<FT>& y) {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1]};
}

template <class FT>
Tangent_vector<FT> multiple(const FT& a, const Tangent_vector<FT>& x) {
  return {a * x[0], a * x[1]};
}

template <class FT>
Tangent_vector<FT> select_vector(const Mask_of<FT>& condition, const Tangent_vector<FT>& yes,
                                 const Tangent_vector<FT>& no) {
  return {select(condition, yes[0], no[0]), select(condition, yes[1], no[1])};
}

/// The value of a symmetric bilinear form.
template <class FT>
FT form_at(const std::array<FT, 3>& form, const Tangent_vector<FT>& x, const Tangent_vector<FT>& y) {
  return x[0] * (form[0] * y[0] + form[1] * y[1]) + x[1] * (form[1] * y[0] + form[2] * y[1]);
}

/// The value of a cubic form for three equal arguments.
template <class FT>
FT form_at(const std::array<FT, 4>& form, const Tangent_vector<FT>& x) {
  const FT u = x[0], v = x[1];
  return u * u * (form[0] * u + FT(3) * form[1] * v) + v * v * (FT(3) * form[2] * u + form[3] * v);
}

template <class FT>
FT lesser(const FT& a, const FT& b) {
  return select(a < b, a, b);
}

template <class FT>
FT sign_of(const FT& x) {
  return select(x < FT(0), FT(-1), FT(1));
}

/// The forms at a point, oriented so that the metric is positive at an elliptic point and J is positive at a hyperbolic
/// one. Reversing the orientation changes the sign of all forms except beta.
template <class FT>
struct Oriented_forms {
  Mask_of<FT> is_elliptic;
  FT orientation; ///< 1 for the orientation of the gradient, otherwise -1
  FT determinant; ///< of the metric
  std::array<FT, 3> metric, beta;
  std::array<FT, 4> cubic;

  explicit Oriented_forms(const Affine_structure_3<FT>& s) : metric(s.metric_in_chart), cubic(s.cubic_in_chart) {
    const auto& [b11, b12, b21, b22] = s.shape_operator;
    const FT half = (b11 - b22) * FT(0.5);
    beta = {metric[0] * half + metric[1] * b21, (metric[0] * b12 + metric[2] * b21) * FT(0.5),
            metric[1] * b12 - metric[2] * half};
    determinant = metric[0] * metric[2] - metric[1] * metric[1];
    is_elliptic = determinant > FT(0);
    orientation = sign_of(select(is_elliptic, metric[0], s.pick_invariant));
    for (FT& x : metric) x = orientation * x;
    for (FT& x : cubic) x = orientation * x;
  }
};

/// The two tangent vectors of a frame, and related invariants.
template <class FT>
struct Tangent_frame {
  Tangent_vector<FT> e1, e2;
  FT discriminant;   ///< D = H^2 - K
  FT theta_over_d;   ///< Theta / |D|
  FT beta_gap;       ///< by how much the two directions differ, in the unit of r
  FT cubic1, cubic2; ///< T for e1 and for e2, nonnegative
};

/// The eigenvectors of beta, starting with the positive eigenvalue, orthonormal in the metric and oriented so that T is
/// positive for both.
template <class FT>
Tangent_frame<FT> elliptic_frame(const Oriented_forms<FT>& s) {
  using std::abs;
  using std::sqrt;
  const FT first = FT(1) / sqrt(s.metric[0]), second = first / sqrt(s.determinant);
  const Tangent_vector<FT> u = {first, FT(0)}, v = {-(s.metric[1] * second), s.metric[0] * second};
  const FT x = form_at(s.beta, u, u), y = form_at(s.beta, u, v), delta = root_of_squares(x, y), sum = delta + abs(x);
  const Mask_of<FT> is_first = x >= FT(0);
  const FT c = select(is_first, sum, FT(abs(y))), t = select(is_first, y, FT(sign_of(y) * sum));
  const FT length = root_of_squares(c, t);
  Tangent_frame<FT> frame;
  frame.e1 = combination<FT>(c / length, u, t / length, v);
  frame.e2 = combination<FT>(-(t / length), u, c / length, v);
  const FT a = form_at(s.cubic, frame.e1), b = form_at(s.cubic, frame.e2);
  frame.e1 = multiple(sign_of(a), frame.e1);
  frame.e2 = multiple(sign_of(b), frame.e2);
  frame.cubic1 = abs(a);
  frame.cubic2 = abs(b);
  frame.discriminant = delta * delta;
  frame.theta_over_d = delta * (frame.cubic1 - frame.cubic2) * (frame.cubic1 + frame.cubic2);
  frame.beta_gap = delta;
  return frame;
}

/// The null directions of the metric, scaled so that their product is 1 and T is equal for both; first the one with
/// larger |beta|.
template <class FT>
Tangent_frame<FT> hyperbolic_frame(const Oriented_forms<FT>& s) {
  using std::abs;
  using std::cbrt;
  using std::sqrt;
  const FT root = -(s.metric[1] + sign_of(s.metric[1]) * sqrt(FT(abs(s.determinant))));
  const Tangent_vector<FT> n1 = {root, s.metric[0]};
  Tangent_vector<FT> n2 = {s.metric[2], root};
  n2 = multiple(FT(FT(1) / form_at(s.metric, n1, n2)), n2);
  const FT t1 = form_at(s.cubic, n1), t2 = form_at(s.cubic, n2), boost = cbrt(FT(sqrt(FT(abs(t2 / t1)))));
  const Tangent_vector<FT> plus = multiple(FT(sign_of(t1) * boost), n1), minus = multiple(FT(sign_of(t1) / boost), n2);
  const FT beta1 = form_at(s.beta, plus, plus), beta2 = form_at(s.beta, minus, minus);
  const Mask_of<FT> is_ordered = abs(beta1) >= abs(beta2);
  Tangent_frame<FT> frame;
  frame.e1 = select_vector<FT>(is_ordered, plus, minus);
  frame.e2 = select_vector<FT>(is_ordered, minus, plus);
  frame.cubic1 = frame.cubic2 = sqrt(FT(abs(t1 * t2)));
  frame.discriminant = form_at(s.beta, n1, n1) * form_at(s.beta, n2, n2); // T = 0 has no boost
  frame.theta_over_d = FT(0.25) * frame.cubic1 * frame.cubic1 * (beta1 * beta1 * beta1 + beta2 * beta2 * beta2) /
                       abs(frame.discriminant);
  frame.beta_gap = lesser(FT(abs(abs(beta1) - abs(beta2))), FT(sqrt(FT(abs(frame.discriminant)))));
  return frame;
}

template <class FT>
Tangent_frame<FT> select_frame(const Mask_of<FT>& condition, const Tangent_frame<FT>& yes,
                               const Tangent_frame<FT>& no) {
  return {select_vector<FT>(condition, yes.e1, no.e1),
          select_vector<FT>(condition, yes.e2, no.e2),
          select(condition, yes.discriminant, no.discriminant),
          select(condition, yes.theta_over_d, no.theta_over_d),
          select(condition, yes.beta_gap, no.beta_gap),
          select(condition, yes.cubic1, no.cubic1),
          select(condition, yes.cubic2, no.cubic2)};
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Computes the affine frame at a regular point, or at the points of a pack. It depends only on the surface, not on the
/// direction of the gradient. If the structure has a symmetry, as on quadrics, the frame is not determined: its quality
/// is 0 or of the order of rounding, and e1 and e2 are meaningless or NaN. Does not branch on values. Takes about 200
/// floating-point operations.
template <class FT>
Affine_frame_3<FT> affine_frame(const Affine_structure_3<FT>& s) {
  using std::abs;
  using std::sqrt;
  const internal::Oriented_forms<FT> forms(s);
  const internal::Tangent_frame<FT> frame =
      internal::select_frame<FT>(forms.is_elliptic, internal::elliptic_frame(forms), internal::hyperbolic_frame(forms));
  const FT h = forms.orientation * s.mean_curvature, j = forms.orientation * s.pick_invariant;
  const FT root = sqrt(FT(abs(frame.discriminant)));
  Affine_frame_3<FT> result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.e1[i] = frame.e1[0] * s.tangent_u[i] + frame.e1[1] * s.tangent_v[i];
    result.e2[i] = frame.e2[0] * s.tangent_u[i] + frame.e2[1] * s.tangent_v[i];
    result.xi[i] = forms.orientation * s.normal[i];
  }
  const FT r = sqrt(FT(h * h + j * j + root * root));
  result.scale = r;
  result.signature = {h / r, j / r, internal::sign_of(frame.discriminant) * root / r, frame.theta_over_d / (r * r)};
  const FT quality =
      internal::lesser(FT(frame.beta_gap / r), FT(internal::lesser(frame.cubic1, frame.cubic2) / sqrt(r)));
  const FT nan = std::numeric_limits<double>::quiet_NaN();
  result.quality = select(is_finite_number(r), select(quality > FT(0), quality, FT(0)), nan);
  result.is_elliptic = forms.is_elliptic;
  return result;
}

} // namespace equiaffine

#endif
