// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates the noise of the samples of a volume, chooses how much to smooth them, and detects masks.
#ifndef EQUIAFFINE_VOLUME_SAMPLE_NOISE_H
#define EQUIAFFINE_VOLUME_SAMPLE_NOISE_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_options.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>

namespace equiaffine {

/// Errors of the samples of a volume, in the units of the samples.
struct Sample_noise {
  double deviation; ///< standard deviation of their white noise, including rounding to their type
  double quantum;   ///< resolution of their type: 1 for integers, the spacing at the median for floats, else 0
};

/// The smoothing of the samples of a volume, and the measurements behind the choice.
struct Smoothing_decision {
  double smoothing = 0;                            ///< the scale, in voxels
  bool is_chosen = false;                          ///< chosen from the noise, not given by the options
  Sample_noise noise = {};                         ///< near the level set, or everywhere
  std::optional<std::size_t> distinct_values = {}; ///< the number of distinct sample values if it is at most 256
};

namespace internal {

using Kernel_of_samples = CGAL::Simple_cartesian<double>;

/// The same parts of a volume in the kernel for which the library is compiled.
template <class Kernel>
decltype(auto) in_kernel_of_samples(const Volume_parts_3<Kernel>& volume) {
  static_assert(std::is_same_v<typename Kernel::FT, double>, "noise is estimated in double: use a kernel of double");
  if constexpr (std::is_same_v<Kernel, Kernel_of_samples>) {
    return (volume);
  } else {
    Volume_parts_3<Kernel_of_samples> result = {Lattice_3<Kernel_of_samples>(volume.lattice), {}, volume.gather};
    for (const auto& [part, cells] : volume.parts)
      result.parts.push_back({Volume_view_3<Kernel_of_samples>(part), cells});
    return result;
  }
}

inline constexpr std::array<double, 8> scales_to_try = {1.5, 2, 2.5, 3, 4, 5, 6, 8};

// These functions are compiled into the library. They run on the threads of TBB if `in_threads` is true.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

Sample_noise noise_of_samples(bool in_threads, const Volume_parts_3<Kernel_of_samples>& volume,
                              std::optional<double> level);

double smoothing_of_samples(bool in_threads, const Volume_parts_3<Kernel_of_samples>& volume, const Sample_noise& noise,
                            const Volume_options& options);

std::optional<std::size_t> few_values_of_samples(const Volume_parts_3<Kernel_of_samples>& volume);

Smoothing_decision decided_smoothing(bool in_threads, const Volume_view_3<Kernel_of_samples>& volume,
                                     const Volume_options& options);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

} // namespace internal

/// Estimates the noise near the level set f = level, or everywhere without a level, from differences of order 12
/// along the axes, which are almost 0 for a smooth function. The result is their median, scaled to be 1 for white
/// noise of deviation 1. Details of the function with a wavelength of a few samples count as noise. Integers have at
/// least the rounding noise 1 / sqrt(12). For other samples the deviation is 0 if the volume has fewer than 13 nodes
/// along an axis. The number type of the kernel must be double. Takes the time of a few passes over the samples.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_view_3<Kernel>& volume, std::optional<double> level = std::nullopt) {
  return estimate_noise<ConcurrencyTag>(Volume_parts_3<Kernel>::of(volume), level);
}

/// The same for a volume in parts, whose samples must be known up to 6 nodes beyond their cells. \throw
/// std::invalid_argument unless they are
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_parts_3<Kernel>& volume, std::optional<double> level = std::nullopt) {
  return internal::noise_of_samples(runs_in_threads<ConcurrencyTag>(), internal::in_kernel_of_samples(volume), level);
}

/// The same for a volume with numbers of the kernel. \throw std::invalid_argument unless there is one value per node
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_3<Kernel>& volume, std::optional<double> level = std::nullopt) {
  return estimate_noise<ConcurrencyTag>(Volume_view_3<Kernel>::of(volume), level);
}

/// The largest scale that choose_smoothing() may choose.
inline constexpr double greatest_scale_to_choose = internal::scales_to_try.back();

/// The next smaller scale that choose_smoothing() may choose; 0 if there is none.
inline double smaller_scale_to_choose(double scale) {
  const auto& scales = internal::scales_to_try;
  const auto found = std::lower_bound(scales.begin(), scales.end(), scale);
  return found == scales.begin() ? 0 : *(found - 1);
}

/// Returns the scale for smooth_volume() that minimizes the estimated error of fourth derivatives, among 0, 1.5, 2,
/// 2.5, 3, 4, 5, 6, and 8, without moving the surface.
///
/// The error due to noise follows from its deviation. The error due to smoothing is estimated from the change of the
/// derivatives since the previous scale, beyond their noise, in most of a few hundred cells near the level set. A
/// scale and all larger ones are excluded if the value changes by more than hypot(2 s, g) in more than a tenth of
/// these cells. Here s is the standard deviation of the change that noise explains (the discrepancy principle:
/// Morozov, On the solution of functional equations by the method of regularization, 1966), and g is the slope times
/// a tenth of a voxel; smaller details are interpolated anyway. Without this rule, a scan with details of a few
/// voxels, whose fourth derivatives are wrong at every scale, would lose these details to a large scale.
///
/// Scales whose window does not fit into the volume are excluded. Returns 0 if the volume is too small for a spline.
/// Ignores the smoothing of the options. \throw Input_error for bad options
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
double choose_smoothing(const Volume_view_3<Kernel>& volume, const Sample_noise& noise,
                        const Volume_options& options = {}) {
  return choose_smoothing<ConcurrencyTag>(Volume_parts_3<Kernel>::of(volume), noise, options);
}

/// The same for a volume in parts. For each part, the samples that cells_to_know() returns for its cells and the
/// largest scale must be known; for INTERPOLATION, those for QUASI_INTERPOLATION. \throw std::invalid_argument unless
/// they are
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
double choose_smoothing(const Volume_parts_3<Kernel>& volume, const Sample_noise& noise,
                        const Volume_options& options = {}) {
  options.check();
  return internal::smoothing_of_samples(runs_in_threads<ConcurrencyTag>(), internal::in_kernel_of_samples(volume),
                                        noise, options);
}

/// The same for a volume with numbers of the kernel. \throw std::invalid_argument unless there is one value per node
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
double choose_smoothing(const Volume_3<Kernel>& volume, const Sample_noise& noise, const Volume_options& options = {}) {
  return choose_smoothing<ConcurrencyTag>(Volume_view_3<Kernel>::of(volume), noise, options);
}

/// Returns the number of distinct values in up to 4096 rows of the samples if it is at most 256. Such samples are
/// steps, for example of a mask, and without smoothing the curvatures are those of the steps. The result does not
/// depend on the partition of the volume.
template <class Kernel>
std::optional<std::size_t> number_of_few_values(const Volume_parts_3<Kernel>& volume) {
  return internal::few_values_of_samples(internal::in_kernel_of_samples(volume));
}

/// Returns the scale by which the samples of a volume are smoothed: the value in the options, or else the result of
/// choose_smoothing(). For a mask, whose samples are steps, it chooses a smaller scale if fewer than nine tenths of
/// the rarer samples stay on their side of the level. Always measures the noise and the number of distinct values.
/// \throw Input_error for bad options
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Smoothing_decision decide_smoothing(const Volume_view_3<Kernel>& volume, const Volume_options& options) {
  options.check();
  const auto parts = Volume_parts_3<Kernel>::of(volume);
  return internal::decided_smoothing(runs_in_threads<ConcurrencyTag>(),
                                     internal::in_kernel_of_samples(parts).parts.front().volume, options);
}

/// The same for a volume with numbers of the kernel. \throw std::invalid_argument unless there is one value per node
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Smoothing_decision decide_smoothing(const Volume_3<Kernel>& volume, const Volume_options& options) {
  return decide_smoothing<ConcurrencyTag>(Volume_view_3<Kernel>::of(volume), options);
}

namespace internal {

/// The options with a value for the smoothing. \throw Input_error for bad options, and if none can be chosen because
/// only a part of the volume is known
template <class ConcurrencyTag, class Kernel>
Volume_options with_smoothing(const Volume_view_3<Kernel>& volume, const Volume_options& options) {
  options.check();
  Volume_options result = options;
  if (options.smoothing) return result;
  if (volume.is_part())
    throw Input_error::about("smoothing", "cannot be chosen from a part of a volume; give the value that "
                                          "choose_smoothing() returns for all parts");
  if constexpr (std::is_same_v<typename Kernel::FT, double>)
    result.smoothing = decide_smoothing<ConcurrencyTag>(volume, options).smoothing;
  else throw Input_error::about("smoothing", "can only be chosen in double; give a number, or use a kernel of double");
  return result;
}

} // namespace internal

} // namespace equiaffine

#endif
