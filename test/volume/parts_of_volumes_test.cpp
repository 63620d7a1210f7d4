// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/error_field.h"
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes_in_slabs.h>
#include <equiaffine/volume/Sample_noise.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <barrier>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace parts_of_volumes_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;
using Traits = Sampled_function_traits_3<Kernel>;

/// Waves on a sheared, left-handed lattice, with some noise, as floats.
struct Samples {
  Lattice_3<Kernel> lattice;
  std::vector<float> values;

  explicit Samples(const std::array<std::size_t, 3>& size, double deviation = 1e-3)
      : lattice(size, Point_3(0.1, -0.2, 0.3),
                {Vector_3(0.1, 0.02, 0), Vector_3(0, -0.11, 0.01), Vector_3(0, 0, 0.09)}) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 1);
    for (std::size_t k = 0; k < size[2]; ++k)
      for (std::size_t j = 0; j < size[1]; ++j)
        for (std::size_t i = 0; i < size[0]; ++i) {
          const Point_3 p = lattice.point(double(i), double(j), double(k));
          values.push_back(
              float(std::sin(2.3 * p.x()) + std::cos(2.1 * p.y()) * std::sin(1.9 * p.z()) + deviation * noise(random)));
        }
  }

  Volume_view_3<Kernel> whole() const { return {lattice, values.data()}; }

  /// A copy of the samples at the nodes of some cells, and of nothing else.
  Volume_view_3<Kernel> part(const Cell_block& cells) const {
    std::array<std::size_t, 3> n;
    for (std::size_t a = 0; a < 3; ++a) n[a] = cells.end[a] + 1 - cells.first[a];
    const auto copy = std::make_shared<std::vector<float>>();
    for (std::size_t k = 0; k < n[2]; ++k)
      for (std::size_t j = 0; j < n[1]; ++j)
        for (std::size_t i = 0; i < n[0]; ++i) {
          const std::size_t node = lattice.index(cells.first[0] + i, cells.first[1] + j, cells.first[2] + k);
          copy->push_back(node < values.size() ? values[node] : 0); // cells beyond the lattice are refused below
        }
    const auto step = std::ptrdiff_t(sizeof(float)), row = step * std::ptrdiff_t(n[0]);
    return Volume_view_3<Kernel>::part(lattice, cells, copy->data(), {step, row, row * std::ptrdiff_t(n[1])}, copy);
  }
};

std::vector<Cell_block> blocks_of(const std::array<std::size_t, 3>& nodes,
                                  const std::array<std::vector<std::size_t>, 3>& ends) {
  std::vector<Cell_block> blocks;
  for (std::size_t z = 0; z + 1 < ends[2].size(); ++z)
    for (std::size_t y = 0; y + 1 < ends[1].size(); ++y)
      for (std::size_t x = 0; x + 1 < ends[0].size(); ++x)
        blocks.push_back({{ends[0][x], ends[1][y], ends[2][z]}, {ends[0][x + 1], ends[1][y + 1], ends[2][z + 1]}});
  EXPECT_EQ(blocks.back().end, cells_of(nodes).end);
  return blocks;
}

/// The attributes of a vertex, bit for bit.
using Numbers = std::vector<std::uint64_t>;

/// The mesh of a block with attributes: vertices by ids, and triangles.
struct Mesh {
  std::map<Vertex_id, Numbers> vertices;
  std::vector<std::array<Vertex_id, 3>> triangles;

  template <class Function>
  void add(const Function& function, const Cell_block& block, const Cell_block& known,
           const Attribute_selection& selection) {
    std::vector<Vertex_id> ids;
    marching_cubes_of_block(
        function, block,
        [&](const Isosurface_slab_3<Kernel>& slab) {
          ids.insert(ids.end(), slab.vertex_ids.begin(), slab.vertex_ids.end());
          const Vertex_attributes attributes =
              compute_attributes(function, std::span<const Point_3>(slab.points), selection, slab.vertex_status);
          for (std::size_t v = 0; v < slab.points.size(); ++v) {
            Numbers numbers = {std::uint64_t((*attributes.status)[v])};
            const auto add = [&](double x) { numbers.push_back(std::bit_cast<std::uint64_t>(x)); };
            for (int c = 0; c < 3; ++c) add(slab.points[v][c]);
            for (const auto& column : attributes.columns) add(column.values[v]);
            const auto [place, is_new] = vertices.try_emplace(slab.vertex_ids[v], numbers);
            EXPECT_TRUE(is_new || place->second == numbers);
          }
          for (const auto& [a, b, c] : slab.triangles) triangles.push_back({ids[a], ids[b], ids[c]});
        },
        {}, known);
  }

  void sort() { std::sort(triangles.begin(), triangles.end()); }
};

constexpr std::array<std::size_t, 3> nodes = {27, 24, 30};

/// Expects that the functions of parts of a volume together have the mesh and the attributes of the whole one.
void expect_same(const Volume_options& parameters, const std::array<std::vector<std::size_t>, 3>& ends,
                 const char* attributes, const std::string& name) {
  const Attribute_selection selection = select_attributes(attributes);
  const Samples samples(nodes);
  constexpr double isovalue = 0.2;
  const Traits whole(samples.whole(), parameters);
  Mesh expected, mesh;
  expected.add(Level_set_traits_3(whole, isovalue), cells_of(nodes), cells_of(nodes), selection);
  ASSERT_FALSE(expected.triangles.empty());
  const std::vector<Cell_block> blocks = blocks_of(nodes, ends);
  std::vector<Volume_view_3<Kernel>> parts;
  std::vector<Cell_block> known;
  for (const Cell_block& block : blocks) {
    known.push_back(widened(block, cells_around_block, cells_of(nodes)));
    parts.push_back(samples.part(cells_to_know(known.back(), nodes, parameters)));
  }
  Volume_survey survey;
  for (std::size_t n = 0; n < blocks.size(); ++n)
    Traits(parts[n], parameters, Volume_part{blocks[n], [&](const Volume_survey& of_part) { survey.add(of_part); }});
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    const Traits part(parts[n], parameters, Volume_part{blocks[n], [&](Volume_survey& s) { s = survey; }});
    EXPECT_EQ(part.spline().border_degree(), whole.spline().border_degree()) << name;
    mesh.add(Level_set_traits_3(part, isovalue), blocks[n], known[n], selection);
  }
  mesh.sort();
  expected.sort();
  EXPECT_TRUE(mesh.vertices == expected.vertices) << name;
  EXPECT_TRUE(mesh.triangles == expected.triangles) << name;
}

TEST(Parts_of_volumes, have_the_mesh_and_the_attributes_of_the_whole_one) {
  const auto [x, y, z] = nodes;
  const std::array<std::vector<std::size_t>, 3> one_axis = {{{0, x - 1}, {0, y - 1}, {0, 12, z - 1}}},
                                                two_axes = {{{0, 3, 14, x - 1}, {0, 11, y - 1}, {0, z - 1}}};
  for (const int degree : {5, 7, 9})
    for (const auto scheme : {Spline_scheme::CONVOLUTION, Spline_scheme::QUASI_INTERPOLATION})
      expect_same({.spline_scheme = scheme, .spline_degree = degree}, degree == 7 ? one_axis : two_axes, "basic",
                  "degree " + std::to_string(degree) + ", scheme " + std::to_string(int(scheme)));
  expect_same({.spline_scheme = Spline_scheme::PAPER}, two_axes, "normal", "the paper's scheme");
  expect_same({.smoothing = 1.6}, two_axes, "all", "smoothed");
  expect_same({}, {{{0, x - 1}, {0, 3, y - 1}, {0, z - 1}}}, "signature", "norms of gradients");
}

TEST(Parts_of_volumes, have_values_where_all_samples_are_known_and_only_there) {
  const Samples samples(nodes);
  const Volume_options parameters = {.smoothing = 1.5};
  const Cell_block wanted = {{0, 9, 17}, {4, 14, nodes[2] - 1}};
  const auto part_of = [&](const Cell_block& cells) {
    return Traits(samples.part(cells), parameters,
                  Volume_part{wanted, [](Volume_survey& s) { s = {.greatest = 3, .border_votes = 1}; }});
  };
  const Cell_block known = cells_to_know(wanted, nodes, parameters);
  const Traits part = part_of(known);
  const auto value = [](const Traits& traits, double i, double j, double k) {
    const Point_3 p = traits.lattice().point(i, j, k);
    EXPECT_EQ(std::isnan(traits.value(p)), std::isnan(traits.restricted_to_cells({{0, 0, 0}, {9, 9, 9}}).value(p)));
    return traits.value(p);
  };
  EXPECT_TRUE(std::isfinite(value(part, 0.5, 9.5, 17.5)));
  EXPECT_TRUE(std::isfinite(value(part, 3.5, 13.5, 28.5)));
  EXPECT_TRUE(std::isnan(value(part, 3.5, 13.5, 1.5)));
  EXPECT_FALSE(part.bounds(part.lattice().bbox()).upper() < 10) << "nothing is known of the rest";
  for (std::size_t a = 0; a < 3; ++a) {
    Cell_block less = known;
    const bool is_at_end = less.first[a] == 0;
    if (is_at_end) --less.end[a];
    else ++less.first[a];
    std::array<double, 3> place = {0.5, 9.5, 17.5};
    if (is_at_end) place[a] = double(wanted.end[a]) - 0.5;
    EXPECT_TRUE(std::isnan(value(part_of(less), place[0], place[1], place[2]))) << "axis " << a;
  }
  EXPECT_THROW(part_of({{3, 3, 3}, {8, 8, 8}}), std::invalid_argument);
  EXPECT_THROW(Traits(samples.part(known), {.spline_scheme = Spline_scheme::INTERPOLATION}, Volume_part{wanted}),
               std::invalid_argument);
  EXPECT_EQ(error_field([&] { Traits(samples.part(known), {.smoothing = std::nullopt}, Volume_part{wanted}); }),
            "smoothing")
      << "the noise of all parts decides";
  EXPECT_THROW(samples.part({{0, 0, 0}, {1, 1, nodes[2]}}), std::invalid_argument);
}

/// Calls work(machine, gather) on so many machines at once, which are threads, where gather() waits for all of them.
template <class Work>
void on_machines(std::size_t count, const Work& work) {
  std::vector<std::vector<double>> told(count);
  std::barrier barrier(std::ptrdiff_t(count), [] {});
  std::vector<std::thread> machines;
  for (std::size_t n = 0; n < count; ++n)
    machines.emplace_back([&, n] {
      work(n, [&, n](std::vector<double> own) {
        told[n] = std::move(own);
        barrier.arrive_and_wait();
        std::vector<double> all;
        for (const std::vector<double>& numbers : told) all.insert(all.end(), numbers.begin(), numbers.end());
        barrier.arrive_and_wait(); // nobody tells anything new before all have read
        return all;
      });
    });
  for (std::thread& machine : machines) machine.join();
}

TEST(Parts_of_volumes, find_the_noise_and_the_smoothing_of_the_whole_one) {
  constexpr std::array<std::size_t, 3> size = {70, 67, 75};
  const std::vector<Cell_block> blocks = blocks_of(size, {{{0, 33, 69}, {0, 66}, {0, 1, 40, 74}}});
  struct Case {
    double deviation;
    std::optional<double> level;
    Spline_scheme scheme;
    bool has_integers = false; // and nodes without a value
  };
  for (const Case& given : {Case{0, 0.2, Spline_scheme::CONVOLUTION},
                            {1e-4, 77., Spline_scheme::QUASI_INTERPOLATION}, // is nowhere
                            {0.03, 0.2, Spline_scheme::QUASI_INTERPOLATION},
                            {0.03, 20., Spline_scheme::QUASI_INTERPOLATION, true}}) {
    Samples samples(size, given.deviation);
    for (std::size_t n = 0; given.has_integers && n < samples.values.size(); ++n)
      samples.values[n] =
          n % 200003 == 100000 ? std::numeric_limits<float>::quiet_NaN() : std::round(100 * samples.values[n]);
    const Volume_options options = {.spline_scheme = given.scheme, .level = given.level};
    const Sample_noise noise = estimate_noise(samples.whole(), given.level);
    const double smoothing = choose_smoothing(samples.whole(), noise, options);
    EXPECT_EQ(smoothing > 1, given.deviation > 0);
    constexpr std::size_t machines = 4; // of which the last one has no part
    std::array<Sample_noise, machines> noises;
    std::array<double, machines> smoothings;
    on_machines(machines, [&](std::size_t machine, const auto& gather) {
      Volume_parts_3<Kernel> volume{samples.lattice, {}, gather};
      const Volume_options greatest = {.smoothing = greatest_scale_to_choose, .spline_scheme = given.scheme};
      for (std::size_t n = machine; machine < machines - 1 && n < blocks.size(); n += machines - 1)
        volume.parts.push_back({samples.part(cells_to_know(blocks[n], size, greatest)), blocks[n]});
      noises[machine] = estimate_noise(volume, given.level);
      smoothings[machine] = choose_smoothing(volume, noises[machine], options);
    });
    for (std::size_t machine = 0; machine < machines; ++machine) {
      EXPECT_EQ(noises[machine].deviation, noise.deviation);
      EXPECT_EQ(noises[machine].quantum, noise.quantum);
      EXPECT_EQ(smoothings[machine], smoothing);
    }
  }
}

TEST(Parts_of_volumes, must_know_the_samples_with_which_noise_is_measured) {
  constexpr std::array<std::size_t, 3> size = {70, 67, 75};
  const Samples samples(size);
  const Cell_block cells = {{20, 0, 0}, {69, 66, 74}};
  const auto parts = [&](std::size_t margin) {
    return Volume_parts_3<Kernel>{samples.lattice, {{samples.part(widened(cells, margin, cells_of(size))), cells}}};
  };
  EXPECT_THROW(estimate_noise(parts(5)), std::invalid_argument);
  const Sample_noise noise = estimate_noise(parts(6));
  EXPECT_THROW(choose_smoothing(parts(6), noise, {.spline_scheme = Spline_scheme::INTERPOLATION}),
               std::invalid_argument);
}

} // namespace parts_of_volumes_test
