// SPDX-License-Identifier: GPL-3.0-or-later
// Registration: success rate, number of hypotheses, accuracy, and time of the search given the frames of the points;
// symmetry groups and slippage; false maps.
// Usage: benchmark_registration [repeats] [part] [folder of data], where part is all, formulas, symmetries, unrelated,
// volumes, meshes, bunny, peers or thresholds; or `surfaces`, which only writes the twelve formulas with their boxes.
// 84 repeats are the full size: 3000 runs with formulas.
#include "registration/Disturbed_structure.h"
#include "registration/runs.h"
#include "support/registration_traits.h"
#include <equiaffine/registration/affine_symmetries.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace registration_runs;

constexpr Targets formulas = {.right = ">=0.999", .hypotheses = "<=2", .search = "<=0.05"};

std::vector<Source> sources() {
  std::vector<Source> result;
  for (const Surface& s : generic_surfaces()) {
    const Formula function = s.traits();
    result.push_back({s.name, function, points_on_surface(function, 32)});
  }
  return result;
}

void whole_surfaces(const std::vector<Source>& all, int repeats) {
  for (const double condition : {3., 10., 30.}) {
    Row row("condition_" + std::to_string(int(condition)));
    Random random(100);
    for (int r = 0; r < repeats; ++r)
      for (const Source& s : all) {
        const Map map = random_map(random, condition, random_determinant(random));
        const Image image(s.function, map);
        row.run(s.function, s.points, image, points_on_surface(image, 35), map);
      }
    row.report(formulas);
  }
}

void kinds(const std::vector<Source>& all, int repeats) {
  Row rigid("rigid"), equiaffine("equiaffine");
  Random random(200);
  for (int r = 0; r < repeats; ++r)
    for (const Source& s : all) {
      const double sign = random.uniform(0, 1) < 0.5 ? -1 : 1;
      const Map turn = map_of(sign * random_rotation(random), Eigen::Vector3d(1, 2, 3));
      const Map shear = random_map(random, 10, 1);
      const Image turned(s.function, turn), sheared(s.function, shear);
      rigid.run(s.function, s.points, turned, points_on_surface(turned, 35), turn, {{.kind = Map_kind::RIGID}});
      equiaffine.run(s.function, s.points, sheared, points_on_surface(sheared, 35), shear,
                     {{.kind = Map_kind::EQUIAFFINE}});
    }
  rigid.report({.right = ">=0.99"});
  equiaffine.report({.right = ">=0.99"});
}

std::string percent(double part) { return std::to_string(int(100 * part + 0.5)) + "_percent"; }

/// Two pieces, each of which shares the given fraction with the other.
void overlaps(const std::vector<Source>& all, int repeats) {
  for (const double overlap : {0.5, 0.15, 0.08}) {
    Row row("overlap_" + percent(overlap));
    Random random(300);
    for (int r = 0; r < repeats; ++r)
      for (const Source& s : all) {
        const Eigen::Vector3d n = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
        std::vector<double> heights;
        for (const Point_3& p : s.points) heights.push_back(n.dot(Eigen::Vector3d(p.x(), p.y(), p.z())));
        const double part = 1 / (2 - overlap);
        const Piece<Formula> lower{s.function, n, lower_quantile(heights, part)};
        const Map map = random_map(random, 10, random_determinant(random));
        const Eigen::Vector3d m = matrix_of(map).inverse().transpose() * n;
        const double offset = m.dot(Eigen::Vector3d(map.m(0, 3), map.m(1, 3), map.m(2, 3)));
        const Image image(s.function, map);
        const Piece<Image> upper{image, -m, -offset - lower_quantile(heights, 1 - part)};
        row.run(lower, lower.points_of(s.points), upper, upper.points_of(points_on_surface(image, 45)), map,
                {{}, 1, std::min(0.05, overlap / 4)});
      }
    row.report({.right = overlap < 0.1 ? ">=0.95" : ">=1", .median_hypotheses = "<=20"});
  }
}

void few_points(const std::vector<Source>& all, int repeats) {
  Row row("50_points");
  Random random(400);
  for (int r = 0; r < repeats; ++r)
    for (const Source& s : all) {
      const Map map = random_map(random, 10, random_determinant(random));
      const Image image(s.function, map);
      row.run(s.function, s.points, image, points_on_surface(image, 40, 50), map);
    }
  row.report({.right = ">=0.99"});
}

/// Relative errors of the structure, or of each derivative of orders 2 to 4, which cause much larger errors of the
/// structure.
void wrong_structure(const std::vector<Source>& all, int repeats) {
  for (const double part : {0.01, 0.03, 0.1}) {
    Row structure("structure_disturbed_by_" + percent(part)), derivatives("derivatives_disturbed_by_" + percent(part));
    Random random(500);
    for (int r = 0; r < repeats; ++r)
      for (const Source& s : all) {
        const Map map = random_map(random, 10, random_determinant(random));
        const Image image(s.function, map);
        const Points target_points = points_on_surface(image, 35);
        const auto source = Any_function_3::make(s.function), target = Any_function_3::make(image);
        using internal::Framed_function_3;
        structure.run(Disturbed_structure(source, part, 1), Framed_function_3(source), s.points,
                      Disturbed_structure(target, part, 2), Framed_function_3(target), target_points, map);
        const Disturbed<Formula> from{s.function, part, 0.05, 1};
        const Disturbed<Image> to{image, part, 0.05, 2};
        derivatives.run(from, s.points, to, target_points, map);
      }
    structure.report({});
    derivatives.report({.right = "none"});
  }
}

/// An image of a surface among six other surfaces, which have nine tenths of the points.
void clutter(const std::vector<Source>& all, int repeats) {
  Row row("share_of_10_percent");
  Random random(450);
  for (int r = 0; r < repeats; ++r)
    for (std::size_t i = 0; i < all.size(); ++i) {
      Scene<Image> scene;
      Points points;
      Map right(CGAL::IDENTITY);
      for (std::size_t k = 0; k < 7; ++k) {
        const Formula& function = all[(i + k) % all.size()].function;
        const Map map = random_map(random, 5, random_determinant(random));
        const CGAL::Bbox_3 box = Image(function, map).bbox();
        const double right_end = scene.objects.empty() ? 0 : scene.objects.back().bbox().xmax() + 0.1;
        const Map placed = Map(CGAL::TRANSLATION, Kernel::Vector_3(right_end - box.xmin(), 0, 0)) * map;
        if (k == 0) right = placed;
        scene.objects.emplace_back(function, placed);
        const Points some = points_on_surface(scene.objects.back(), 35, k == 0 ? 500 : 750);
        points.insert(points.end(), some.begin(), some.end());
      }
      row.run(all[i].function, all[i].points, scene, points, right);
    }
  row.report({});
}

/// A surface of one of four families, with random coefficients.
Surface random_surface(unsigned seed) {
  const std::string waves_of_it = waves(seed, 5, 0.15);
  switch (seed % 4) {
  case 0: return {"", blobs(seed, 3 + int(seed / 4 % 6), 0.33, 0.7), cube(1.8)};
  case 1: return {"", "x^2+2*y^2+3*z^2-1" + waves_of_it, cube(1.6)};
  case 2: return {"", "(x^2+y^2+z^2+.84)^2-4*(x^2+y^2)" + waves_of_it, cube(1.8)};
  default: return {"", "x^4+y^4+z^4-1" + waves(seed, 8, 0.2, 1.5), cube(1.6)};
  }
}

void unrelated(int pairs) {
  Row row("unrelated");
  for (int n = 0; n < pairs; ++n) {
    const Formula one = random_surface(unsigned(2 * n)).traits(), other = random_surface(unsigned(2 * n + 1)).traits();
    row.run(one, points_on_surface(one, 24), other, points_on_surface(other, 24), Map(CGAL::IDENTITY));
  }
  figure("registration_unrelated_pairs", row.runs(), "pairs", "none");
  figure("registration_unrelated_false_maps", row.found(), "maps", "<=0");
}

struct Symmetric {
  std::string name, formula;
  CGAL::Bbox_3 box;
  std::size_t order;
};

void symmetries() {
  const std::vector<Symmetric> surfaces = {
      {"blobby", "x^4+y^4+z^4-1", cube(1.3), 48},
      {"tanglecube", "x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8", cube(3), 48},
      {"affine_cube", "x^6+2*y^6+.5*z^6-1", cube(1.3), 48},
      {"sextic", "x^6+1.5*y^6+.7*z^6+.8*x^2*y^2-1", cube(1.3), 16},
      {"genus_2", "(x^2*(1-x^2)-y^2)^2+.5*z^2-.03", CGAL::Bbox_3(-1.4, -1, -.6, 1.4, 1, .6), 8},
      {"tetrahedral", "x^4+y^4+z^4+1.2*x*y*z-1", cube(1.6), 24},
      {"icosahedral",
       "x^2+y^2+z^2-1+.35*(2.618033988749895*x^2-y^2)*(2.618033988749895*y^2-z^2)*(2.618033988749895*z^2-x^2)",
       cube(1.6), 120}};
  Random random(700);
  for (const Symmetric& s : surfaces) {
    const Formula function(Expression_3(s.formula), s.box);
    const Image image(function, random_map(random, 5, random_determinant(random)));
    const double begin = processor_clock();
    double right = 0;
    for (const std::size_t nodes : {30, 36, 40, 46})
      right += (affine_symmetries(function, points_on_surface(function, nodes)).order() == s.order) +
               (affine_symmetries(image, points_on_surface(image, nodes)).order() == s.order);
    const std::string name = "symmetries_" + s.name;
    figure(name + "_right", right, "of 8", ">=8");
    figure(name + "_seconds", (processor_clock() - begin) / 8, "s", "none");
  }
}

struct Slipping {
  std::string name, formula;
  CGAL::Bbox_3 box;
  std::size_t dimension;
};

void slippage() {
  const std::vector<Slipping> surfaces = {{"ellipsoid", "x^2+2*y^2+3*z^2-1", cube(1.3), 3},
                                          {"hyperboloid", "x^2+2*y^2-z^2-.5", cube(1.2), 3},
                                          {"paraboloid", "z-x^2-y^2/2", CGAL::Bbox_3(-1, -1, -.5, 1, 1, 1), 4},
                                          {"torus", "(x^2+y^2+z^2+.84)^2-4*(x^2+y^2)", cube(1.6), 1},
                                          {"xyz", "x*y*z-1", CGAL::Bbox_3(.3, .3, .3, 3, 3, 3), 2},
                                          {"Cayley", "z-x*y+x^3/3", cube(1.1), 3},
                                          {"helicoid", "x*sin(z)-y*cos(z)", cube(1.4), 2},
                                          {"generic", generic_surfaces()[0].formula, cube(1.8), 0}};
  Random random(750);
  for (const Slipping& s : surfaces) {
    const Formula function(Expression_3(s.formula), s.box);
    const Image image(function, random_map(random, 5, random_determinant(random)));
    const double right =
        (affine_symmetries(function, points_on_surface(function, 24)).continuous.dimension() == s.dimension) +
        (affine_symmetries(image, points_on_surface(image, 24)).continuous.dimension() == s.dimension);
    figure("slippage_" + s.name + "_right", right, "of 2", ">=2");
  }
}

} // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 84;
  const std::string part = argc > 2 ? argv[2] : "all";
  if (part == "surfaces")
    for (const Surface& s : generic_surfaces()) {
      for (int k = 0; k < 3; ++k) std::cout << s.box.min(k) << '\t' << s.box.max(k) << '\t';
      std::cout << s.formula << '\n';
    }
  const auto is_asked_for = [&](const char* name) { return part == "all" || part == name; };
  if (is_asked_for("symmetries")) {
    symmetries();
    slippage();
  }
  if (is_asked_for("formulas")) {
    const auto all = sources();
    const int fewer = (repeats + 15) / 16;
    whole_surfaces(all, repeats);
    kinds(all, (repeats + 3) / 4);
    overlaps(all, fewer);
    clutter(all, fewer);
    few_points(all, fewer);
    wrong_structure(all, fewer);
  }
  if (is_asked_for("thresholds")) vary_thresholds(sources(), (repeats + 41) / 42);
  if (is_asked_for("unrelated")) unrelated(12 * repeats);
  const int fewest = (repeats + 41) / 42;
  if (is_asked_for("volumes")) register_volumes((3 * fewest + 1) / 2);
  if (is_asked_for("meshes")) register_meshes(fewest);
  if (is_asked_for("peers")) compare_with_peers(fewest);
  if (is_asked_for("bunny")) register_bunny(argc > 3 ? argv[3] : "build/data");
}
