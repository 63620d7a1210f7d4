// SPDX-License-Identifier: GPL-3.0-or-later
// Marching Cubes, attributes and distances for formulas and splines with the vector instructions of the processor that
// runs the program, whatever flags it is compiled with. The code is in the compiled library.
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

/// An expression, under an affine map or without one.
using Formula = Transformed_function_traits_3<Analytic_function_traits_3<Kernel, Expression_3>>;
/// A spline through samples, under an affine map or without one.
using Spline = Transformed_function_traits_3<Sampled_function_traits_3<Kernel>>;

/// Vector instructions for which the library is compiled. Numbers are the same for all of them, bit for bit, if the
/// library is compiled with -ffp-contract=off, the default of its own builds.
enum class Instruction_set {
  BASELINE, ///< what the flags of the library's build allow
  AVX2,     ///< AVX2 and FMA
  AVX512    ///< AVX-512 F, BW, DQ and VL
};

} // namespace equiaffine::vectorized

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::vectorized {

/// Returns the instruction sets that the library is compiled for and this processor has, the narrowest first. Beyond
/// BASELINE there are some on x86-64 under Linux.
std::vector<Instruction_set> instruction_sets();

/// Meshes a level set as equiaffine::marching_cubes() does. It works in threads if the library is compiled with TBB,
/// and evaluates f as often as that function does.
///
/// \code{.cpp}
/// using namespace equiaffine;
/// const vectorized::Formula f(make_analytic_traits<vectorized::Kernel>(Expression_3("x^4 + y^4 + z^4 - 1"), box));
/// const auto surface = vectorized::marching_cubes(Level_set_traits_3(f, 0.0), {.resolution = 128});
/// \endcode
///
/// \throw Input_error for bad options, and std::invalid_argument if `set` is not in instruction_sets()
Isosurface_3<Kernel> marching_cubes(const Level_set_traits_3<Formula>& level_set,
                                    const Marching_cubes_options& options = {},
                                    Instruction_set set = instruction_sets().back());
/// The same for a spline, on the lattice of its samples.
Isosurface_3<Kernel> marching_cubes(const Level_set_traits_3<Spline>& level_set,
                                    const Marching_cubes_options& options = {},
                                    Instruction_set set = instruction_sets().back());

/// Computes the selected attributes of points as equiaffine::compute_attributes() does, by the same number of
/// expansions, in threads if the library is compiled with TBB. `sampled` is what that function takes.
/// \throw std::invalid_argument if it has another number of statuses or areas, or `set` is not in instruction_sets()
Vertex_attributes compute_attributes(const Level_set_traits_3<Formula>& level_set,
                                     std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                                     const Sampled_vertices& sampled = {},
                                     Instruction_set set = instruction_sets().back());
/// The same for a spline.
Vertex_attributes compute_attributes(const Level_set_traits_3<Spline>& level_set,
                                     std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                                     const Sampled_vertices& sampled = {},
                                     Instruction_set set = instruction_sets().back());

/// The greatest distance of points from a level set, to first order, as equiaffine::max_distance_to_surface() computes
/// it, by the same number of evaluations, in threads if the library is compiled with TBB.
/// \throw std::invalid_argument if there are statuses, but not one per point, or `set` is not in instruction_sets()
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
