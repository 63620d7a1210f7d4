// SPDX-License-Identifier: GPL-3.0-or-later
// Tells which points of two pieces of surfaces are in contact, and which contradict a map between them.
#ifndef EQUIAFFINE_SRC_REGISTRATION_CONTACTS_H
#define EQUIAFFINE_SRC_REGISTRATION_CONTACTS_H

#include "registration/Affine_map_3.h"
#include "registration/Piece_of_surface_3.h"
#include <equiaffine/base/internal/parallel_for.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// Whether a point of one piece speaks for a map, or against it.
enum class Contact {
  NONE,         ///< nothing, since the other piece may end there
  TOUCHING,     ///< the point is on the other surface
  CONTRADICTING ///< the other surface passes by the point
};

/// The distances below which points touch, and below which a surface that passes by is the same one, displaced.
struct Contact_distances {
  double touching, passing_by;
};

/// A surface that passes by at less than this, beside the size of the smaller piece, is the same one.
constexpr double greatest_displacement = 0.1;

/// A point of one piece, with its normal, in the coordinates of the other one. A solid has another sheet between two
/// with the same side, which is beyond the pieces if the two are as far apart as these are large, and two that are near
/// each other have opposite sides.
inline Contact contact_of(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, const Point_of_piece& nearest,
                          bool is_other_closed, const Contact_distances& distances) {
  constexpr double similar = 0.7, parallel = 0.85, opposite = -0.5;
  const Eigen::Vector3d way = p - nearest.point;
  const double distance = way.norm(), cosine = normal.dot(nearest.normal);
  if (distance <= distances.touching) return cosine > similar ? Contact::TOUCHING : Contact::NONE;
  if (is_other_closed) return Contact::CONTRADICTING;
  if (nearest.is_on_border) return Contact::NONE;
  if (distance < distances.passing_by && cosine > opposite) return Contact::CONTRADICTING;
  if (distance > distances.passing_by / greatest_displacement) return Contact::NONE;
  const bool is_across = std::abs(way.dot(nearest.normal)) > parallel * distance;
  return is_across && cosine > parallel ? Contact::CONTRADICTING : Contact::NONE;
}

/// A sample of one of two pieces that a map brings together, in the coordinates of the target.
struct Mapped_sample {
  Eigen::Vector3d point;
  Eigen::Vector3d nearest, normal; ///< of the other surface
  Contact contact;
};

/// The samples of the source and those of the target.
using Mapped_samples = std::array<std::vector<Mapped_sample>, 2>;

/// A similarity, with its inverse and its scale.
struct Similarity_3 {
  Affine_map_3 map, inverse;
  double scale;

  explicit Similarity_3(const Affine_map_3& m)
      : map(m), inverse(m.inverse()), scale(std::cbrt(std::abs(m.matrix.determinant()))) {}
};

/// Brings the first `count` samples of both pieces together.
inline Mapped_samples mapped_samples(const Piece_of_surface_3& source, const Piece_of_surface_3& target,
                                     const Affine_map_3& map, std::size_t count, const Contact_distances& distances) {
  const Similarity_3 s(map);
  Mapped_samples result;
  const auto& a = source.samples();
  for (std::size_t i = 0; i < std::min(count, a.points.size()); ++i) {
    const Eigen::Vector3d p = map(a.points[i]);
    const Point_of_piece q = target.nearest(p, distances.touching);
    const Contact contact = contact_of(p, s.map.matrix * a.normals[i] / s.scale, q, target.is_closed(), distances);
    result[0].push_back({p, q.point, q.normal, contact});
  }
  const auto& b = target.samples();
  const Contact_distances at_source = {distances.touching / s.scale, distances.passing_by / s.scale};
  for (std::size_t i = 0; i < std::min(count, b.points.size()); ++i) {
    const Eigen::Vector3d p = s.inverse(b.points[i]);
    const Point_of_piece q = source.nearest(p, at_source.touching);
    const Eigen::Vector3d normal = s.inverse.matrix * b.normals[i] * s.scale;
    const Contact contact = contact_of(p, normal, q, source.is_closed(), at_source);
    result[1].push_back({b.points[i], map(q.point), s.map.matrix * q.normal / s.scale, contact});
  }
  return result;
}

inline std::size_t count_of(const std::vector<Mapped_sample>& samples, Contact contact) {
  return std::size_t(std::count_if(samples.begin(), samples.end(),
                                   [=](const Mapped_sample& sample) { return sample.contact == contact; }));
}

/// The nearest points of a piece from the cells of a cube around the origin: fast, and good to about a cell.
class Nearest_of_cells {
public:
  static Nearest_of_cells of(bool in_threads, const Piece_of_surface_3& piece) {
    Nearest_of_cells result(1.1 * piece.samples().radius());
    parallel_for(in_threads, 0, cells * cells, [&](std::size_t row) {
      for (std::size_t i = 0; i < cells; ++i) {
        const Eigen::Vector3d center(double(i) + 0.5, double(row % cells) + 0.5, double(row / cells) + 0.5);
        const auto [point, normal, is_on_border] =
            piece.nearest(center / result.scale_ - Eigen::Vector3d::Constant(result.radius_), 0);
        result.points_[row * cells + i] = {point.cast<float>(), normal.cast<float>(), is_on_border};
      }
    });
    return result;
  }

  Point_of_piece operator()(const Eigen::Vector3d& p) const {
    std::size_t cell = 0;
    for (int a = 2; a >= 0; --a)
      cell = cells * cell + std::size_t(std::clamp((p[a] + radius_) * scale_, 0.0, double(cells) - 0.5));
    const auto& [point, normal, is_on_border] = points_[cell];
    return {point.cast<double>(), normal.cast<double>(), is_on_border};
  }

private:
  static constexpr std::size_t cells = 44;
  struct Point {
    Eigen::Vector3f point, normal;
    bool is_on_border;
  };

  explicit Nearest_of_cells(double radius)
      : radius_(radius), scale_(double(cells) / (2 * radius)), points_(cells * cells * cells) {}

  double radius_, scale_;
  std::vector<Point> points_;
};

} // namespace equiaffine::internal

#endif
