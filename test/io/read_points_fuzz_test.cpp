// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes on standard input are points in PLY, OFF or CSV or refused, and points that are read, written and read
// again are the same.
#include "support/fuzz_target.h"
#include <equiaffine/io/read_points.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <bit>
#include <iostream>
#include <sstream>

namespace read_points_fuzz_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Table = Point_table_3<Kernel>;
using test::expect;

Table read_from_standard_input(const std::string& text) {
  std::istringstream stream(text);
  std::streambuf* const before = std::cin.rdbuf(stream.rdbuf());
  try {
    Table table = read_points<Kernel>("-");
    std::cin.rdbuf(before);
    return table;
  } catch (...) {
    std::cin.rdbuf(before);
    throw;
  }
}

bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void check_table(const Table& table) {
  const std::size_t size = table.mesh.points.size();
  expect(table.attributes.has_length(size), "every column has a number per point");
  expect(table.cells.size() == table.header.size() * size, "every row has a cell per column");
  for (const auto& triangle : table.mesh.triangles)
    for (const std::size_t v : triangle) expect(v < size, "triangles have vertices that exist");
}

void check_round_trip(const Table& table) {
  std::stringstream stream;
  write_CSV(stream, table, {});
  const Table again = read_CSV<Kernel>(stream, "written");
  expect(again.mesh.points.size() == table.mesh.points.size(), "as many points are read as were written");
  for (std::size_t n = 0; n < table.mesh.points.size(); ++n)
    for (int axis = 0; axis < 3; ++axis)
      expect(is_same(again.mesh.points[n][axis], table.mesh.points[n][axis]), "points that are written stay the same");
}

EQUIAFFINE_FUZZ_TARGET(points) {
  equiaffine::test::accepts([&] {
    const Table table = read_from_standard_input(std::string(input));
    check_table(table);
    if (!table.header.empty()) check_round_trip(table);
  });
}

} // namespace read_points_fuzz_test
