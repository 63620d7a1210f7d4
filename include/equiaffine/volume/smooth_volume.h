// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SMOOTH_VOLUME_H
#define EQUIAFFINE_VOLUME_SMOOTH_VOLUME_H

#include <equiaffine/volume/Spline_parameters.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_survey.h>
#include <equiaffine/volume/Volume_view_3.h>
#include <equiaffine/volume/internal/border_degree.h>
#include <equiaffine/volume/internal/smoothed_samples.h>

#include <CGAL/tags.h>

#include <utility>

namespace equiaffine {

/// Returns a volume with less noise: along each axis every sample is replaced by the value of the polynomial of degree
/// 7 that fits its neighbors by least squares. Neighbors are weighted by a bell with the standard deviation `scale` >=
/// 0, in steps of the lattice, that ends at 3.3 times this (Savitzky, Golay 1964 with other weights). Smooth functions
/// change by O(h^8), since polynomials of degree 7 do not change, at the border too. A scale of 1 or less changes
/// nothing. White noise in fourth derivatives falls as scale^-5.5. A node whose window has a sample that is not finite
/// gets one that is not finite.
///
/// The samples go on beyond the border as constants if most lines of the volume end in steps, as those of a mask do:
/// polynomials through steps would move the surface between them.
///
/// \throw std::invalid_argument unless the scale is finite and not negative, and there are as many values as nodes
///
/// Takes 20 scale operations per node. The result does not depend on the number of threads.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Volume_3<Kernel> smooth_volume(Volume_3<Kernel> volume, const typename Kernel::FT& scale) {
  const auto view = Volume_view_3<Kernel>::of(volume);
  if (!internal::smooths(scale)) return volume;
  const Spline_parameters spline;
  const int border_degree =
      internal::elected_border_degree(internal::border_votes(view, spline, view.cells()), spline.degree);
  volume.values = internal::smoothed_samples<ConcurrencyTag>(view, scale, border_degree);
  return volume;
}

/// The same for samples of any type: the result has numbers of the kernel, or is the volume itself. Of a part of a volume
/// the nodes are kept whose windows are in it, and the votes of the ends of lines of all parts decide how samples go on
/// beyond the border (Volume_survey.h). \throw std::invalid_argument if there are no such nodes
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Volume_view_3<Kernel> smooth_volume(const Volume_view_3<Kernel>& volume, const typename Kernel::FT& scale,
                                    const Border_votes& votes) {
  if (!internal::smooths(scale)) return volume;
  const int border_degree = internal::elected_border_degree(votes, Spline_parameters().degree);
  if (volume.is_part()) return internal::smoothed_part<ConcurrencyTag>(volume, scale, border_degree);
  return Volume_3<Kernel>{volume.lattice(), internal::smoothed_samples<ConcurrencyTag>(volume, scale, border_degree)};
}

/// The same with the votes of the ends of lines that are known.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Volume_view_3<Kernel> smooth_volume(const Volume_view_3<Kernel>& volume, const typename Kernel::FT& scale) {
  if (!internal::smooths(scale)) return volume;
  return smooth_volume<ConcurrencyTag>(volume, scale,
                                       internal::border_votes(volume, Spline_parameters(), volume.cells()));
}

} // namespace equiaffine

#endif
