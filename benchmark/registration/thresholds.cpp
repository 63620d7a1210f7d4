// SPDX-License-Identifier: GPL-3.0-or-later
// The effect of each threshold of the search by affine frames: hard cases with one threshold halved or doubled.
#include "Disturbed_structure.h"
#include "runs.h"

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace registration_runs {
namespace {

using Thresholds = internal::Frame_thresholds;
using internal::Framed_function_3;

/// A surface with its frames and functions.
class Side {
public:
  Side(const Any_function_3& function, double part, unsigned seed, const Points& points)
      : disturbed_(std::make_unique<Disturbed_structure>(function, part, seed)),
        refined_(std::make_unique<Framed_function_3>(function)),
        surface_(
            internal::framed_surface(true, *disturbed_, *refined_, internal::vectors_of(points), Map_kind::AFFINE)) {}

  const internal::Framed_surface_3& surface() const { return surface_; }

private:
  std::unique_ptr<Disturbed_structure> disturbed_;
  std::unique_ptr<Framed_function_3> refined_;
  internal::Framed_surface_3 surface_;
};

struct Case {
  Side source, target;
  Map right;
};

/// Maps of condition 30, and maps of condition 10 with relative errors of 0.1 of the structure.
std::array<std::vector<Case>, 2> cases(const std::vector<Source>& sources, int repeats) {
  std::array<std::vector<Case>, 2> result;
  Random random(800);
  for (int r = 0; r < repeats; ++r)
    for (const Source& s : sources)
      for (const bool is_disturbed : {false, true}) {
        const Map map = random_map(random, is_disturbed ? 10 : 30, random_determinant(random));
        const Image image(s.function, map);
        const double part = is_disturbed ? 0.1 : 0;
        result[is_disturbed].push_back({Side(Any_function_3::make(s.function), part, 1, s.points),
                                        Side(Any_function_3::make(image), part, 2, points_on_surface(image, 35)), map});
      }
  return result;
}

void run(const std::string& name, const std::vector<Case>& cases, const Thresholds& thresholds) {
  double right = 0, hypotheses = 0;
  for (const Case& c : cases) {
    const auto result =
        internal::registration_of_framed(true, c.source.surface(), c.target.surface(), {}, {}, thresholds).result;
    right += result.found() && error_of(result.best().map, c.right) < 1e-6;
    hypotheses += double(result.hypotheses);
  }
  figure("registration_threshold_" + name + "_right", right / double(cases.size()), "of runs", "none");
  figure("registration_threshold_" + name + "_hypotheses", hypotheses / double(cases.size()), "per run", "none");
}

/// Runs with a number of the thresholds times a factor.
template <class Number>
void vary(const std::string& name, const std::array<std::vector<Case>, 2>& all, Number Thresholds::*member) {
  for (const auto& [word, factor] : {std::pair{"half", 0.5}, std::pair{"double", 2.}}) {
    Thresholds thresholds;
    thresholds.*member = Number(factor * double(thresholds.*member));
    run(name + "_" + word, all[0], thresholds);
    run(name + "_" + word + "_disturbed", all[1], thresholds);
  }
}

} // namespace

void vary_thresholds(const std::vector<Source>& sources, int repeats) {
  const auto all = cases(sources, repeats);
  run("none", all[0], {});
  run("none_disturbed", all[1], {});
  vary("greatest_quality", all, &Thresholds::greatest_quality);
  vary("least_rarity", all, &Thresholds::least_rarity);
  vary("loss_by_disagreement", all, &Thresholds::loss_by_disagreement);
  vary("loss_by_condition", all, &Thresholds::loss_by_condition);
  vary("cost_of_rest", all, &Thresholds::cost_of_rest);
  vary("cost_of_step", all, &Thresholds::cost_of_step);
  vary("longest_step", all, &Thresholds::longest_step);
  vary("accidental_residual", all, &Thresholds::accidental_residual);
  vary("accidental_mismatch", all, &Thresholds::accidental_mismatch);
  vary("longest_way", all, &Thresholds::longest_way);
  vary("points_per_batch", all, &Thresholds::points_per_batch);
  vary("probes_at_first", all, &Thresholds::probes_at_first);
  vary("greatest_first_tolerance", all, &Thresholds::greatest_first_tolerance);
  vary("first_log10", all, &Thresholds::first_log10);
  vary("second_log10", all, &Thresholds::second_log10);
  vary("accepted_log10", all, &Thresholds::accepted_log10);
}

} // namespace registration_runs
