// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates the noise of the samples of a volume, chooses how much to smooth them, and finds volumes whose samples are
// steps.
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

/// Errors of the samples of a volume, in the unit of the samples.
struct Sample_noise {
  double deviation; ///< standard deviation of the white noise in them, rounding to their type included
  double quantum;   ///< the step of their type: 1 for integers, for floats the step at the median size, else 0
};

/// How much the samples of a volume are smoothed, and what decides it.
struct Smoothing_decision {
  double smoothing = 0;                            ///< the scale, in voxels
  bool is_chosen = false;                          ///< by the noise, and not given by the options
  Sample_noise noise = {};                         ///< beside the level set, or everywhere
  std::optional<std::size_t> distinct_values = {}; ///< the number of those of the samples, if it is at most 256
};

namespace internal {

using Kernel_of_samples = CGAL::Simple_cartesian<double>;

/// The same parts of a volume in the kernel that the library is compiled for.
template <class Kernel>
decltype(auto) in_kernel_of_samples(const Volume_parts_3<Kernel>& volume) {
  static_assert(std::is_same_v<typename Kernel::FT, double>, "samples are measured as doubles: use a kernel of double");
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

// The library defines these functions. They run in the threads of TBB if `in_threads`.
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

/// Estimates the noise beside the level set f = level, or everywhere if there is none, from differences of order 12
/// along the axes, which are next to nothing for a smooth function: their median, in units of the median for white
/// noise of deviation 1. Details of the function with a wavelength of a few samples count as noise, too. Integers have
/// at least the noise of rounding, 1 / sqrt(12). For other samples the deviation is 0 if the volume has less than 13
/// nodes along an axis. The numbers of the kernel are doubles. Takes the time of some passes over the samples.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_view_3<Kernel>& volume, std::optional<double> level = std::nullopt) {
  return estimate_noise<ConcurrencyTag>(Volume_parts_3<Kernel>::of(volume), level);
}

/// The same for a volume in parts, of which samples are known up to 6 nodes beyond their cells. \throw
/// std::invalid_argument unless they are
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_parts_3<Kernel>& volume, std::optional<double> level = std::nullopt) {
  return internal::noise_of_samples(runs_in_threads<ConcurrencyTag>(), internal::in_kernel_of_samples(volume), level);
}

/// The same for a volume of numbers of the kernel. \throw std::invalid_argument unless there are as many values as
/// nodes
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_3<Kernel>& volume, std::optional<double> level = std::nullopt) {
  return estimate_noise<ConcurrencyTag>(Volume_view_3<Kernel>::of(volume), level);
}

/// The greatest scale that choose_smoothing() may choose.
inline constexpr double greatest_scale_to_choose = internal::scales_to_try.back();

/// The next smaller scale that choose_smoothing() may choose, at least 0.
inline double smaller_scale_to_choose(double scale) {
  const auto& scales = internal::scales_to_try;
  const auto found = std::lower_bound(scales.begin(), scales.end(), scale);
  return found == scales.begin() ? 0 : *(found - 1);
}

/// The scale for smooth_volume with the least estimated error of fourth derivatives, out of 0, 1.5, 2, 2.5, 3, 4, 5, 6
/// and 8, among those that leave the surface where it is.
///
/// The error of noise follows from its deviation. The error that smoothing makes is estimated by how far the
/// derivatives differ from those at the scale before, beyond their noise, in most of some hundred cells beside the
/// level set. A scale and all larger ones are left out if in more than a tenth of these cells the value changes by more
/// than hypot(2 s, g): s is the standard deviation of the change that noise explains (the discrepancy principle:
/// Morozov, On the solution of functional equations by the method of regularization, 1966), g the slope times a tenth
/// of a voxel, below which details are interpolated anyway. Fourth derivatives of a scan with details of a few voxels
/// are wrong at every scale, and the larger scales would smooth the details away.
///
/// Scales whose window does not fit into the volume are left out, and 0 is chosen where there is no spline. The
/// smoothing of the options is ignored. \throw Input_error for bad options
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
double choose_smoothing(const Volume_view_3<Kernel>& volume, const Sample_noise& noise,
                        const Volume_options& options = {}) {
  return choose_smoothing<ConcurrencyTag>(Volume_parts_3<Kernel>::of(volume), noise, options);
}

/// The same for a volume in parts, of which those samples are known that cells_to_know() names for a part's cells and
/// the greatest scale; for INTERPOLATION those for QUASI_INTERPOLATION. \throw std::invalid_argument unless they are
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
double choose_smoothing(const Volume_parts_3<Kernel>& volume, const Sample_noise& noise,
                        const Volume_options& options = {}) {
  options.check();
  return internal::smoothing_of_samples(runs_in_threads<ConcurrencyTag>(), internal::in_kernel_of_samples(volume),
                                        noise, options);
}

/// The same for a volume of numbers of the kernel. \throw std::invalid_argument unless there are as many values as
/// nodes
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
double choose_smoothing(const Volume_3<Kernel>& volume, const Sample_noise& noise, const Volume_options& options = {}) {
  return choose_smoothing<ConcurrencyTag>(Volume_view_3<Kernel>::of(volume), noise, options);
}

/// Returns the number of distinct values in up to 4096 rows of the samples, if it is 256 or less: then they are steps,
/// such as those of a mask, and curvatures without smoothing are those of the steps. It is the same however the volume
/// is cut.
template <class Kernel>
std::optional<std::size_t> number_of_few_values(const Volume_parts_3<Kernel>& volume) {
  return internal::few_values_of_samples(internal::in_kernel_of_samples(volume));
}

/// Finds the scale by which the samples of a volume are smoothed: that of the options, or without a value the one of
/// choose_smoothing(). Of a mask, whose samples are steps, a smaller one is chosen if less than nine tenths of the
/// rarer samples stay on their side of the level. Noise and distinct values are measured in any case.
/// \throw Input_error for bad options
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Smoothing_decision decide_smoothing(const Volume_view_3<Kernel>& volume, const Volume_options& options) {
  options.check();
  const auto parts = Volume_parts_3<Kernel>::of(volume);
  return internal::decided_smoothing(runs_in_threads<ConcurrencyTag>(),
                                     internal::in_kernel_of_samples(parts).parts.front().volume, options);
}

/// The same for a volume of numbers of the kernel. \throw std::invalid_argument unless there are as many values as
/// nodes
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Smoothing_decision decide_smoothing(const Volume_3<Kernel>& volume, const Volume_options& options) {
  return decide_smoothing<ConcurrencyTag>(Volume_view_3<Kernel>::of(volume), options);
}

namespace internal {

/// The options with a smoothing. \throw Input_error for bad options, and if there is no smoothing for a part of a
/// volume
template <class ConcurrencyTag, class Kernel>
Volume_options with_smoothing(const Volume_view_3<Kernel>& volume, const Volume_options& options) {
  options.check();
  Volume_options result = options;
  if (options.smoothing) return result;
  if (volume.is_part())
    throw Input_error::about("smoothing", "a part of a volume needs that of the whole; give what choose_smoothing() "
                                          "finds for all parts");
  if constexpr (std::is_same_v<typename Kernel::FT, double>)
    result.smoothing = decide_smoothing<ConcurrencyTag>(volume, options).smoothing;
  else throw Input_error::about("smoothing", "noise is measured as doubles; give a number, or use a kernel of double");
  return result;
}

} // namespace internal

} // namespace equiaffine

#endif
