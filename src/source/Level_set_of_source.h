// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SOURCE_LEVEL_SET_OF_SOURCE_H
#define EQUIAFFINE_SRC_SOURCE_LEVEL_SET_OF_SOURCE_H

#include "source/source_function.h"
#include <equiaffine/Level_set_traits_3.h>
#include <equiaffine/concepts.h>
#include <equiaffine/registration/certainty_of_fit.h>

#include <CGAL/Aff_transformation_3.h>

#include <optional>
#include <utility>
#include <variant>

namespace equiaffine {

/// A level set of a source, whatever the source is made of: a model of FirstOrderImplicitFunctionTraits_3, so that what
/// takes two sources is compiled once, not for each pair of models.
class Level_set_of_source {
public:
  using FT = double;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;

  /// `map` is the one that --transform gives, which the function has gone through already.
  Level_set_of_source(Source_function function, double isovalue,
                      const std::optional<CGAL::Aff_transformation_3<Kernel>>& map = {})
      : function_(std::visit([&](auto&& f) -> Function { return Level_set_traits_3(std::move(f), isovalue); },
                             std::move(function))) {
    if (map) to_data_ = map->inverse();
  }

  double value(const Point_3& p) const {
    return std::visit([&](const auto& f) { return f.value(p); }, function_);
  }
  Jet_3<double, 1> first_order(const Point_3& p) const {
    return std::visit([&](const auto& f) { return f.first_order(p); }, function_);
  }
  Jet_3<double> taylor(const Point_3& p) const {
    return std::visit([&](const auto& f) { return f.taylor(p); }, function_);
  }
  /// How far affine curvatures can be trusted, from 0 to 1: those of fits have estimated errors, whose parts of the
  /// curvatures affine maps keep.
  double certainty(const Point_3& p) const {
    return std::visit(
        [&]<class Traits>(const Level_set_traits_3<Traits>& f) -> double {
          if constexpr (is_fit<Traits>)
            return certainty_of_fit(fit_of(f.base()).structure(to_data_ ? (*to_data_)(p) : p));
          else return 1;
        },
        function_);
  }
  CGAL::Bbox_3 bbox() const {
    return std::visit([&](const auto& f) { return f.bbox(); }, function_);
  }

  /// Calls `visitor` with the Level_set_traits_3 of the source's own model.
  template <class Visitor>
  decltype(auto) visit(const Visitor& visitor) const {
    return std::visit(visitor, function_);
  }

private:
  template <class>
  struct Level_sets_of;
  template <class... Traits>
  struct Level_sets_of<std::variant<Traits...>> {
    using type = std::variant<Level_set_traits_3<Traits>...>;
  };
  using Function = Level_sets_of<Source_function>::type;

  Function function_;
  std::optional<CGAL::Aff_transformation_3<Kernel>> to_data_; ///< back from the image of a source that was transformed
};

} // namespace equiaffine

#endif
