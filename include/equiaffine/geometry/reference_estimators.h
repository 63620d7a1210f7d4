// SPDX-License-Identifier: GPL-3.0-or-later
// The affine structure by the methods of Andrade and Lewiner (2012), for comparison with the library's own.
#ifndef EQUIAFFINE_GEOMETRY_REFERENCE_ESTIMATORS_H
#define EQUIAFFINE_GEOMETRY_REFERENCE_ESTIMATORS_H

#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/monomials_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace equiaffine {

/// The methods to compute the affine structure from the 34 derivatives of f at a point: our own, and those of Andrade,
/// Lewiner: Affine-invariant curvature estimators for implicit surfaces, 2012, with the corrections of doc/errata.md.
/// Theirs take more operations and are slower and less accurate; they are provided for comparison.
enum class Estimator {
  COMPACT,        ///< pivot and shear: affine_structure()
  TRANSFORMATION, ///< section 3: an affine map after which the formulas are short
  DIRECT,         ///< section 2: the implicit function theorem for the axis closest to the gradient
  DIRECT_Z        ///< section 2, always for the z-axis; not finite if f_z vanishes
};

/// The quantities that the paper estimates, in the conventions of Affine_structure_3.
template <class FT>
struct Affine_estimate_3 {
  std::array<FT, 3> conormal, ///< nu
      normal;                 ///< xi
  FT gaussian_curvature,      ///< K
      mean_curvature;         ///< H
};

namespace internal {

/// The partial derivatives of f in the order of the monomials.
template <class FT>
std::array<FT, Jet_3<FT>::size> partial_derivatives(const Jet_3<FT>& jet) {
  constexpr std::array<int, 5> factorial = {1, 1, 2, 6, 24};
  std::array<FT, Jet_3<FT>::size> f;
  for (std::size_t n = 0; n < f.size(); ++n) {
    const Monomial_3 m = monomials[n];
    f[n] = jet.coefficients()[n] *
           FT(factorial[std::size_t(m.i)] * factorial[std::size_t(m.j)] * factorial[std::size_t(m.k)]);
  }
  return f;
}

// The partial derivatives of the graph z = g(x, y) of a level set, expressed by those of f: g_x = -f_x / f_z, and
// repeated application of D_x = d/dx + g_x d/dz (Andrade, Lewiner 2012, equation (1)).

/// The derivative of g of order i in x and j in y, i + j >= 1: a sum of products of derivatives of f, each divided by a
/// power of f_z.
class Implicit_derivative {
public:
  Implicit_derivative() = default;

  Implicit_derivative(int i, int j) {
    Sum sum;
    add(sum, {i > 0 ? monomial_index(1, 0, 0) : monomial_index(0, 1, 0)}, 1, -1); // g_x or g_y
    for (int n = 1; n < i + j; ++n) sum = derivative(sum, n < i ? 0 : 1);
    for (const auto& [product, factor] : sum) {
      Term term{double(factor), product.second, product.first.size(), {}};
      std::copy(product.first.begin(), product.first.end(), term.factors.begin());
      terms_.push_back(term);
    }
  }

  /// The value, given the partial derivatives `f` in the order of the monomials and the powers of 1 / f_z.
  template <class FT>
  FT operator()(const std::array<FT, Jet_3<FT>::size>& f, const std::array<FT, 8>& powers) const {
    FT sum(0);
    for (const Term& t : terms_) {
      FT product = FT(t.factor) * powers[std::size_t(t.exponent)];
      for (std::size_t n = 0; n < t.number_of_factors; ++n) product = product * f[t.factors[n]];
      sum = sum + product;
    }
    return sum;
  }

private:
  struct Term {
    double factor;
    int exponent; // of 1 / f_z
    std::size_t number_of_factors;
    std::array<std::size_t, 7> factors; // monomials
  };
  std::vector<Term> terms_;

  // Maps the sorted factors of a product and the exponent of 1 / f_z to the coefficient.
  using Factors = std::vector<int>;
  using Sum = std::map<std::pair<Factors, int>, int>;

  static int raised(int monomial, int axis) {
    const Monomial_3 m = monomials[std::size_t(monomial)];
    return monomial_index(m.i + (axis == 0), m.j + (axis == 1), m.k + (axis == 2));
  }

  static void add(Sum& sum, Factors factors, int exponent, int factor) {
    std::sort(factors.begin(), factors.end());
    sum[{std::move(factors), exponent}] += factor;
  }

  /// Adds D_axis of f_n, which is f_(n + axis) - f_axis f_(n + z) / f_z, times the other factors.
  static void add_derivative(Sum& sum, int n, Factors others, int axis, int exponent, int factor) {
    others.push_back(raised(n, axis));
    add(sum, others, exponent, factor);
    others.back() = raised(n, 2);
    others.push_back(raised(0, axis));
    add(sum, std::move(others), exponent + 1, -factor);
  }

  static Sum derivative(const Sum& sum, int axis) {
    Sum result;
    for (const auto& [product, factor] : sum) {
      const auto& [factors, exponent] = product;
      for (std::size_t n = 0; n < factors.size(); ++n) {
        Factors others = factors;
        others.erase(others.begin() + std::ptrdiff_t(n));
        add_derivative(result, factors[n], std::move(others), axis, exponent, factor);
      }
      add_derivative(result, raised(0, 2), factors, axis, exponent + 1, -exponent * factor);
    }
    std::erase_if(result, [](const auto& term) { return term.second == 0; });
    return result;
  }
};

// Section 2 of the paper: the surface as a graph z = g(x, y), differentiated by the implicit function theorem.

template <class FT>
FT determinant(const std::array<FT, 3>& a, const std::array<FT, 3>& b, const std::array<FT, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The derivatives g_ij of the graph, 1 <= i + j <= 4.
template <class FT>
struct Graph_derivatives {
  std::array<std::array<FT, 5>, 5> g;

  explicit Graph_derivatives(const std::array<FT, Jet_3<FT>::size>& f) {
    static const auto formulas = [] {
      std::array<std::array<Implicit_derivative, 5>, 5> table;
      for (int i = 0; i <= default_order; ++i)
        for (int j = 0; i + j <= default_order; ++j)
          if (i + j > 0) table[std::size_t(i)][std::size_t(j)] = Implicit_derivative(i, j);
      return table;
    }();
    std::array<FT, 8> powers; // of 1 / f_z
    powers[0] = FT(1);
    for (std::size_t n = 1; n < powers.size(); ++n) powers[n] = powers[n - 1] / f[3];
    for (std::size_t i = 0; i < g.size(); ++i)
      for (std::size_t j = 0; i + j < g.size(); ++j)
        if (i + j > 0) g[i][j] = formulas[i][j](f, powers);
  }

  /// A jet of order 1 in x and y: g_ij and its derivatives.
  auto with_gradient(std::size_t i, std::size_t j) const {
    Jet_3<FT, 1, 0b111> jet(g[i][j]);
    jet.template at<1>() = g[i + 1][j];
    jet.template at<2>() = g[i][j + 1];
    return jet;
  }
};

/// Permutes the axes cyclically so that `last` becomes z, and returns the derivatives of f with respect to the new
/// axes.
template <class FT>
std::array<FT, Jet_3<FT>::size> with_last_axis(const std::array<FT, Jet_3<FT>::size>& f, std::size_t last) {
  std::array<FT, Jet_3<FT>::size> r;
  for (std::size_t n = 0; n < r.size(); ++n) {
    std::array<int, 3> exponents;
    const Monomial_3 m = monomials[n];
    exponents[(last + 1) % 3] = m.i;
    exponents[(last + 2) % 3] = m.j;
    exponents[last] = m.k;
    r[n] = f[std::size_t(monomial_index(exponents[0], exponents[1], exponents[2]))];
  }
  return r;
}

/// The affine normal xi of section 2(d), each component with its derivatives with respect to x and y.
template <class FT>
auto normal_of_graph(const Graph_derivatives<FT>& graph) {
  using std::sqrt;
  const auto x = graph.with_gradient(1, 0), y = graph.with_gradient(0, 1);
  const auto xx = graph.with_gradient(2, 0), xy = graph.with_gradient(1, 1), yy = graph.with_gradient(0, 2);
  const auto xxx = graph.with_gradient(3, 0), xxy = graph.with_gradient(2, 1);
  const auto xyy = graph.with_gradient(1, 2), yyy = graph.with_gradient(0, 3);
  const auto d = xx * yy - xy * xy;
  const auto factor = sqrt(sqrt(d.value() < FT(0) ? -d : d)) / (FT(4) * (d * d));
  const auto xi1 = xx * xy * yyy - xx * yy * xyy - yy * yy * xxx - FT(2) * (xy * xy * xyy) + FT(3) * (yy * xy * xxy);
  const auto xi2 = yy * xy * xxx - xx * yy * xxy - xx * xx * yyy - FT(2) * (xy * xy * xxy) + FT(3) * (xx * xy * xyy);
  const auto xi3 = FT(4) * (xy * xy * xy * xy) + FT(4) * (xx * xx * yy * yy) - FT(8) * (xx * yy * xy * xy) +
                   FT(3) * (x * yy * xy * xxy) + FT(3) * (y * xx * xy * xyy) - x * yy * yy * xxx - y * xx * xx * yyy -
                   FT(2) * (x * xy * xy * xyy) - FT(2) * (y * xy * xy * xxy) - x * xx * yy * xyy - y * xx * yy * xxy +
                   x * xx * xy * yyy + y * yy * xy * xxx;
  return std::array{factor * xi1, factor * xi2, factor * xi3};
}

/// The direct method of section 2, with the given axis (0, 1, 2) as z. About 2,200 operations. Not finite if that
/// component of the gradient vanishes.
template <class FT>
Affine_estimate_3<FT> direct_estimate(const Jet_3<FT>& jet, std::size_t axis) {
  using std::abs;
  using std::sqrt;
  const auto f = with_last_axis(partial_derivatives(jet), axis);
  const Graph_derivatives<FT> graph(f);
  const auto& g = graph.g;
  const auto normal = normal_of_graph(graph);
  std::array<FT, 3> xi, xi_x, xi_y;
  for (std::size_t i = 0; i < 3; ++i) {
    xi[i] = normal[i].template at<0>();
    xi_x[i] = normal[i].template at<1>();
    xi_y[i] = normal[i].template at<2>();
  }
  const std::array<FT, 3> tangent_x = {FT(1), FT(0), g[1][0]}, tangent_y = {FT(0), FT(1), g[0][1]};
  const FT a4 = sqrt(FT(sqrt(FT(abs(g[2][0] * g[0][2] - g[1][1] * g[1][1])))));
  const FT b11 = -determinant(xi_x, tangent_y, xi) / a4, b12 = -determinant(tangent_x, xi_x, xi) / a4;
  const FT b21 = -determinant(xi_y, tangent_y, xi) / a4, b22 = -determinant(tangent_x, xi_y, xi) / a4;

  const FT sign = f[3] < FT(0) ? FT(-1) : FT(1); // the paper orients along the axis, this library along the gradient
  const std::array<FT, 3> conormal = {-g[1][0] / a4, -g[0][1] / a4, FT(1) / a4};
  Affine_estimate_3<FT> r;
  for (std::size_t i = 0; i < 3; ++i) {
    r.conormal[(axis + 1 + i) % 3] = sign * conormal[i];
    r.normal[(axis + 1 + i) % 3] = sign * xi[i];
  }
  r.gaussian_curvature = b11 * b22 - b12 * b21;
  r.mean_curvature = sign * (b11 + b22) / FT(2);
  return r;
}

// Section 3 of the paper: formulas after an affine map that makes the gradient (0, 0, 1) and f_xy zero.

template <class FT>
using Matrix_3 = std::array<std::array<FT, 3>, 3>;

/// The index of the monomial that is the product of the given variables (0: x, 1: y, 2: z).
constexpr std::size_t monomial_of(auto... variables) {
  std::array<int, 3> exponents{};
  (++exponents[variables], ...);
  return std::size_t(monomial_index(exponents[0], exponents[1], exponents[2]));
}

/// monomial_of(a, b, c, d) as a table.
inline constexpr auto products_of_four = [] {
  std::array<std::array<std::array<std::array<std::size_t, 3>, 3>, 3>, 3> table{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t d = 0; d < 3; ++d) table[a][b][c][d] = monomial_of(a, b, c, d);
  return table;
}();

/// monomial_of(a, b, c) as a table.
inline constexpr auto products_of_three = [] {
  std::array<std::array<std::array<std::size_t, 3>, 3>, 3> table{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t c = 0; c < 3; ++c) table[a][b][c] = monomial_of(a, b, c);
  return table;
}();

/// The map A = R2 S R1 of proposition 1 (`matrix`) and its inverse.
template <class FT>
struct Simplifying_map_3 {
  Matrix_3<FT> matrix, inverse;

  explicit Simplifying_map_3(const std::array<FT, Jet_3<FT>::size>& f) {
    using std::atan2;
    using std::cos;
    using std::sin;
    using std::sqrt;
    const FT eta = sqrt(FT(f[1] * f[1] + f[2] * f[2] + f[3] * f[3])), root = sqrt(eta);
    rotate_to_vertical(f[1] / eta, f[2] / eta, f[3] / eta);
    for (std::size_t i = 0; i < 3; ++i) // S = diag(eta^(-1/2), eta^(-1/2), eta)
      for (std::size_t j = 0; j < 3; ++j) {
        inverse[j][i] = i < 2 ? matrix[i][j] * root : matrix[i][j] / eta;
        matrix[i][j] = i < 2 ? matrix[i][j] / root : matrix[i][j] * eta;
      }
    const auto second = [&](std::size_t i, std::size_t j) {
      FT sum(0);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) sum = sum + f[monomial_of(a, b)] * inverse[a][i] * inverse[b][j];
      return sum;
    };
    // R2 rotates by theta with tan 2 theta = -2 f_xy / (f_xx - f_yy), which makes f_xy zero.
    const FT theta = atan2(FT(-2) * second(0, 1), FT(second(0, 0) - second(1, 1))) / FT(2);
    turn(cos(theta), sin(theta));
  }

private:
  /// The rotation with the rows t1, t2, n (Duff et al.: Building an orthonormal basis, revisited, 2017).
  void rotate_to_vertical(const FT& x, const FT& y, const FT& z) {
    const FT sign = z < FT(0) ? FT(-1) : FT(1), a = FT(-1) / (sign + z), b = x * y * a;
    matrix = {{{FT(1) + sign * x * x * a, sign * b, -sign * x}, {b, sign + y * y * a, -y}, {x, y, z}}};
  }

  void turn(const FT& c, const FT& s) {
    for (std::size_t j = 0; j < 3; ++j) {
      const FT u = matrix[0][j], v = matrix[1][j], p = inverse[j][0], q = inverse[j][1];
      matrix[0][j] = c * u - s * v;
      matrix[1][j] = s * u + c * v;
      inverse[j][0] = c * p - s * q;
      inverse[j][1] = s * p + c * q;
    }
  }
};

/// The derivatives of f(A^-1 p), by equation (4) of the paper without simplification.
template <class FT>
std::array<FT, Jet_3<FT>::size> mapped_derivatives(const std::array<FT, Jet_3<FT>::size>& f,
                                                   const Matrix_3<FT>& inverse) {
  std::array<FT, Jet_3<FT>::size> g{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t a = 0; a < 3; ++a) g[1 + i] = g[1 + i] + f[1 + a] * inverse[a][i];
    for (std::size_t j = i; j < 3; ++j) {
      FT second(0);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) second = second + f[monomial_of(a, b)] * inverse[a][i] * inverse[b][j];
      g[monomial_of(i, j)] = second;
      for (std::size_t k = j; k < 3; ++k) {
        FT third(0);
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b)
            for (std::size_t c = 0; c < 3; ++c)
              third = third + f[products_of_three[a][b][c]] * inverse[a][i] * inverse[b][j] * inverse[c][k];
        g[monomial_of(i, j, k)] = third;
        for (std::size_t l = k; l < 3; ++l) {
          FT fourth(0);
          for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b)
              for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t d = 0; d < 3; ++d)
                  fourth = fourth + f[products_of_four[a][b][c][d]] * inverse[a][i] * inverse[b][j] * inverse[c][k] *
                                        inverse[d][l];
          g[monomial_of(i, j, k, l)] = fourth;
        }
      }
    }
  }
  return g;
}

/// The formulas of section 3(b) for f_x = f_y = f_xy = 0 and f_z = 1, with x and y exchanged if `exchanged`.
template <class FT>
struct Simplified_formulas_3 {
  const std::array<FT, Jet_3<FT>::size>& f;
  bool exchanged;

  FT operator()(int i, int j, int k) const {
    return f[std::size_t(exchanged ? monomial_index(j, i, k) : monomial_index(i, j, k))];
  }

  /// xi_1 times 4 d^2 / |d|^(1/4).
  FT normal() const {
    const auto& D = *this;
    const FT xx = D(2, 0, 0), yy = D(0, 2, 0);
    return yy * yy * D(3, 0, 0) + xx * yy * D(1, 2, 0) - FT(4) * xx * yy * yy * D(1, 0, 1);
  }

  /// b_11 times 16 f_xx^3 f_yy^2 / |d|^(1/4), with the correction of doc/errata.md.
  FT b11() const {
    const auto& D = *this;
    const FT xx = D(2, 0, 0), yy = D(0, 2, 0), xz = D(1, 0, 1), yz = D(0, 1, 1), zz = D(0, 0, 2);
    const FT xxx = D(3, 0, 0), xxy = D(2, 1, 0), xyy = D(1, 2, 0), yyy = D(0, 3, 0), xxz = D(2, 0, 1), yyz = D(0, 2, 1);
    const FT xx2 = xx * xx, xx3 = xx2 * xx, yy2 = yy * yy;
    return FT(-16) * xx3 * yy2 * zz + FT(4) * xx3 * yy * yyz + FT(16) * xx3 * yy * yz * yz - FT(4) * xx3 * yyy * yz -
           FT(28) * xx2 * xxy * yy * yz + FT(4) * xx2 * xxy * yyy - FT(4) * xx2 * D(2, 2, 0) * yy +
           FT(28) * xx2 * xxz * yy2 + FT(3) * xx2 * xyy * xyy - FT(4) * xx2 * xyy * xz * yy +
           FT(16) * xx2 * xz * xz * yy2 + FT(2) * xx * xxx * xyy * yy - FT(28) * xx * xxx * xz * yy2 -
           FT(4) * xx * D(4, 0, 0) * yy2 + FT(12) * xx * xxy * xxy * yy + FT(7) * xxx * xxx * yy2;
  }

  /// b_21 times 16 f_xx^3 f_yy^2 / |d|^(1/4).
  FT b21() const {
    const auto& D = *this;
    const FT xx = D(2, 0, 0), yy = D(0, 2, 0), xz = D(1, 0, 1), yz = D(0, 1, 1);
    const FT xxx = D(3, 0, 0), xxy = D(2, 1, 0), xyy = D(1, 2, 0), yyy = D(0, 3, 0);
    return FT(15) * xx * yy * xxy * xyy - xx * yy * xxx * yyy - FT(4) * xx * xx * yy * D(1, 3, 0) -
           FT(24) * xx * xx * yy * yz * xyy - FT(4) * xx * yy * yy * D(3, 1, 0) +
           FT(24) * xx * xx * yy * yy * D(1, 1, 1) - FT(24) * xx * yy * yy * xz * xxy + FT(7) * yy * yy * xxx * xxy +
           FT(7) * xx * xx * xyy * yyy;
  }
};

/// The transformation method of section 3. About 7,900 operations, of which 7,335 transform the derivatives.
template <class FT>
Affine_estimate_3<FT> transformation_estimate(const Jet_3<FT>& jet) {
  using std::abs;
  using std::sqrt;
  const auto f = partial_derivatives(jet);
  const Simplifying_map_3<FT> map(f);
  const auto g = mapped_derivatives(f, map.inverse);
  const Simplified_formulas_3<FT> along_x{g, false}, along_y{g, true};
  const FT xx = along_x(2, 0, 0), yy = along_x(0, 2, 0), d = xx * yy, a4 = sqrt(FT(sqrt(FT(abs(d)))));

  const FT factor = a4 / (FT(16) * d * d), b11 = factor * along_x.b11() / xx, b22 = factor * along_y.b11() / yy;
  const FT b21 = factor * along_x.b21() / xx, b12 = factor * along_y.b21() / yy;
  const std::array<FT, 3> xi = {a4 * along_x.normal() / (FT(4) * d * d), a4 * along_y.normal() / (FT(4) * d * d), a4};

  Affine_estimate_3<FT> r;
  for (std::size_t i = 0; i < 3; ++i) {
    r.conormal[i] = map.matrix[2][i] / a4; // (0, 0, 1) A
    r.normal[i] = map.inverse[i][0] * xi[0] + map.inverse[i][1] * xi[1] + map.inverse[i][2] * xi[2];
  }
  r.gaussian_curvature = b11 * b22 - b12 * b21;
  r.mean_curvature = (b11 + b22) / FT(2);
  return r;
}

/// Scales the jet of f by a power of 2 so that the largest |f_i| is about 1. The paper's formulas raise derivatives to
/// the power of 7 and more, which easily leaves the range of FT. The surface does not depend on the factor.
template <class FT>
Jet_3<FT> with_gradient_about_one(Jet_3<FT> jet) {
  using std::abs;
  using std::frexp;
  using std::ldexp;
  const auto& c = jet.coefficients();
  const FT size = std::max({FT(abs(c[1])), FT(abs(c[2])), FT(abs(c[3]))});
  if (size > FT(0) && is_finite_number(size)) {
    int exponent;
    frexp(size, &exponent);
    const FT factor = ldexp(FT(1), -std::clamp(exponent, -1000, 1000)); // finite also for subnormal sizes
    for (FT& x : jet.coefficients()) x = x * factor;
  }
  return jet;
}

} // namespace internal

/// Computes co-normal, normal and curvatures by the given estimator. They are not finite if they do not exist.
template <class FT>
Affine_estimate_3<FT> affine_estimate(const Jet_3<FT>& jet_of_any_size, Estimator estimator) {
  using std::abs;
  const Jet_3<FT> jet = internal::with_gradient_about_one(jet_of_any_size);
  switch (estimator) {
  case Estimator::TRANSFORMATION: return internal::transformation_estimate(jet);
  case Estimator::DIRECT: {
    const auto& c = jet.coefficients();
    const FT x = abs(c[1]), y = abs(c[2]), z = abs(c[3]);
    return internal::direct_estimate(jet, x > y && x > z ? 0 : y > z ? 1 : 2);
  }
  case Estimator::DIRECT_Z: return internal::direct_estimate(jet, 2);
  default: {
    const auto s = affine_invariants(Monge_chart_3<FT>(jet));
    return {s.conormal, s.normal, s.gaussian_curvature, s.mean_curvature};
  }
  }
}

/// Equivalent to local_structure(jet, point, rounding), except that the co-normal, normal, Gaussian and mean curvature
/// of the affine structure come from the given estimator. If only the estimator fails, as DIRECT_Z does if f_z is zero
/// or almost zero, the status is OUTSIDE and all numbers are NaN.
template <class FT>
Local_structure_3<FT> local_structure(const Jet_3<FT>& jet, const std::array<FT, 3>& point, const FT& rounding,
                                      Estimator estimator) {
  Local_structure_3<FT> s = local_structure(jet, point, rounding);
  if (s.status != Point_status::REGULAR || estimator == Estimator::COMPACT) return s;
  const Affine_estimate_3<FT> estimate = affine_estimate(jet, estimator);
  s.affine.conormal = estimate.conormal;
  s.affine.normal = estimate.normal;
  s.affine.gaussian_curvature = estimate.gaussian_curvature;
  s.affine.mean_curvature = estimate.mean_curvature;
  if (internal::is_finite(s.affine)) return s;
  return {Point_status::OUTSIDE, internal::no_euclidean_structure<FT>(), internal::no_affine_structure<FT>()};
}

} // namespace equiaffine

#endif
