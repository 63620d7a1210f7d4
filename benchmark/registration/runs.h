// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of register_surfaces with a known map, and their results.
#ifndef EQUIAFFINE_BENCHMARK_REGISTRATION_RUNS_H
#define EQUIAFFINE_BENCHMARK_REGISTRATION_RUNS_H

#include "../measure.h"
#include "registration/registration_of_framed.h"
#include "support/points_on_surface.h"
#include "support/registration_cases.h"
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/registration/register_surfaces.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace registration_runs {

using namespace equiaffine;
using namespace registration_cases;
using Points = std::vector<Point_3>;

inline double lower_quantile(std::vector<double> values, double part) {
  const double last = double(values.size()) - 1;
  return values.empty() ? 0 : nth_smallest(std::move(values), std::size_t(part * last));
}

/// The targets of a row of runs.
struct Targets {
  const char *right = ">=1", *median_error = "none", *greatest_error = "<=1e-12", *hypotheses = "none",
             *search = "none", *median_hypotheses = "none";
};

/// The results of a row of runs. A run is right if the error of the matrix is at most `greatest_error`.
class Row {
public:
  using Framed_function_3 = internal::Framed_function_3;

  explicit Row(const std::string& name, double greatest_error = 1e-6)
      : name_("registration_" + name), greatest_error_(greatest_error) {}

  /// Registers two surfaces, and compares the map with the correct one.
  template <class Source, class Target>
  void run(const Source& source, const Points& points, const Target& target, const Points& target_points,
           const Map& right, const Registration_options& options = {}) {
    run(source, source, points, target, target, target_points, right, options);
  }

  /// The same, with different functions for the refinement.
  template <ImplicitFunctionTraits_3 Source, class Refined_source, class Target, class Refined_target>
  void run(const Source& source, const Refined_source& refined_source, const Points& points, const Target& target,
           const Refined_target& refined_target, const Points& target_points, const Map& right,
           const Registration_options& options = {}) {
    const auto framed = [](const auto& traits) { return Framed_function_3(Any_function_3::make(traits)); };
    run(framed(source), framed(refined_source), points, framed(target), framed(refined_target), target_points, right,
        options);
  }

  void run(const Framed_function_3& source, const Framed_function_3& refined_source, const Points& points,
           const Framed_function_3& target, const Framed_function_3& refined_target, const Points& target_points,
           const Map& right, const Registration_options& options = {}) {
    const auto framed =
        internal::framed_surface(false, source, refined_source, internal::vectors_of(points), options.kind);
    const auto framed_target =
        internal::framed_surface(false, target, refined_target, internal::vectors_of(target_points), options.kind);
    const double begin = processor_clock();
    const auto slippage = internal::slippage_of_source(framed, options.kind);
    const auto result = internal::registration_of_framed(false, framed, framed_target, options, slippage).result;
    seconds_.push_back(processor_clock() - begin);
    found_ += result.found();
    const double error = result.found() ? error_of(result.best().map, right) : 1;
    if (!(error <= greatest_error_)) return;
    errors_.push_back(error);
    hypotheses_.push_back(double(result.hypotheses));
  }

  double found() const { return found_; }
  double runs() const { return double(seconds_.size()); }

  void report(const Targets& targets) const {
    figure(name_ + "_runs", runs(), "runs", "none");
    figure(name_ + "_right", double(errors_.size()) / runs(), "of runs", targets.right);
    figure(name_ + "_hypotheses_99_percent", lower_quantile(hypotheses_, 0.99), "hypotheses", targets.hypotheses);
    figure(name_ + "_hypotheses_median", lower_quantile(hypotheses_, 0.5), "hypotheses", targets.median_hypotheses);
    figure(name_ + "_median_error", lower_quantile(errors_, 0.5), "of A", targets.median_error);
    figure(name_ + "_greatest_error", lower_quantile(errors_, 1), "of A", targets.greatest_error);
    figure(name_ + "_search", median(seconds_), "s", targets.search);
  }

private:
  std::string name_;
  double greatest_error_;
  std::vector<double> errors_, hypotheses_, seconds_;
  double found_ = 0;
};

struct Source {
  std::string name;
  Formula function;
  Points points;
};

inline double random_determinant(Random& random) { return std::exp(random.uniform(std::log(0.2), std::log(5))); }

void register_meshes(int repeats);
void register_bunny(const std::string& folder);
void register_volumes(int repeats);
void compare_with_peers(int repeats);
void vary_thresholds(const std::vector<Source>& sources, int repeats);

} // namespace registration_runs

#endif
