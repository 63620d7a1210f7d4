// SPDX-License-Identifier: GPL-3.0-or-later
// The function f o A^-1, whose level sets are the images of the level sets of f under an affine map A.
#ifndef EQUIAFFINE_FUNCTION_TRANSFORMED_FUNCTION_TRAITS_3_H
#define EQUIAFFINE_FUNCTION_TRANSFORMED_FUNCTION_TRAITS_3_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/number/Pack.h>
#include <equiaffine/number/internal/Linear_substitution_3.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// `sum` plus the dot product of x and y, computed as in twice the precision (Ogita, Rump, Oishi: Accurate sum and dot
/// product, 2005).
template <class FT>
FT sum_of_products(FT sum, const std::array<FT, 3>& x, const std::array<FT, 3>& y) {
  FT error(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const FT product = x[k] * y[k], next = sum + product, part = next - sum;
    error += (sum - (next - part)) + (product - part) + std::fma(x[k], y[k], -product);
    sum = next;
  }
  return sum + error;
}

/// The inverse of an affine map. CGAL's inverse has errors of the order of the condition number or more, and applying
/// it multiplies them by the condition number again. One step of Newton's method squares these errors, up to rounding.
/// Not finite if there is no inverse.
template <class Kernel>
CGAL::Aff_transformation_3<Kernel> inverse_map(const CGAL::Aff_transformation_3<Kernel>& map) {
  using FT = typename Kernel::FT;
  const CGAL::Aff_transformation_3<Kernel> inverse = map.inverse();
  if constexpr (std::is_floating_point_v<FT>) {
    using Vector = std::array<FT, 3>;
    const auto row = [](const auto& m, int i) { return Vector{m.m(i, 0), m.m(i, 1), m.m(i, 2)}; };
    const auto negative = [](const Vector& v) { return Vector{-v[0], -v[1], -v[2]}; };
    const Vector translation = {map.m(0, 3), map.m(1, 3), map.m(2, 3)};
    std::array<Vector, 3> columns, x;
    for (std::size_t j = 0; j < 3; ++j) {
      const int n = int(j);
      const Vector column = {inverse.m(0, n), inverse.m(1, n), inverse.m(2, n)};
      Vector residual;
      for (std::size_t i = 0; i < 3; ++i) residual[i] = sum_of_products(FT(i == j), negative(row(map, int(i))), column);
      for (std::size_t i = 0; i < 3; ++i) columns[j][i] = sum_of_products(column[i], row(inverse, int(i)), residual);
    }
    Vector t;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = {columns[0][i], columns[1][i], columns[2][i]};
      t[i] = sum_of_products(FT(0), x[i], negative(translation));
      for (const FT number : {x[i][0], x[i][1], x[i][2], t[i]})
        if (!std::isfinite(number)) return inverse; // overflow
    }
    return {x[0][0], x[0][1], x[0][2], t[0], x[1][0], x[1][1], x[1][2], t[1], x[2][0], x[2][1], x[2][2], t[2]};
  }
  return inverse;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// The function f o A^-1 for any invertible affine map A. Its level sets are the images of the level sets of f under A.
/// The function models every refinement of the concept that the base models, and has the base's capabilities. Under the
/// identity, the default, it equals the base bit for bit, at the same cost.
///
/// With a = |det A| the affine curvatures change by K' = K / a, H' = H / sqrt(a), J' = J / sqrt(a), the co-normal by
/// nu' = sqrt(a) A^-T nu and the affine normal by xi' = A xi / sqrt(a).
template <ImplicitFunctionTraits_3 Base>
class Transformed_function_traits_3 {
public:
  using FT = typename Base::FT;                                             ///< the number type of the base
  using Point_3 = typename Base::Point_3;                                   ///< points of the base
  using Vector_3 = typename Base::Vector_3;                                 ///< vectors of the base
  using Aff_transformation_3 = CGAL::Aff_transformation_3<Kernel_of<Base>>; ///< affine maps of its kernel

  /// \throw std::invalid_argument if the map has no inverse
  explicit Transformed_function_traits_3(Base base,
                                         const Aff_transformation_3& map = Aff_transformation_3(CGAL::IDENTITY))
      : Transformed_function_traits_3(std::move(base), std::make_shared<const Map>(map)) {}

  FT value(const Point_3& p) const { return base_.value(preimage(p)); } ///< f(A^-1 p)
  /// The expansion of order 1, computed from the base at the preimage.
  Jet_3<FT, 1> first_order(const Point_3& p) const requires FirstOrderImplicitFunctionTraits_3<Base> {
    return substituted(base_.first_order(preimage(p)));
  }
  /// The expansion of order 4, computed from the base at the preimage.
  Jet_3<FT> taylor(const Point_3& p) const { return substituted(base_.taylor(preimage(p))); }
  /// The expansion of order 5, computed from the base at the preimage, if the base has one.
  std::optional<Jet_3<FT, 5>> fifth_order(const Point_3& p) const requires HasFifthOrder<Base> {
    const std::optional<Jet_3<FT, 5>> jet = base_.fifth_order(preimage(p));
    return jet ? std::optional(substituted(*jet)) : std::nullopt;
  }

  /// Sets values[i] to value(points[i]).
  void values(std::span<const Point_3> points,
              std::span<FT> values) const requires BatchImplicitFunctionTraits_3<Base> {
    if (map_->is_identity) return base_.values(points, values);
    base_.values(preimages(points), values);
  }
  /// Sets jets[i] to first_order(points[i]).
  void first_orders(std::span<const Point_3> points,
                    std::span<Jet_3<FT, 1>> jets) const requires FirstOrderBatchImplicitFunctionTraits_3<Base> {
    if (map_->is_identity) return base_.first_orders(points, jets);
    base_.first_orders(preimages(points), jets);
    for (auto& jet : jets) jet = map_->substitution(jet);
  }
  /// Sets jets[i] to taylor(points[i]).
  void taylors(std::span<const Point_3> points,
               std::span<Jet_3<FT>> jets) const requires BatchImplicitFunctionTraits_3<Base> {
    if (map_->is_identity) return base_.taylors(points, jets);
    base_.taylors(preimages(points), jets);
    for (auto& jet : jets) jet = map_->substitution(jet);
  }

  /// Sets jets[n] to the expansions at the points of the packs x[n], y[n], z[n].
  void taylor_packs(std::span<const Pack<FT>> x, std::span<const Pack<FT>> y, std::span<const Pack<FT>> z,
                    std::span<Jet_3<Pack<FT>>> jets) const requires PackImplicitFunctionTraits_3<Base> {
    if (map_->is_identity) return base_.taylor_packs(x, y, z, jets);
    std::array<std::vector<Pack<FT>>, 3> coordinates;
    for (auto& coordinate : coordinates) coordinate.resize(jets.size());
    for (std::size_t n = 0; n < jets.size(); ++n) {
      const auto preimage = preimage_of_lanes(x[n], y[n], z[n]);
      for (std::size_t axis = 0; axis < 3; ++axis) coordinates[axis][n] = preimage[axis];
    }
    base_.taylor_packs(coordinates[0], coordinates[1], coordinates[2], jets);
    for (auto& jet : jets) jet = map_->substitution(jet);
  }

  /// The bounds of the base on the bounding box of the preimage of `box`.
  Interval bounds(const CGAL::Bbox_3& box) const requires BoundedImplicitFunctionTraits_3<Base> {
    return base_.bounds(preimage(box));
  }
  /// Bounds of value and gradient, from those of the base on the bounding box of the preimage.
  Jet_3<Interval, 1>
  first_order_bounds(const CGAL::Bbox_3& box) const requires FirstOrderBoundedImplicitFunctionTraits_3<Base> {
    return substituted(base_.first_order_bounds(preimage(box)));
  }
  /// Bounds of the expansion of order 2, from those of the base on the bounding box of the preimage.
  Jet_3<Interval, 2>
  second_order_bounds(const CGAL::Bbox_3& box) const requires SecondOrderBoundedImplicitFunctionTraits_3<Base> {
    return substituted(base_.second_order_bounds(preimage(box)));
  }
  /// The tighter bounds of value and gradient, from those of the base on the bounding box of the preimage.
  Jet_3<Interval, 1> tight_first_order_bounds(const CGAL::Bbox_3& box) const requires HasTightFirstOrderBounds<Base> {
    return substituted(base_.tight_first_order_bounds(preimage(box)));
  }
  /// Which bounds the base has.
  Known_bounds known_bounds() const requires HasKnownBounds<Base> { return base_.known_bounds(); }

  /// The image of the cheaper function for the bounding box of the preimage of `box`, if the base has one.
  std::optional<Transformed_function_traits_3>
  restricted(const CGAL::Bbox_3& box) const requires RestrictableImplicitFunctionTraits_3<Base> {
    auto base = base_.restricted(preimage(box));
    return base ? std::optional(Transformed_function_traits_3(*std::move(base), map_)) : std::nullopt;
  }

  /// The rounding of the base times the square of the largest absolute column sum of A^-1: by the chain rule, a second
  /// derivative is a sum of second derivatives of the base, each times one entry of A^-1 for either variable.
  FT rounding(const Point_3& p) const requires HasRounding<Base> {
    FT greatest_sum(0);
    for (int column = 0; column < 3; ++column) {
      using std::abs;
      FT sum(0);
      for (int row = 0; row < 3; ++row) sum += abs(map_->inverse.m(row, column));
      greatest_sum = std::max(greatest_sum, sum);
    }
    return base_.rounding(preimage(p)) * greatest_sum * greatest_sum;
  }

  /// The certainty of the base, which affine maps preserve.
  double certainty(const Point_3& p) const requires HasCertainty<Base> { return base_.certainty(preimage(p)); }

  /// Finds a zero on the segment ab by calling the base for the preimage of the segment.
  Surface_point_3<Kernel_of<Base>> intersect_segment(const Point_3& a, const Point_3& b, const FT& fa,
                                                     const FT& fb) const requires HasIntersectSegment<Base> {
    auto found = base_.intersect_segment(preimage(a), preimage(b), fa, fb);
    if (!map_->is_identity) found.point = map_->map(found.point);
    return found;
  }

  /// The bounding box of the image of the base's box.
  CGAL::Bbox_3 bbox() const {
    return map_->is_identity ? base_.bbox() : Lattice({2, 2, 2}, base_.bbox()).transform(map_->map).bbox();
  }

  /// The image of the lattice on which the base would be sampled. It covers exactly the image of the base's box.
  Lattice_3<Kernel_of<Base>> lattice(const typename Lattice_3<Kernel_of<Base>>::Size& size) const {
    return transformed(sampling_lattice(base_, size));
  }

  /// The image of the base's lattice.
  Lattice_3<Kernel_of<Base>> lattice() const requires LatticeImplicitFunctionTraits_3<Base> {
    return transformed(base_.lattice());
  }
  /// The sample of the base at node (i, j, k).
  FT sample(std::size_t i, std::size_t j, std::size_t k) const requires LatticeImplicitFunctionTraits_3<Base> {
    return base_.sample(i, j, k);
  }
  /// The samples of the base at a block of nodes.
  void samples(const std::array<std::size_t, 3>& first, const std::array<std::size_t, 3>& size,
               std::span<FT> out) const requires HasSamples<Base> {
    base_.samples(first, size, out);
  }
  /// The cell of the base's lattice that contains the preimage of p.
  auto cell_of(const Point_3& p) const requires CellwiseImplicitFunctionTraits_3<Base> {
    return base_.cell_of(preimage(p));
  }
  /// The image of the base restricted to a block of cells.
  Transformed_function_traits_3
  restricted_to_cells(const Cell_block& cells) const requires CellwiseImplicitFunctionTraits_3<Base> {
    return Transformed_function_traits_3(base_.restricted_to_cells(cells), map_);
  }

  const Base& base() const { return base_; }                               ///< the function f
  const Aff_transformation_3& transformation() const { return map_->map; } ///< the map A

private:
  using Lattice = Lattice_3<Kernel_of<Base>>;

  /// The map with everything computed from it, shared by copies of the function. CGAL's reference counting of maps is
  /// not thread-safe.
  struct Map {
    explicit Map(const Aff_transformation_3& m)
        : map(m), inverse(internal::inverse_map(m)), is_identity(equals_identity(m)),
          substitution(linear_part(inverse, [](const FT& x) { return x; })),
          substitution_of_bounds(linear_part(inverse, [](const FT& x) { return Interval(CGAL::to_double(x)); })) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
          check_argument(inverse.m(i, j) - inverse.m(i, j) == FT(0), // neither infinite nor NaN
                         "the affine map of a function has no inverse: use a map with finite coefficients and a "
                         "nonzero determinant");
    }

    Aff_transformation_3 map, inverse;
    bool is_identity;
    Linear_substitution_3<FT, 5> substitution;
    Linear_substitution_3<Interval> substitution_of_bounds;
  };

  Transformed_function_traits_3(Base base, std::shared_ptr<const Map> map)
      : base_(std::move(base)), map_(std::move(map)) {}

  static bool equals_identity(const Aff_transformation_3& map) {
    bool result = true;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) result = result && map.m(row, column) == FT(row == column);
    return result;
  }

  Lattice transformed(const Lattice& lattice) const {
    return map_->is_identity ? lattice : lattice.transform(map_->map);
  }

  Point_3 preimage(const Point_3& p) const { return map_->is_identity ? p : map_->inverse(p); }

  /// The expansion of this function, given that of the base at the preimage.
  template <int Order>
  Jet_3<FT, Order> substituted(const Jet_3<FT, Order>& jet) const {
    return map_->is_identity ? jet : map_->substitution(jet);
  }
  template <int Order>
  Jet_3<Interval, Order> substituted(const Jet_3<Interval, Order>& jet) const {
    return map_->is_identity ? jet : map_->substitution_of_bounds(jet);
  }

  std::vector<Point_3> preimages(std::span<const Point_3> points) const {
    std::vector<Point_3> result;
    result.reserve(points.size());
    for (const Point_3& p : points) result.push_back(map_->inverse(p));
    return result;
  }

  /// The preimages of the points (x[i], y[i], z[i]), lane by lane.
  std::array<Pack<FT>, 3> preimage_of_lanes(const Pack<FT>& x, const Pack<FT>& y, const Pack<FT>& z) const {
    std::array<std::array<FT, Pack<FT>::size>, 3> lanes;
    for (std::size_t i = 0; i < Pack<FT>::size; ++i) {
      const Point_3 p = map_->inverse(Point_3(x[i], y[i], z[i]));
      for (int axis = 0; axis < 3; ++axis) lanes[std::size_t(axis)][i] = p[axis];
    }
    const auto pack_of = [&](std::size_t axis) {
      return Pack<FT>::generate([&](std::size_t i) { return lanes[axis][i]; });
    };
    return {pack_of(0), pack_of(1), pack_of(2)};
  }

  /// The bounding box of the preimage of a box.
  CGAL::Bbox_3 preimage(const CGAL::Bbox_3& box) const {
    if (map_->is_identity) return box;
    const std::array<Interval, 3> sides = internal::sides_of(box);
    std::array<Interval, 3> image;
    for (int row = 0; row < 3; ++row) {
      image[std::size_t(row)] = Interval(CGAL::to_double(map_->inverse.m(row, 3)));
      for (int column = 0; column < 3; ++column)
        image[std::size_t(row)] += Interval(CGAL::to_double(map_->inverse.m(row, column))) * sides[std::size_t(column)];
    }
    return CGAL::Bbox_3(image[0].lower(), image[1].lower(), image[2].lower(), image[0].upper(), image[1].upper(),
                        image[2].upper());
  }

  /// The matrix of the linear part of a map, with converted entries.
  template <class Convert>
  static auto linear_part(const Aff_transformation_3& map, const Convert& convert) {
    std::array<std::array<decltype(convert(FT())), 3>, 3> matrix;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        matrix[std::size_t(row)][std::size_t(column)] = convert(map.m(row, column));
    return matrix;
  }

  Base base_;
  std::shared_ptr<const Map> map_;
};

} // namespace equiaffine

#endif
