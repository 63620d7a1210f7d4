// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates the noise of the samples of a volume, and the scale by which to smooth them.
#ifndef EQUIAFFINE_VOLUME_SAMPLE_NOISE_H
#define EQUIAFFINE_VOLUME_SAMPLE_NOISE_H

#include <equiaffine/volume/Spline_parameters.h>
#include <equiaffine/volume/Spline_scheme.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_parts_3.h>
#include <equiaffine/volume/Volume_view_3.h>
#include <equiaffine/volume/cells_to_know.h>
#include <equiaffine/volume/internal/Smoothing_trial.h>
#include <equiaffine/volume/internal/border_degree.h>
#include <equiaffine/volume/internal/noise_measurement.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace equiaffine {

/// Errors of the samples of a volume, in the unit of the samples.
struct Sample_noise {
  double deviation; ///< standard deviation of the white noise in them, rounding to their type included
  double quantum;   ///< the step of their type: 1 for integers, for floats the step at the median size, else 0
};

/// The greatest scale that choose_smoothing() may choose.
inline constexpr double greatest_scale_to_choose = internal::scales_to_try.back();

/// The next smaller scale that choose_smoothing() may choose, at least 0.
inline double smaller_scale_to_choose(double scale) {
  const auto& scales = internal::scales_to_try;
  const auto found = std::lower_bound(scales.begin(), scales.end(), scale);
  return found == scales.begin() ? 0 : *(found - 1);
}

/// Estimates the noise beside the level set f = isovalue, or everywhere if there is none, from differences of order 12
/// along the axes, which are next to nothing for a smooth function: their median, in units of the median for white
/// noise of deviation 1. Details of the function with a wavelength of a few samples count as noise, too. Integers have
/// at least the noise of rounding, 1 / sqrt(12). For other samples the deviation is 0 if the volume has less than 13
/// nodes along an axis. Takes the time of some passes over the samples.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_view_3<Kernel>& volume,
                            std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  return estimate_noise<ConcurrencyTag>(Volume_parts_3<Kernel>::of(volume), isovalue);
}

/// The same for a volume in parts, of which samples are known up to 6 nodes beyond their cells. \throw
/// std::invalid_argument unless they are
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_parts_3<Kernel>& volume,
                            std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  constexpr std::size_t reach = 6;
  for (const auto& [part, cells] : volume.parts)
    internal::check_known_cells(part, widened(cells, reach, cells_of(volume.lattice.size())));
  const double deviation = internal::white_noise_deviation(
      volume, internal::nodes_to_measure<ConcurrencyTag>(volume, isovalue, reach, 40000));
  const double quantum = internal::quantum_of(volume);
  return {std::max(deviation, quantum == 1 ? 1 / std::sqrt(12.0) : 0), quantum};
}

/// The same for a volume of numbers of the kernel. \throw std::invalid_argument unless there are as many values as nodes
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_3<Kernel>& volume,
                            std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  return estimate_noise<ConcurrencyTag>(Volume_view_3<Kernel>::of(volume), isovalue);
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
/// Scales whose window does not fit into the volume are left out, and 0 is chosen where there is no spline.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
typename Kernel::FT choose_smoothing(const Volume_view_3<Kernel>& volume, const Sample_noise& noise, int degree,
                                     Spline_scheme scheme, std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  return choose_smoothing<ConcurrencyTag>(Volume_parts_3<Kernel>::of(volume), noise, degree, scheme, isovalue);
}

/// The same for a volume in parts, of which those samples are known that cells_to_know() names for a part's cells and the
/// greatest scale; for INTERPOLATION those for QUASI_INTERPOLATION. \throw std::invalid_argument unless they are
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
typename Kernel::FT choose_smoothing(const Volume_parts_3<Kernel>& volume, const Sample_noise& noise, int degree,
                                     Spline_scheme scheme, std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  if (scheme == Spline_scheme::INTERPOLATION) scheme = Spline_scheme::QUASI_INTERPOLATION; // the same but for its reach
  const auto& size = volume.lattice.size();
  if (*std::min_element(size.begin(), size.end()) <= std::size_t(degree)) return 0;
  const Spline_parameters greatest = {.degree = degree, .scheme = scheme, .smoothing = greatest_scale_to_choose};
  for (const auto& [part, cells] : volume.parts)
    internal::check_known_cells(part, cells_to_know(cells, size, greatest));
  const internal::Smoothing_test_site<Kernel> site(
      volume, internal::nodes_to_measure<ConcurrencyTag>(volume, isovalue, 1, 300), noise.deviation);
  if (site.cells().empty()) return 0;
  const int border_degree = internal::border_degree(volume, degree, scheme);
  return internal::least_risky_scale(site, {degree, scheme, border_degree, 0});
}

/// The same for a volume of numbers of the kernel. \throw std::invalid_argument unless there are as many values as nodes
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
typename Kernel::FT choose_smoothing(const Volume_3<Kernel>& volume, const Sample_noise& noise, int degree,
                                     Spline_scheme scheme, std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  return choose_smoothing<ConcurrencyTag>(Volume_view_3<Kernel>::of(volume), noise, degree, scheme, isovalue);
}

} // namespace equiaffine

#endif
