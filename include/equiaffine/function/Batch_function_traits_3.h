// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_BATCH_FUNCTION_TRAITS_3_H
#define EQUIAFFINE_FUNCTION_BATCH_FUNCTION_TRAITS_3_H

#include <equiaffine/function/capabilities.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <span>
#include <utility>

namespace equiaffine {

/// Makes any model of ImplicitFunctionTraits_3 a model of FirstOrderBatchImplicitFunctionTraits_3. It calls the batch
/// members of a base that has them and loops over single calls otherwise. All other members of the base stay available.
template <ImplicitFunctionTraits_3 Traits>
class Batch_function_traits_3 : public Traits {
public:
  using typename Traits::FT;      ///< the number type
  using typename Traits::Point_3; ///< points

  explicit Batch_function_traits_3(Traits traits) : Traits(std::move(traits)) {} ///< wraps a copy of the model

  /// values[i] = value(points[i]); the spans have the same size.
  void values(std::span<const Point_3> points, std::span<FT> values) const {
    CGAL_precondition(points.size() == values.size());
    if constexpr (BatchImplicitFunctionTraits_3<Traits>) Traits::values(points, values);
    else
      for (std::size_t i = 0; i < points.size(); ++i) values[i] = Traits::value(points[i]);
  }

  /// jets[i] = first_order(points[i]); the spans have the same size.
  void first_orders(std::span<const Point_3> points, std::span<Jet_3<FT, 1>> jets) const {
    CGAL_precondition(points.size() == jets.size());
    if constexpr (FirstOrderBatchImplicitFunctionTraits_3<Traits>) Traits::first_orders(points, jets);
    else
      for (std::size_t i = 0; i < points.size(); ++i)
        jets[i] = equiaffine::first_order(static_cast<const Traits&>(*this), points[i]);
  }

  /// jets[i] = taylor(points[i]); the spans have the same size.
  void taylors(std::span<const Point_3> points, std::span<Jet_3<FT>> jets) const {
    CGAL_precondition(points.size() == jets.size());
    if constexpr (BatchImplicitFunctionTraits_3<Traits>) Traits::taylors(points, jets);
    else
      for (std::size_t i = 0; i < points.size(); ++i) jets[i] = Traits::taylor(points[i]);
  }

  /// Wraps the model restricted to a block of cells.
  Batch_function_traits_3
  restricted_to_cells(const Cell_block& cells) const requires CellwiseImplicitFunctionTraits_3<Traits> {
    return Batch_function_traits_3(Traits::restricted_to_cells(cells));
  }
};

} // namespace equiaffine

#endif
