// SPDX-License-Identifier: GPL-3.0-or-later
// Marching Cubes, attributes and distances for formulas and splines, with the vector instructions of the processor at
// run time, independent of the flags of the calling program.
#ifndef EQUIAFFINE_ENGINE_VECTORIZED_H
#define EQUIAFFINE_ENGINE_VECTORIZED_H

#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/marching_cubes/Marching_cubes_options.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Simple_cartesian.h>

#include <span>
#include <vector>

namespace equiaffine::vectorized {

using Kernel = CGAL::Simple_cartesian<double>; ///< the kernel of the functions

/// An expression, optionally under an affine map.
using Formula = Transformed_function_traits_3<Analytic_function_traits_3<Kernel, Expression_3>>;
/// A spline through samples, optionally under an affine map.
using Spline = Transformed_function_traits_3<Sampled_function_traits_3<Kernel>>;

/// The instruction sets for which the library is compiled. Results are bitwise equal for all of them if the library is
/// compiled with -ffp-contract=off, the default of its own builds.
enum class Instruction_set {
  BASELINE, ///< determined by the flags of the library's build
  AVX2,     ///< AVX2 and FMA
  AVX512    ///< AVX-512 F, BW, DQ and VL
};

} // namespace equiaffine::vectorized

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::vectorized {

/// Returns the instruction sets that both the library's build and this processor support, narrowest first. BASELINE is
/// the only one except on x86-64 Linux.
std::vector<Instruction_set> instruction_sets();

/// Meshes a level set like equiaffine::marching_cubes(), with the same number of evaluations of f. Multithreaded if the
/// library is compiled with TBB.
///
/// \code{.cpp}
/// using namespace equiaffine;
/// const vectorized::Formula f(make_analytic_traits<vectorized::Kernel>(Expression_3("x^4 + y^4 + z^4 - 1"), box));
/// const auto surface = vectorized::marching_cubes(Level_set_traits_3(f, 0.0), {.resolution = 128});
/// \endcode
///
/// \throw Input_error if options are invalid
/// \throw std::invalid_argument if `set` is not in instruction_sets()
Isosurface_3<Kernel> marching_cubes(const Level_set_traits_3<Formula>& level_set,
                                    const Marching_cubes_options& options = {},
                                    Instruction_set set = instruction_sets().back());
/// The same for a spline, on the lattice of its samples.
Isosurface_3<Kernel> marching_cubes(const Level_set_traits_3<Spline>& level_set,
                                    const Marching_cubes_options& options = {},
                                    Instruction_set set = instruction_sets().back());

/// Computes the selected attributes of points like equiaffine::compute_attributes(), with the same number of expansions
/// and the same meaning of `sampled`. Multithreaded if the library is compiled with TBB.
/// \throw std::invalid_argument if the number of statuses or areas is wrong, or `set` is not in instruction_sets()
Vertex_attributes compute_attributes(const Level_set_traits_3<Formula>& level_set,
                                     std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                                     const Sampled_vertices& sampled = {},
                                     Instruction_set set = instruction_sets().back());
/// The same for a spline.
Vertex_attributes compute_attributes(const Level_set_traits_3<Spline>& level_set,
                                     std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                                     const Sampled_vertices& sampled = {},
                                     Instruction_set set = instruction_sets().back());

/// The maximal distance of points from a level set, to first order, like equiaffine::max_distance_to_surface(), with
/// the same number of evaluations. Multithreaded if the library is compiled with TBB.
/// \throw std::invalid_argument if there are statuses but not one per point, or `set` is not in instruction_sets()
double max_distance_to_surface(const Level_set_traits_3<Formula>& level_set, std::span<const Kernel::Point_3> points,
                               std::span<const Point_status> status = {},
                               Instruction_set set = instruction_sets().back());
/// The same for a spline.
double max_distance_to_surface(const Level_set_traits_3<Spline>& level_set, std::span<const Kernel::Point_3> points,
                               std::span<const Point_status> status = {},
                               Instruction_set set = instruction_sets().back());

} // namespace equiaffine::vectorized
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
