// SPDX-License-Identifier: GPL-3.0-or-later
#include "Measured_samples.h"

#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Volume_3.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace equiaffine {

namespace {

using Tag = CGAL::Parallel_if_available_tag;

/// Calls measure(volume) with the parts of the volume of this process.
template <class Measure>
void in_all_processes(const Views& views, const Image_pieces& pieces, const Ranks& ranks, const Measure& measure) {
  together(ranks, [&] {
    Volume_parts_3<Kernel> volume{
        *pieces.lattice, {}, [&](const std::vector<double>& numbers) { return ranks.gather(numbers); }};
    const bool is_measured_elsewhere = pieces.are_whole && ranks.number() > 0;
    for (std::size_t n = 0; n < views.size() && !is_measured_elsewhere; ++n)
      volume.parts.push_back({views[n], pieces.pieces[n].surveyed});
    measure(volume);
  });
}

} // namespace

Sample_noise measured_noise(const Views& views, const Image_pieces& pieces, double level, const Ranks& ranks) {
  Sample_noise noise{};
  in_all_processes(views, pieces, ranks, [&](const auto& volume) { noise = estimate_noise<Tag>(volume, level); });
  return noise;
}

double chosen_smoothing(const Views& views, const Image_pieces& pieces, const Sample_noise& noise,
                        const Volume_options& options, const Ranks& ranks) {
  double smoothing = 0;
  in_all_processes(views, pieces, ranks,
                   [&](const auto& volume) { smoothing = choose_smoothing<Tag>(volume, noise, options); });
  return smoothing;
}

std::optional<std::size_t> counted_values(const Views& views, const Image_pieces& pieces, const Ranks& ranks) {
  std::optional<std::size_t> count;
  in_all_processes(views, pieces, ranks, [&](const auto& volume) { count = number_of_few_values(volume); });
  return count;
}

bool are_whole(const Views& views, const Ranks& ranks) {
  std::array<std::int64_t, 2> counts = {std::int64_t(views.size()), 0}; // all views, and views of parts
  counts[1] = std::count_if(views.begin(), views.end(), [](const auto& view) { return view.is_part(); });
  ranks.sum(counts);
  return counts[0] > 0 && counts[1] == 0;
}

} // namespace equiaffine
