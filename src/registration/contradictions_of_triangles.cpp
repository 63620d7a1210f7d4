// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/Centered_surface_3.h"
#include "registration/Piece_of_surface_3.h"
#include "registration/mesh_samples.h"
#include <equiaffine/registration/contradictions_of_meshes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace equiaffine::internal {

namespace {

/// The root mean square distance of the samples in contact.
double rms_of_contacts(const Mapped_samples& samples) {
  double sum = 0, count = 0;
  for (const auto& side : samples)
    for (const Mapped_sample& s : side)
      if (s.contact == Contact::TOUCHING) sum += (s.point - s.nearest).squaredNorm(), count += 1;
  return count > 0 ? std::sqrt(sum / count) : 0;
}

} // namespace

Mesh_contradictions contradictions_of_triangles(Triangles_3 source, Triangles_3 target, double distance) {
  Mesh_contradictions result;
  if (source.triangles.empty() || target.triangles.empty()) return result;
  const Moments_3 area = area_moments(target);
  if (!(area.measure > 0) || !(area_moments(source).measure > 0)) return result;
  const double rounding = coordinate_rounding(target.points); // the same for the source, which a map has moved
  result.are_exact_solids =
      has_group_of_corners(false, source, rounding) && has_group_of_corners(false, target, rounding);
  const Affine_map_3 map = centering_map(area);
  source = transformed(std::move(source), map);
  target = transformed(std::move(target), map);
  const auto edges = sorted_edges(target);
  const double error = std::max(facet_error(source, sorted_edges(source)).rms, facet_error(target, edges).rms);
  const double touching = std::max(distance / area.size(), tolerance_of_contact(error, {}));
  const double passing_by = greatest_displacement * std::min(1.0, area_moments(source).size());
  const Piece_of_surface_3 piece(target, edges, samples_of_piece, 2 * touching);
  std::size_t most = 0;
  for (const Triangles_3& side : {source, turned_inside_out(source)}) {
    const Piece_of_surface_3 moved(side, sorted_edges(side), samples_of_piece, 2 * touching);
    const Mapped_samples contacts = mapped_samples(moved, piece, {}, samples_of_piece, {touching, passing_by});
    const std::array touching_points = {count_of(contacts[0], Contact::TOUCHING),
                                        count_of(contacts[1], Contact::TOUCHING)};
    const std::size_t in_contact = touching_points[0] + touching_points[1];
    if (in_contact < most) continue;
    most = in_contact;
    for (std::size_t k = 0; k < 2; ++k) result.inliers[k] = double(touching_points[k]) / double(contacts[k].size());
    result.parts = contradictions_of(contacts);
    result.rms = area.size() * rms_of_contacts(contacts);
    result.are_closed = moved.is_closed() && piece.is_closed();
  }
  return result;
}

} // namespace equiaffine::internal
