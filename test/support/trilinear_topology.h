// SPDX-License-Identifier: GPL-3.0-or-later
// The topology of the zero set of the trilinear interpolant of a grid, computed without a mesh.
//
// P and N are where f >= 0 and f <= 0. The box is contractible, so the zero set S, their intersection, has
// b0(S) = b0(P) + b0(N) - 1 and chi(S) = chi(P) + chi(N) - 1 (Mayer, Vietoris). chi(P) is the alternating sum over the
// cells and the inner faces, edges and nodes of the grid (inclusion and exclusion). In a face the components of P are
// contractible, so their number is chi; a cell is a stack of such slices.
#ifndef EQUIAFFINE_TEST_SUPPORT_TRILINEAR_TOPOLOGY_H
#define EQUIAFFINE_TEST_SUPPORT_TRILINEAR_TOPOLOGY_H

#include "support/random_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

struct Trilinear_topology {
  long components, euler_characteristic;
};

namespace trilinear_topology {

using Real = long double;

struct Partition {
  std::vector<std::size_t> parent;
  explicit Partition(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), std::size_t(0)); }
  std::size_t root(std::size_t a) const { return parent[a] == a ? a : root(parent[a]); }
  void join(std::size_t a, std::size_t b) { parent[root(a)] = root(b); }
};

/// The positive corners 00, 10, 01, 11 of a bilinear function, and which of them are in one component of P.
struct Slice {
  std::array<bool, 4> is_positive{};
  Partition components{4};

  explicit Slice(const std::array<Real, 4>& f) {
    for (std::size_t c = 0; c < 4; ++c) is_positive[c] = f[c] >= 0;
    for (const auto& [a, b] : {std::pair(0U, 1U), std::pair(0U, 2U), std::pair(1U, 3U), std::pair(2U, 3U)}) join(a, b);
    const Real saddle = f[0] * f[3] - f[1] * f[2];
    if (saddle > 0) join(0, 3);
    else join(1, 2);
  }

  /// Marks corners that are positive in the other slice as positive, and joins those that it joins.
  void unite(const Slice& other) {
    for (std::size_t c = 0; c < 4; ++c) is_positive[c] = is_positive[c] || other.is_positive[c];
    for (std::size_t c = 0; c < 4; ++c) components.join(c, other.components.root(c));
    for (const auto& [a, b] : {std::pair(0U, 1U), std::pair(0U, 2U), std::pair(1U, 3U), std::pair(2U, 3U)}) join(a, b);
  }

  void join(std::size_t a, std::size_t b) {
    if (is_positive[a] && is_positive[b]) components.join(a, b);
  }

  long number_of_components() const {
    long n = 0;
    for (std::size_t c = 0; c < 4; ++c) n += is_positive[c] && components.root(c) == c;
    return n;
  }
};

/// chi of P in a cell; joins the corners that are connected in it. Nothing if the order of the critical slices is
/// uncertain.
template <class Join>
std::optional<long> sweep(const std::array<Real, 8>& f, Join join) {
  std::array<Real, 4> slope;
  std::vector<Real> events{0, 1};
  for (std::size_t c = 0; c < 4; ++c) {
    slope[c] = f[c + 4] - f[c];
    if ((f[c] >= 0) != (f[c + 4] >= 0)) events.push_back(-f[c] / slope[c]);
  }
  const Real a = slope[0] * slope[3] - slope[1] * slope[2], c0 = f[0] * f[3] - f[1] * f[2];
  const Real b = f[0] * slope[3] + f[3] * slope[0] - f[1] * slope[2] - f[2] * slope[1];
  const Real discriminant = b * b - 4 * a * c0;
  if (std::abs(discriminant) < 1e-9L * (b * b + std::abs(4 * a * c0))) return std::nullopt;
  if (discriminant > 0) {
    const Real q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
    for (const Real z : {q / a, c0 / q})
      if (z > 0 && z < 1) events.push_back(z);
  }
  std::sort(events.begin(), events.end());
  std::vector<Slice> slabs;
  for (std::size_t n = 0; n + 1 < events.size(); ++n) {
    if (events[n + 1] - events[n] < 1e-11L) return std::nullopt;
    const Real z = (events[n] + events[n + 1]) / 2;
    std::array<Real, 4> values;
    for (std::size_t c = 0; c < 4; ++c) values[c] = f[c] + z * slope[c];
    slabs.emplace_back(values);
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t d = 0; d < 4; ++d) {
        const Slice& slice = slabs.back();
        if (!slice.is_positive[c] || !slice.is_positive[d] || slice.components.root(c) != slice.components.root(d))
          continue;
        join(f[c] >= 0 ? c : c + 4, f[d] >= 0 ? d : d + 4);
      }
  }
  for (std::size_t c = 0; c < 4; ++c)
    if (f[c] >= 0 && f[c + 4] >= 0) join(c, c + 4);
  long chi = slabs.front().number_of_components() + slabs.back().number_of_components();
  for (std::size_t n = 0; n < slabs.size(); ++n) {
    chi -= slabs[n].number_of_components();
    if (n + 1 == slabs.size()) break;
    Slice event = slabs[n];
    event.unite(slabs[n + 1]);
    chi += event.number_of_components();
  }
  return chi;
}

/// The number of components and chi of P for sign = 1, and of N for sign = -1.
inline std::optional<Trilinear_topology> of_positive_part(const Grid& grid, double sign, std::size_t sweep_axis) {
  const auto& n = grid.size;
  Partition nodes(grid.values.size());
  long chi = 0;
  // The loops visit every cell, face, edge and node in the interior of the grid. Bit a of `extent` is set if it extends
  // along axis a.
  for (std::size_t extent = 0; extent < 8; ++extent) {
    const auto along = [&](std::size_t axis) { return extent >> axis & 1; };
    std::vector<std::size_t> axes;
    for (const std::size_t axis : {(sweep_axis + 1) % 3, (sweep_axis + 2) % 3, sweep_axis})
      if (along(axis)) axes.push_back(axis);
    const auto begin = [&](std::size_t axis) { return along(axis) ? 0U : 1U; };
    for (std::size_t k = begin(2); k + 1 < n[2]; ++k)
      for (std::size_t j = begin(1); j + 1 < n[1]; ++j)
        for (std::size_t i = begin(0); i + 1 < n[0]; ++i) {
          std::array<std::size_t, 8> node{};
          std::array<Real, 8> f{};
          bool is_positive = false;
          for (std::size_t c = 0; c < std::size_t(1) << axes.size(); ++c) {
            std::array<std::size_t, 3> at = {i, j, k};
            for (std::size_t a = 0; a < axes.size(); ++a) at[axes[a]] += c >> a & 1;
            node[c] = grid.index(at[0], at[1], at[2]);
            f[c] = sign * grid.values[node[c]];
            if (f[c] >= 0) is_positive = true;
          }
          if (axes.size() < 2) {
            chi += (axes.empty() ? -1 : 1) * is_positive;
          } else if (axes.size() == 2) {
            chi -= Slice({f[0], f[1], f[2], f[3]}).number_of_components();
          } else {
            const auto cell = sweep(f, [&](std::size_t a, std::size_t b) { nodes.join(node[a], node[b]); });
            if (!cell) return std::nullopt;
            chi += *cell;
          }
        }
  }
  long components = 0;
  for (std::size_t v = 0; v < grid.values.size(); ++v) components += sign * grid.values[v] >= 0 && nodes.root(v) == v;
  return Trilinear_topology{components, chi};
}

} // namespace trilinear_topology

/// The topology of the zero set, found by a sweep along `axis`. Nothing if a value is zero, or a saddle value nearly
/// zero.
inline std::optional<Trilinear_topology> topology_of_trilinear_surface(const Grid& grid, std::size_t axis) {
  for (const double x : grid.values)
    if (x == 0) return std::nullopt;
  const auto positive = trilinear_topology::of_positive_part(grid, 1, axis);
  const auto negative = trilinear_topology::of_positive_part(grid, -1, axis);
  if (!positive || !negative) return std::nullopt;
  return Trilinear_topology{positive->components + negative->components - 1,
                            positive->euler_characteristic + negative->euler_characteristic - 1};
}

#endif
