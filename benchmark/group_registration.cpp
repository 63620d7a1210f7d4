// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of formulas: how often it is right, with how many hypotheses and how exactly, and how long the search
// takes once the points have their frames; symmetry groups; false maps. Argument: how often each row is repeated.
#include "measure.h"
#include "support/points_on_surface.h"
#include "support/registration_cases.h"
#include "support/registration_traits.h"
#include <equiaffine/affine_symmetries.h>
#include <equiaffine/register_surfaces.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace equiaffine;
using namespace registration_cases;
using Points = std::vector<Point_3>;

/// What came of the runs of a row.
class Row {
public:
  explicit Row(std::string name) : name_("registration_" + std::move(name)) {}

  /// Registers two surfaces, and compares the map with the right one.
  template <class Source, class Target>
  void run(const Source& source, const Points& points, const Target& target, const Points& target_points,
           const Map& right, internal::Registration_request request = {}) {
    const internal::Oracle_of_traits_3 from(source), to(target);
    using Tag = CGAL::Sequential_tag;
    const auto framed = internal::framed_surface<Tag>(from, from, internal::vectors_of(points), request.kind);
    const auto framed_target = internal::framed_surface<Tag>(to, to, internal::vectors_of(target_points), request.kind);
    const double begin = processor_clock();
    const auto result = internal::registration_of_framed<Tag, Kernel>(framed, framed_target, request).result;
    seconds_.push_back(processor_clock() - begin);
    const double error = result.found() ? error_of(result.best().map, right) : 1;
    found_ += result.found();
    if (!(error < 1e-6)) return;
    errors_.push_back(error);
    hypotheses_.push_back(double(result.hypotheses));
  }

  double found() const { return found_; }
  double runs() const { return double(seconds_.size()); }

  void report(const char* right) const {
    figure(name_ + "_runs", runs(), "runs", "none");
    figure(name_ + "_right", double(errors_.size()) / runs(), "of runs", right);
    figure(name_ + "_hypotheses_99_percent", quantile(hypotheses_, 0.99), "hypotheses", "<=2");
    figure(name_ + "_greatest_error", quantile(errors_, 1), "of A", "<=1e-12");
    figure(name_ + "_search", median(seconds_), "s", "<=0.05");
  }

  static double quantile(std::vector<double> values, double part) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[std::size_t(part * double(values.size() - 1))];
  }

private:
  std::string name_;
  std::vector<double> errors_, hypotheses_, seconds_;
  double found_ = 0;
};

struct Source {
  std::string name;
  Formula function;
  Points points;
};

std::vector<Source> sources() {
  std::vector<Source> result;
  for (const Surface& s : generic_surfaces()) {
    const Formula function = s.traits();
    result.push_back({s.name, function, points_on_surface(function, 32)});
  }
  return result;
}

double determinant(Random& random) { return std::exp(random.uniform(std::log(0.2), std::log(5))); }

void whole_surfaces(const std::vector<Source>& all, int repeats) {
  for (const double condition : {3., 10., 30.}) {
    Row row("condition_" + std::to_string(int(condition)));
    Random random(100);
    for (int r = 0; r < repeats; ++r)
      for (const Source& s : all) {
        const Map map = random_map(random, condition, determinant(random));
        const Image image(s.function, map);
        row.run(s.function, s.points, image, points_on_surface(image, 35), map);
      }
    row.report(">=0.999");
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
      rigid.run(s.function, s.points, turned, points_on_surface(turned, 35), turn, {.kind = Map_kind::RIGID});
      equiaffine.run(s.function, s.points, sheared, points_on_surface(sheared, 35), shear,
                     {.kind = Map_kind::EQUIAFFINE});
    }
  rigid.report(">=0.99");
  equiaffine.report(">=0.999");
}

/// Two pieces of which each has the given part in common with the other.
void overlaps(const std::vector<Source>& all, int repeats) {
  for (const double overlap : {0.5, 0.15, 0.08}) {
    Row row("overlap_" + std::to_string(int(100 * overlap + 0.5)) + "_percent");
    Random random(300);
    for (int r = 0; r < repeats; ++r)
      for (const Source& s : all) {
        const Eigen::Vector3d n = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
        std::vector<double> heights;
        for (const Point_3& p : s.points) heights.push_back(n.dot(Eigen::Vector3d(p.x(), p.y(), p.z())));
        const double part = 1 / (2 - overlap);
        const Piece<Formula> lower{s.function, n, Row::quantile(heights, part)};
        const Map map = random_map(random, 10, determinant(random));
        const Eigen::Vector3d m = matrix_of(map).inverse().transpose() * n;
        const double offset = m.dot(Eigen::Vector3d(map.m(0, 3), map.m(1, 3), map.m(2, 3)));
        const Image image(s.function, map);
        const Piece<Image> upper{image, -m, -offset - Row::quantile(heights, 1 - part)};
        row.run(lower, lower.points_of(s.points), upper, upper.points_of(points_on_surface(image, 45)), map,
                {.least_overlap = std::min(0.05, overlap / 4)});
      }
    row.report(overlap < 0.1 ? ">=0.95" : ">=1");
  }
}

void few_points(const std::vector<Source>& all, int repeats) {
  Row row("50_points");
  Random random(400);
  for (int r = 0; r < repeats; ++r)
    for (const Source& s : all) {
      const Map map = random_map(random, 10, determinant(random));
      const Image image(s.function, map);
      row.run(s.function, s.points, image, points_on_surface(image, 40, 50), map);
    }
  row.report(">=0.99");
}

void wrong_derivatives(const std::vector<Source>& all, int repeats) {
  for (const double part : {0.01, 0.03}) {
    Row row("derivatives_disturbed_by_" + std::to_string(int(100 * part)) + "_percent");
    Random random(500);
    for (int r = 0; r < repeats; ++r)
      for (const Source& s : all) {
        const Map map = random_map(random, 10, determinant(random));
        const Image image(s.function, map);
        const Disturbed<Formula> from{s.function, part, 0.05, 1};
        const Disturbed<Image> to{image, part, 0.05, 2};
        row.run(from, s.points, to, points_on_surface(image, 35), map);
      }
    row.report(">=1");
  }
}

void unrelated(const std::vector<Source>& all, int repeats) {
  Row row("unrelated");
  Random random(600);
  for (int r = 0; r < repeats; ++r)
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t other = (i + 1 + std::size_t(random.uniform(0, double(all.size()) - 1.01))) % all.size();
      const Map map = random_map(random, 5, determinant(random));
      const Image image(all[other].function, map);
      row.run(all[i].function, all[i].points, image, points_on_surface(image, 35), map);
    }
  figure("registration_unrelated_pairs", row.runs(), "pairs", "none");
  figure("registration_unrelated_false_maps", row.found(), "maps", "<=0");
}

struct Symmetric {
  const char *name, *formula;
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
    const Image image(function, random_map(random, 5, determinant(random)));
    const double begin = processor_clock();
    const bool is_right = affine_symmetries(function, points_on_surface(function, 40)).order() == s.order &&
                          affine_symmetries(image, points_on_surface(image, 40)).order() == s.order;
    const std::string name = std::string("symmetries_") + s.name;
    figure(name + "_right", is_right, "of 1", ">=1");
    figure(name + "_seconds", (processor_clock() - begin) / 2, "s", "none");
  }
}

} // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 84;
  const auto all = sources();
  whole_surfaces(all, repeats);
  kinds(all, (repeats + 3) / 4);
  overlaps(all, (repeats + 15) / 16);
  few_points(all, (repeats + 15) / 16);
  wrong_derivatives(all, (repeats + 15) / 16);
  unrelated(all, repeats);
  symmetries();
}
