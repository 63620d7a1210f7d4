// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/Affine_map_3.h"
#include "registration/Centered_map.h"
#include "registration/Centered_surface_3.h"
#include "registration/Framed_surface_3.h"
#include "registration/Symmetry_check.h"
#include "registration/mesh_samples.h"
#include "registration/register_pieces.h"
#include "registration/register_wholes.h"
#include "registration/registration_of_framed.h"
#include "registration/slippage.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/registration/Registration_options.h>
#include <equiaffine/registration/internal/Surface_to_register.h>
#include <equiaffine/registration/internal/searches.h>
#include <equiaffine/registration/is_affinely_equivalent.h>
#include <equiaffine/registration/register_surfaces.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace equiaffine::internal {

namespace {

/// The fewest points for which a surface is treated as a whole.
constexpr std::size_t fewest_points_of_whole = 16;

} // namespace

Registration_of_functions_3 registration_of_functions(bool in_threads, const Surface_to_register& source,
                                                      const Surface_to_register& target,
                                                      const Registration_options& options) {
  const auto points = vectors_of(source.mesh.points), target_points = vectors_of(target.mesh.points);
  check_argument(!points.empty(), "the source has no points: pass points of the surface to register");
  check_argument(!target_points.empty(), "the target has no points: pass points of the surface to register with");
  const Framed_function_3 function(source.function), target_function(target.function);
  const Framed_function_3 refinement(source.refined()), target_refinement(target.refined());
  const auto framed = framed_surface(in_threads, function, refinement, points, options.kind);
  const auto framed_target =
      framed_surface(in_threads, target_function, target_refinement, target_points, options.kind);
  Affine_slippage_3 slippage = slippage_of_source(framed, options.kind);
  if (slippage.dimension() > 0 && has_exact_frames(framed)) {
    constexpr double longest = 4; // relative to the tolerance, which is one of velocities
    const Symmetry_check check = Symmetry_check::of(in_threads, source.refined());
    const Checked_map moved = check.check_flows(in_threads, slippage.generators);
    if (moved.rms > longest * slippage_tolerance * check.size()) slippage = {};
  }
  auto registration = registration_of_framed(in_threads, framed, framed_target, options, std::move(slippage));
  const bool has_points = std::min(framed.probes.size(), framed_target.probes.size()) >= fewest_points_of_whole;
  const bool is_exact = has_exact_frames(framed) && has_exact_frames(framed_target);
  if (registration.result.found() || !has_points || !is_exact) return registration;
  auto wholes = registration_of_wholes(in_threads, centered_surface(in_threads, source.refined(), options.kind),
                                       centered_surface(in_threads, target.refined(), options.kind), options);
  registration.is_equivalence = wholes.found();
  const std::size_t hypotheses = registration.result.hypotheses + wholes.hypotheses;
  if (wholes.found()) registration.result = std::move(wholes);
  registration.result.hypotheses = hypotheses;
  return registration;
}

Surface_registration_3<Kernel_of_searches> registration_of_triangles(bool in_threads, const Triangles_3& source,
                                                                     const Triangles_3& target,
                                                                     const Registration_options& options) {
  check_argument(!source.triangles.empty(), "the source has no faces: pass the mesh to register");
  check_argument(!target.triangles.empty(), "the target has no faces: pass the mesh to register with");
  Centered_surface_3 from = centered_surface(source, options.kind), to = centered_surface(target, options.kind);
  // The facets of a solid with corners are its faces, so they do not explain any distance.
  const bool are_solids = has_group_of_corners(in_threads, source, coordinate_rounding(source.points)) &&
                          has_group_of_corners(in_threads, target, coordinate_rounding(target.points));
  if (are_solids) from.samples.facet_error = to.samples.facet_error = 0;
  Shape_matches wholes = register_wholes(in_threads, from, to, options);
  wholes.slippage = slippage_of_triangles(in_threads, source, options.kind);
  if (!wholes.maps.empty()) return to_CGAL(std::move(wholes), options);
  Shape_matches pieces = register_pieces(in_threads, source, target, options, are_solids);
  pieces.hypotheses += wholes.hypotheses;
  pieces.slippage = std::move(wholes.slippage);
  return to_CGAL(std::move(pieces), options);
}

bool differ_as_wholes(bool in_threads, const Any_function_3& source, const Any_function_3& target, Map_kind kind,
                      bool allows_reflections) {
  constexpr double difference = 0.03; // of equal surfaces, relative to the size
  const auto a = centered_surface(in_threads, source, kind), b = centered_surface(in_threads, target, kind);
  if (!a.reason_against.empty() || !b.reason_against.empty()) return false;
  const double ratio = std::cbrt(std::abs(a.map.matrix.determinant() / b.map.matrix.determinant()));
  if (keeps_volume(kind) && std::abs(std::log(ratio)) > difference) return true;
  return candidate_rotations(in_threads, a, b, difference, allows_reflections).rotations.empty();
}

} // namespace equiaffine::internal
