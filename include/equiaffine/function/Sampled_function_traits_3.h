// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_SAMPLED_FUNCTION_TRAITS_3_H
#define EQUIAFFINE_FUNCTION_SAMPLED_FUNCTION_TRAITS_3_H

#include <equiaffine/function/concepts.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Spline_function_3.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_survey.h>
#include <equiaffine/volume/internal/spline_errors.h>
#include <equiaffine/volume/smooth_volume.h>

#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace equiaffine {

/// A volume as a function: the tensor product spline through its samples gives values and expansions, and the samples
/// give the signs at nodes. The convolution scheme smooths, so that the spline's value at a node differs from the
/// sample there.
///
/// A spline of degree n needs n + 1 nodes along each axis: 8 for the default degree 7, and 6 for degree 5. With fewer
/// nodes there is no spline: values off the nodes are NaN, points are OUTSIDE, and vertices of Marching Cubes stay at
/// their linear positions, UNCONVERGED.
///
/// Models CellwiseImplicitFunctionTraits_3, FirstOrderImplicitFunctionTraits_3 and
/// FirstOrderBoundedImplicitFunctionTraits_3. Marching Cubes and attributes need memory for the samples, in their own
/// type, and for one block of cells per thread. Other algorithms need one more number per node (Spline_function_3).
/// Copies share the immutable data.
template <class Kernel>
class Sampled_function_traits_3 {
public:
  using FT = typename Kernel::FT;             ///< the number type of the kernel
  using Point_3 = typename Kernel::Point_3;   ///< points of the kernel
  using Vector_3 = typename Kernel::Vector_3; ///< vectors of the kernel

  /// Creates the spline with the given options. If they include smoothing, `sample` returns smoothed samples. A
  /// Volume_3 is copied or moved; a view of samples of any type is not copied. \throw Input_error if options are
  /// invalid
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Sampled_function_traits_3(const Volume_view_3<Kernel>& volume, const Volume_options& options = {},
                                     ConcurrencyTag tag = {})
      : Sampled_function_traits_3(volume, options, Volume_part{volume.cells()}, tag) {}

  /// Creates the same function, bit for bit, from a part of a volume, in the cells for which all needed samples are
  /// known (see cells_to_know()). \throw Input_error if options are invalid. \throw std::invalid_argument if there are
  /// no such cells, or for interpolation, which needs all samples
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  Sampled_function_traits_3(const Volume_view_3<Kernel>& volume, const Volume_options& options, const Volume_part& part,
                            ConcurrencyTag tag = {})
      : volume_(volume) {
    const FT smoothing = FT(*internal::with_smoothing<ConcurrencyTag>(volume, options).smoothing);
    Volume_survey survey = internal::volume_survey<ConcurrencyTag>(volume, options, part.cells);
    part.reduce(survey);
    volume_ = smooth_volume<ConcurrencyTag>(volume, smoothing, survey.border_votes);
    spline_ = std::make_shared<const Spline_function_3<Kernel>>(volume_, options, survey, tag);
    rounding_ = std::make_shared<const Spline_rounding_3<Kernel>>(*spline_, smoothing, survey);
  }

  /// The value of the spline. Outside its support, values and coefficients of expansions are NaN.
  FT value(const Point_3& p) const { return spline_->value(p); }
  /// Value and gradient of the spline.
  Jet_3<FT, 1> first_order(const Point_3& p) const { return spline_->template taylor<1>(p); }
  Jet_3<FT> taylor(const Point_3& p) const { return spline_->taylor(p); } ///< the expansion of the spline
  /// The expansion of order 5. It jumps between cells if the degree is 5.
  Jet_3<FT, 5> fifth_order(const Point_3& p) const { return spline_->template taylor<5>(p); }
  Interval bounds(const CGAL::Bbox_3& box) const { return spline_->bounds(box); } ///< see Spline_function_3::bounds()
  /// See Spline_function_3::first_order_bounds().
  Jet_3<Interval, 1> first_order_bounds(const CGAL::Bbox_3& box) const { return spline_->first_order_bounds(box); }
  /// The largest change of second derivatives at p by rounding. If all samples are floats, it includes the rounding of
  /// the samples around p to float. It is 0 outside the support of the spline.
  FT rounding(const Point_3& p) const {
    const auto cell = spline_->cell_of(p);
    return cell ? (*rounding_)(*spline_, *cell) : FT(0);
  }
  CGAL::Bbox_3 bbox() const { return lattice().bbox(); } ///< the box of the lattice

  const Lattice_3<Kernel>& lattice() const { return volume_.lattice(); } ///< the lattice of the samples

  /// The sample at node (i, j, k).
  FT sample(std::size_t i, std::size_t j, std::size_t k) const { return volume_(i, j, k); }
  /// The samples of the block of `size` nodes that starts at node `first`, i fastest.
  void samples(const std::array<std::size_t, 3>& first, const std::array<std::size_t, 3>& size,
               std::span<FT> out) const {
    volume_.copy_block(first, size, out);
  }

  /// The cell of the lattice that contains p, if p is in the support of the spline.
  std::optional<std::array<std::size_t, 3>> cell_of(const Point_3& p) const { return spline_->cell_of(p); }
  /// The same function, with less memory if it is only evaluated in these cells; see
  /// Spline_function_3::restricted_to_cells().
  Sampled_function_traits_3 restricted_to_cells(const Cell_block& cells) const {
    Sampled_function_traits_3 result = *this;
    result.spline_ = std::make_shared<const Spline_function_3<Kernel>>(spline_->restricted_to_cells(cells));
    return result;
  }

  const Spline_function_3<Kernel>& spline() const { return *spline_; } ///< the spline through the samples

private:
  Volume_view_3<Kernel> volume_;
  std::shared_ptr<const Spline_function_3<Kernel>> spline_;
  std::shared_ptr<const Spline_rounding_3<Kernel>> rounding_;
};

static_assert(FirstOrderBoundedImplicitFunctionTraits_3<Sampled_function_traits_3<CGAL::Simple_cartesian<double>>>);
static_assert(FirstOrderImplicitFunctionTraits_3<Sampled_function_traits_3<CGAL::Simple_cartesian<double>>>);
static_assert(CellwiseImplicitFunctionTraits_3<Sampled_function_traits_3<CGAL::Simple_cartesian<double>>>);

/// The kernel is that of the volume.
template <class Kernel>
Sampled_function_traits_3(Volume_3<Kernel>, const Volume_options& = {}) -> Sampled_function_traits_3<Kernel>;

/// The kernel is that of the volume.
template <class Kernel, class ConcurrencyTag>
Sampled_function_traits_3(Volume_3<Kernel>, const Volume_options&, ConcurrencyTag) -> Sampled_function_traits_3<Kernel>;

} // namespace equiaffine

#endif
