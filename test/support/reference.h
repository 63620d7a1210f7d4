// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of data/affine_structure.csv: local structure with 30 digits, computed without formulas for implicit
// functions (graph heights by root finding, numerical differentiation with 80 digits).
#ifndef EQUIAFFINE_TEST_SUPPORT_REFERENCE_H
#define EQUIAFFINE_TEST_SUPPORT_REFERENCE_H

#include <array>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

struct Reference_row {
  std::string surface, expression;
  std::array<double, 3> point, nu, xi;
  double affine_K, affine_H, pick_J, euclidean_K, euclidean_H, limit;
};

inline std::vector<Reference_row> read_reference(const std::string& path) {
  std::ifstream file(path);
  std::vector<Reference_row> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const std::size_t open = line.find('"'), close = line.find('"', open + 1);
    if (close == std::string::npos) throw std::runtime_error("no expression in: " + line);
    std::array<double, 15> numbers;
    const char* position = line.c_str() + close + 2;
    for (double& number : numbers) {
      char* end;
      number = std::strtod(position, &end);
      position = end + 1;
    }
    const auto triple = [&](std::size_t n) { return std::array{numbers[n], numbers[n + 1], numbers[n + 2]}; };
    rows.push_back({line.substr(0, open - 1), line.substr(open + 1, close - open - 1), triple(0), triple(3), triple(6),
                    numbers[9], numbers[10], numbers[11], numbers[12], numbers[13], numbers[14]});
  }
  return rows;
}

#endif
