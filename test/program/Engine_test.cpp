// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/Engine.h"
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/surface/distance_to_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace Engine_test {

using namespace equiaffine;

std::uint64_t bits(double x) { return std::isnan(x) ? 0 : std::bit_cast<std::uint64_t>(x); }

void expect_equal(const Vertex_attributes& actual, const Vertex_attributes& expected, std::size_t first = 0) {
  for (std::size_t c = 0; c < expected.columns.size(); ++c)
    for (std::size_t i = 0; i < actual.columns[c].values.size(); ++i)
      ASSERT_EQ(bits(actual.columns[c].values[i]), bits(expected.columns[c].values[first + i]))
          << expected.columns[c].name << " of point " << first + i;
  for (std::size_t i = 0; i < actual.status->size(); ++i)
    ASSERT_EQ((*actual.status)[i], (*expected.status)[first + i]) << "point " << first + i;
}

/// Random points; some of them lie on kinks of the formula, are singular, or lie outside its box.
std::vector<Kernel::Point_3> points() {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Kernel::Point_3> result;
  for (int n = 0; n < 1003; ++n)
    result.emplace_back(n % 13 == 0 ? 0 : unit(random), n % 17 == 0 ? 0 : unit(random), n % 19 == 0 ? 3 : unit(random));
  return result;
}

const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
const char* const formula = "exp(x*y) + abs(x)*sin(3*z) + sqrt(1.5 - y^2*z) + log(z + 2) - max(x, y)^3 + z^7";

template <class Traits>
void expect_same_on_all_instruction_sets(const Traits& function) {
  const auto p = points();
  const Attribute_selection selection = select_attributes("all");
  const Attribute_task<Traits> task{function, Orientation_of_level_set::AGAINST_GRADIENT, p, selection};
  const Vertex_attributes expected = engine<Traits>(Instruction_set::BASELINE).compute_attributes(task);
  ASSERT_EQ(expected.status->size(), p.size());
  for (const Instruction_set set : instruction_sets()) {
    SCOPED_TRACE(int(set));
    expect_equal(engine<Traits>(set).compute_attributes(task), expected);
    for (std::size_t i = 0; i < 20; ++i) {
      Attribute_task<Traits> single = task;
      single.points = std::span(p).subspan(i, 1);
      expect_equal(engine<Traits>(set).compute_attributes(single), expected, i);
    }
  }
}

/// Expects each instruction set to give the surface that Marching Cubes of the library gives at all nodes.
template <class Traits>
void expect_same_surface_on_all_instruction_sets(const Traits& function) {
  const Level_set_traits_3<Traits> level_set(function, 0.1);
  const std::array<std::size_t, 3> nodes = {33, 31, 32};
  const Isosurface_3<Kernel> expected = marching_cubes(level_set, parameters::number_of_nodes(nodes));
  ASSERT_GT(expected.triangles.size(), 100u);
  const double distance = max_distance_to_surface(level_set, std::span(expected.points), expected.vertex_status);
  for (const Instruction_set set : instruction_sets()) {
    SCOPED_TRACE(int(set));
    const auto surface = engine<Traits>(set).marching_cubes(level_set, nodes, Vertex_position::PROJECTED);
    EXPECT_EQ(surface.triangles, expected.triangles);
    EXPECT_EQ(surface.vertex_status, expected.vertex_status);
    ASSERT_EQ(surface.points.size(), expected.points.size());
    for (std::size_t v = 0; v < surface.points.size(); ++v)
      for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(bits(surface.points[v][axis]), bits(expected.points[v][axis]));
    EXPECT_EQ(bits(engine<Traits>(set).max_distance_to_surface(level_set, surface.points, surface.vertex_status)),
              bits(distance));
  }
}

TEST(Program_engine, a_formula_has_the_same_numbers_on_all_instruction_sets_bit_for_bit) {
  const Formula_traits traits_of_formula(Expression_3(formula), box);
  const Formula_function traits(traits_of_formula);
  expect_same_on_all_instruction_sets(traits);
  const CGAL::Aff_transformation_3<Kernel> map(0.9, 0, 0.9, 0.1, 0, 2, 0, 0, 1.1, 0, 0.6, 0);
  const Formula_function image(traits_of_formula, map);
  expect_same_on_all_instruction_sets(image);
  expect_same_surface_on_all_instruction_sets(traits);
  expect_same_surface_on_all_instruction_sets(image);
}

TEST(Program_engine, samples_have_the_same_numbers_on_all_instruction_sets_bit_for_bit) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  Volume_3<Kernel> volume{Lattice_3<Kernel>({12, 11, 13}, box), {}};
  for (std::size_t n = 0; n < volume.lattice.number_of_nodes(); ++n) volume.values.push_back(unit(random));
  const Spline_function spline{Spline_traits(std::move(volume))};
  expect_same_on_all_instruction_sets(spline);
  expect_same_surface_on_all_instruction_sets(spline);
}

TEST(Program_engine, the_first_instruction_set_is_that_of_any_processor) {
  const auto sets = instruction_sets();
  EXPECT_EQ(sets.front(), Instruction_set::BASELINE);
  EXPECT_TRUE(std::is_sorted(sets.begin(), sets.end()));
}

#ifdef EQUIAFFINE_OBJECTS_FOR_PROCESSORS
/// What a command of the shell prints, or a text that says that it failed.
std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = ::popen(command.c_str(), "r");
  for (int c; pipe && (c = std::fgetc(pipe)) != EOF;) text += char(c);
  return ::pclose(pipe) == 0 ? text : "failed: " + command;
}

// If they shared more, the linker could use an inline function compiled for AVX-512 in the whole program.
TEST(Program_engine, objects_for_some_processors_share_no_code_but_their_entry) {
  const std::string names = EQUIAFFINE_OBJECTS_FOR_PROCESSORS;
  for (std::size_t begin = 0; begin < names.size();) {
    const std::size_t end = std::min(names.find(' ', begin), names.size());
    const std::string defined = output_of("nm --extern-only --defined-only " + names.substr(begin, end - begin));
    EXPECT_EQ(std::count(defined.begin(), defined.end(), '\n'), 2) << defined;
    EXPECT_NE(defined.find("Progress_observer9of_threadEvE8observer"), std::string::npos) << defined;
    EXPECT_NE(defined.find(" T equiaffine_engines_avx"), std::string::npos) << defined;
    begin = end + 1;
  }
}
#endif

} // namespace Engine_test
