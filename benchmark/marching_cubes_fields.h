// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BENCHMARK_MARCHING_CUBES_FIELDS_H
#define EQUIAFFINE_BENCHMARK_MARCHING_CUBES_FIELDS_H

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

/// The values of a function at the n^3 nodes of the cube [-1, 1]^3, i fastest; the surface is where they are 0.
template <class FT>
struct Field {
  std::string name;
  std::size_t n;
  std::vector<FT> values;
};

/// Replaces each value by the mean of the node and its neighbors, three times.
template <class FT>
void smooth(Field<FT>& field) {
  for (int pass = 0; pass < 3; ++pass)
    for (const std::size_t stride : {std::size_t(1), field.n, field.n * field.n}) {
      const std::vector<FT> old = field.values;
      for (std::size_t v = stride; v + stride < old.size(); ++v)
        field.values[v] = (old[v - stride] + old[v] + old[v + stride]) / 3;
    }
}

/// sphere: of radius 0.8. gyroid: n / 32 periods along each axis. white_noise: uniform in [-1, 1], and noise: smoothed.
template <class FT>
Field<FT> make_field(const std::string& kind, std::size_t n) {
  Field<FT> field{kind + "_" + std::to_string(n), n, {}};
  field.values.reserve(n * n * n);
  std::mt19937 random(1);
  const auto coordinate = [&](std::size_t a) { return 2 * double(a) / double(n - 1) - 1; };
  const double w = 4 * std::numbers::pi * double(n) / 64;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        const double x = coordinate(i), y = coordinate(j), z = coordinate(k);
        if (kind == "sphere") field.values.push_back(FT(x * x + y * y + z * z - 0.64));
        else if (kind == "gyroid")
          field.values.push_back(FT(std::sin(w * x) * std::cos(w * y) + std::sin(w * y) * std::cos(w * z) +
                                    std::sin(w * z) * std::cos(w * x)));
        else field.values.push_back(FT(double(random()) / 2147483648.0 - 1));
      }
  if (kind == "noise") smooth(field);
  return field;
}

#endif
