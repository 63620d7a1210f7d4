// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Without_bounds.h"
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/engine/vectorized.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/surface/distance_to_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace vectorized_test {

using namespace equiaffine;
using vectorized::Formula;
using vectorized::Instruction_set;
using vectorized::instruction_sets;
using vectorized::Kernel;
using vectorized::Spline;

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

/// Expects each instruction set to give the numbers that the templates of the library give.
template <class Function>
void expect_same_on_all_instruction_sets(const Function& function) {
  const auto p = points();
  const Attribute_selection selection = select_attributes("all");
  const Level_set_traits_3<Function> level_set(function, 0.2, Orientation_of_level_set::AGAINST_GRADIENT);
  const Vertex_attributes expected = compute_attributes(level_set, p, selection);
  ASSERT_EQ(expected.status->size(), p.size());
  for (const Instruction_set set : instruction_sets()) {
    SCOPED_TRACE(int(set));
    const auto attributes = [&](std::span<const Kernel::Point_3> at) {
      return vectorized::compute_attributes(level_set, at, selection, {}, set);
    };
    expect_equal(attributes(p), expected);
    for (std::size_t i = 0; i < 20; ++i) expect_equal(attributes(std::span(p).subspan(i, 1)), expected, i);
  }
}

constexpr std::array<std::size_t, 3> nodes = {33, 31, 32};

Isosurface_3<Kernel> surface_of(const Level_set_traits_3<Formula>& level_set, Instruction_set set) {
  return vectorized::marching_cubes(level_set, {.resolution = nodes}, set);
}

Isosurface_3<Kernel> surface_of(const Level_set_traits_3<Spline>& level_set, Instruction_set set) {
  return vectorized::marching_cubes(level_set, {}, set);
}

/// Expects each instruction set to give the surface that Marching Cubes of the library gives at all nodes.
template <class Function>
void expect_same_surface_on_all_instruction_sets(const Function& function) {
  const Level_set_traits_3<Function> level_set(function, 0.1);
  const Isosurface_3<Kernel> expected = marching_cubes(Without_bounds(level_set), {.resolution = nodes});
  ASSERT_GT(expected.triangles.size(), 100u);
  const double distance = max_distance_to_surface(level_set, std::span(expected.points), expected.vertex_status);
  for (const Instruction_set set : instruction_sets()) {
    SCOPED_TRACE(int(set));
    const auto surface = surface_of(level_set, set);
    EXPECT_EQ(surface.triangles, expected.triangles);
    EXPECT_EQ(surface.vertex_status, expected.vertex_status);
    ASSERT_EQ(surface.points.size(), expected.points.size());
    for (std::size_t v = 0; v < surface.points.size(); ++v)
      for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(bits(surface.points[v][axis]), bits(expected.points[v][axis]));
    EXPECT_EQ(bits(vectorized::max_distance_to_surface(level_set, surface.points, surface.vertex_status, set)),
              bits(distance));
  }
}

TEST(vectorized, a_formula_has_the_same_numbers_on_all_instruction_sets_bit_for_bit) {
  const auto traits_of_formula = make_analytic_traits<Kernel>(Expression_3(formula), box);
  const Formula traits(traits_of_formula);
  expect_same_on_all_instruction_sets(traits);
  const CGAL::Aff_transformation_3<Kernel> map(0.9, 0, 0.9, 0.1, 0, 2, 0, 0, 1.1, 0, 0.6, 0);
  const Formula image(traits_of_formula, map);
  expect_same_on_all_instruction_sets(image);
  expect_same_surface_on_all_instruction_sets(traits);
  expect_same_surface_on_all_instruction_sets(image);
}

TEST(vectorized, samples_have_the_same_numbers_on_all_instruction_sets_bit_for_bit) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  Volume_3<Kernel> volume{Lattice_3<Kernel>({12, 11, 13}, box), {}};
  for (std::size_t n = 0; n < volume.lattice.number_of_nodes(); ++n) volume.values.push_back(unit(random));
  const Spline spline{Sampled_function_traits_3(std::move(volume))};
  expect_same_on_all_instruction_sets(spline);
  expect_same_surface_on_all_instruction_sets(spline);
}

TEST(vectorized, the_first_instruction_set_is_that_of_any_processor) {
  const auto sets = instruction_sets();
  EXPECT_EQ(sets.front(), Instruction_set::BASELINE);
  EXPECT_TRUE(std::is_sorted(sets.begin(), sets.end()));
}

TEST(vectorized, an_instruction_set_that_the_processor_does_not_have_is_refused) {
  const Level_set_traits_3<Formula> sphere(
      Formula(make_analytic_traits<Kernel>(Expression_3("x^2 + y^2 + z^2 - 0.5"), box)), 0.);
  EXPECT_THROW(vectorized::marching_cubes(sphere, {.resolution = nodes}, Instruction_set(99)), std::invalid_argument);
}

TEST(vectorized, an_exception_leaves_the_code_for_the_processor) {
  const Level_set_traits_3<Formula> sphere(
      Formula(make_analytic_traits<Kernel>(Expression_3("x^2 + y^2 + z^2 - 0.5"), box)), 0.);
  EXPECT_THROW(vectorized::marching_cubes(sphere, {.resolution = {1, 2, 2}}), Input_error);
  const std::size_t many = std::size_t(1) << 40;
  EXPECT_THROW(vectorized::marching_cubes(sphere, {.resolution = many}), Input_error);
  struct Ended {};
  const Progress_observer observer([](const Progress_observer::Stage&) { throw Ended(); }, std::chrono::seconds(0));
  EXPECT_THROW(vectorized::marching_cubes(sphere, {.resolution = nodes}), Ended);
}

#ifdef EQUIAFFINE_OBJECTS_FOR_PROCESSORS
/// What a command of the shell prints, or a text that says that it failed.
std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = ::popen(command.c_str(), "r");
  for (int c; pipe && (c = std::fgetc(pipe)) != EOF;) text += char(c);
  return ::pclose(pipe) == 0 ? text : "failed: " + command;
}

// If they shared more, the linker could use an inline function compiled for AVX-512 in the whole program. An
// initializer would run on any processor.
TEST(vectorized, objects_for_some_processors_share_no_code_but_their_entry_and_run_nothing_at_start) {
  const std::string names = EQUIAFFINE_OBJECTS_FOR_PROCESSORS;
  for (std::size_t begin = 0; begin < names.size();) {
    const std::size_t end = std::min(names.find(' ', begin), names.size());
    const std::string defined = output_of("nm --extern-only --defined-only " + names.substr(begin, end - begin));
    std::istringstream lines(defined);
    for (std::string line; std::getline(lines, line);)
      EXPECT_TRUE(line.find(" T equiaffine_engines_") != std::string::npos ||
                  line.find("Progress_observer9of_threadEvE8observer") != std::string::npos ||
                  line.ends_with("V _ZTIN10equiaffine11Input_errorE") ||
                  line.ends_with("V _ZTSN10equiaffine11Input_errorE"))
          << line;
    EXPECT_NE(defined.find(" T equiaffine_engines_"), std::string::npos) << defined;
    const std::string sections = output_of("objdump --section-headers " + names.substr(begin, end - begin));
    EXPECT_NE(sections.find(" .text "), std::string::npos) << sections;
    EXPECT_EQ(sections.find(" .init_array "), std::string::npos) << sections;
    begin = end + 1;
  }
}
#endif

} // namespace vectorized_test
