// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of sources: formulas, splines and fits.
#ifndef EQUIAFFINE_PROGRAM_SOURCE_SOURCE_FUNCTION_H
#define EQUIAFFINE_PROGRAM_SOURCE_SOURCE_FUNCTION_H

#include "request/source_options.h"
#include "system/kernel.h"
#include <equiaffine/fit/Close_sheets.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>

#include <CGAL/Bbox_3.h>

#include <memory>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

namespace equiaffine {

template <class>
class Fitted_function_traits_3;

/// A Fitted_function_traits_3 whose members are compiled once, to keep its header out of most translation units. Copies
/// share the fit.
class Fit_traits {
public:
  using FT = double;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;
  using Fit = Fitted_function_traits_3<Kernel>;

  explicit Fit_traits(Fit fit);

  double value(const Point_3& p) const;
  Jet_3<double, 1> first_order(const Point_3& p) const;
  Jet_3<double> taylor(const Point_3& p) const;
  Interval bounds(const CGAL::Bbox_3& box) const;
  double rounding(const Point_3& p) const;
  double certainty(const Point_3& p) const;
  CGAL::Bbox_3 bbox() const;

  Fit_traits in_box(const CGAL::Bbox_3& box) const;
  Fit_traits in_band(double height) const;
  Fitted_structure_3<double> structure(const Point_3& p) const;
  std::optional<double> scale() const;
  double spacing(const Point_3& p) const;
  Close_sheets close_sheets(double longest_step) const;
  CGAL::Bbox_3 band_box() const;

  const Fit& fit() const { return *fit_; }

private:
  std::shared_ptr<const Fit> fit_;
};

/// Fits polynomials to the vertices of a mesh or to points in parallel, and returns the structures there. The columns
/// nx, ny, nz of points without faces are their normals if none of them is zero.
std::vector<Fitted_structure_3<double>> fit_vertices(const Annotated_mesh_3<Kernel>& mesh, const Fit_options& options,
                                                     Orientation_of_level_set orientation);

/// The fraction of points whose normal, from the columns nx, ny, nz, is opposite to that of the nearest other point; 0
/// without normals or with faces.
double part_with_opposed_normals(const Annotated_mesh_3<Kernel>& mesh);

/// Fits polynomials to the vertices of a mesh or to points in parallel, and blends them into one function.
Fit_traits blend_vertices(const Annotated_mesh_3<Kernel>& mesh, const Fit_options& options);

using Formula_traits = Analytic_function_traits_3<Kernel, Expression_3>;
using Spline_traits = Sampled_function_traits_3<Kernel>;

/// A source under the map of its `transformation`, by default the identity.
using Formula_function = Transformed_function_traits_3<Formula_traits>;
using Spline_function = Transformed_function_traits_3<Spline_traits>;
using Fit_function = Transformed_function_traits_3<Fit_traits>;

/// SOURCE of the command line as a function.
using Source_function = std::variant<Formula_function, Spline_function, Fit_function>;

/// Whether a model of Source_function is a fit.
template <class Traits>
inline constexpr bool is_fit = std::is_same_v<Traits, Fit_function>;

/// The function whose zero set is a level set, type-erased: for code whose compile time matters more than its speed.
Any_function_3 any_level_set(const Source_function& function, double isovalue,
                             Orientation_of_level_set orientation = Orientation_of_level_set::ALONG_GRADIENT);

} // namespace equiaffine

#endif
