// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of surfaces given as meshes, and the evidence of their contact for or against a map.
#ifndef EQUIAFFINE_SRC_REGISTRATION_PIECE_OF_SURFACE_3_H
#define EQUIAFFINE_SRC_REGISTRATION_PIECE_OF_SURFACE_3_H

#include "registration/Affine_map_3.h"
#include "registration/map_evidence.h"
#include "registration/mesh_samples.h"
#include "registration/refine_map.h"
#include <equiaffine/base/internal/parallel_for.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The point of a piece nearest to another point.
struct Point_of_piece {
  Eigen::Vector3d point, normal;
  bool is_on_border; ///< the surface may continue there
};

/// The number of samples used to judge a map between pieces.
constexpr std::size_t samples_of_piece = 4000;

/// A mesh as a part of the boundary of a solid, which continues beyond the border of the mesh.
class Piece_of_surface_3 {
public:
  /// `edges` are sorted. Points within `border_width` of the border are on it.
  /// \pre the mesh has an area.
  Piece_of_surface_3(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges, std::size_t count,
                     double border_width)
      : samples_(mesh_samples(mesh, edges, count)), volume_(volume_moments(mesh, samples_.area.centroid).measure),
        tree_(tree_of(triangles_with_area(mesh))), border_(border_of(mesh, edges)), border_width_(border_width),
        is_oriented_(has_orientation(edges)) {}

  const Area_samples_3& samples() const { return samples_; }
  bool is_closed() const { return !border_; }
  double volume() const { return volume_; }         ///< bounded by a closed mesh; negative if it is inside out
  bool is_oriented() const { return is_oriented_; } ///< whether neighbors have consistent orientations

  /// Skips the border test for points closer than `touching`.
  Point_of_piece nearest(const Eigen::Vector3d& p, double touching) const {
    const auto found = nearest_triangle(tree_, to_CGAL(p));
    const bool is_on_border = border_ && found.squared_distance > touching * touching &&
                              nearest_triangle(*border_, found.point).squared_distance < border_width_ * border_width_;
    return {to_Eigen(found.point), unit_normal(tree_.triangle(found.part)), is_on_border};
  }

private:
  /// The edges of one triangle only, as degenerate triangles.
  static std::optional<Triangle_tree> border_of(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges) {
    std::vector<Triangle_tree::Triangle_3> border;
    for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
      while (next < edges.size() && edges[next].ends == edges[i].ends) ++next;
      if (next - i > 1) continue;
      const auto a = to_CGAL(mesh.points[edges[i].ends[0]]), b = to_CGAL(mesh.points[edges[i].ends[1]]);
      border.emplace_back(a, b, b);
    }
    if (border.empty()) return std::nullopt;
    return tree_of(std::move(border));
  }

  /// Whether at most one in a hundred edges has two triangles with inconsistent orientations.
  static bool has_orientation(const std::vector<Edge_of_triangle>& edges) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
      wrong += edges[i].ends == edges[i + 1].ends && edges[i].is_forward == edges[i + 1].is_forward;
    return 100 * wrong <= edges.size();
  }

  Area_samples_3 samples_;
  double volume_;
  Triangle_tree tree_;
  std::optional<Triangle_tree> border_;
  double border_width_;
  bool is_oriented_;
};

// Determines which points of two pieces are in contact, and which contradict a map between them.

/// The evidence of a point of one piece for or against a map.
enum class Contact {
  NONE,         ///< none: the other piece may end there
  TOUCHING,     ///< the point is on the other surface
  CONTRADICTING ///< the other surface passes by the point
};

/// The distance below which points touch, and that below which a surface passing by is the same one, displaced.
struct Contact_distances {
  double touching, passing_by;
};

/// A surface passing by at a smaller distance, relative to the size of the smaller piece, is the same one.
constexpr double greatest_displacement = 0.1;

/// Classifies a point of one piece, with its normal, in the coordinates of the other one. Between two sheets of a
/// solid with the same orientation there is another sheet; it is beyond the pieces if the distance is as large as
/// these. Two sheets close to each other have opposite orientations.
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

/// A sample of one of two pieces aligned by a map, in the coordinates of the target.
struct Mapped_sample {
  Eigen::Vector3d point;
  Eigen::Vector3d nearest, normal; ///< of the other surface
  Contact contact;
};

/// The samples of the source and those of the target.
using Mapped_samples = std::array<std::vector<Mapped_sample>, 2>;

/// A similarity with its inverse and its scale.
struct Similarity_3 {
  Affine_map_3 map, inverse;
  double scale;

  explicit Similarity_3(const Affine_map_3& m)
      : map(m), inverse(m.inverse()), scale(std::cbrt(std::abs(m.matrix.determinant()))) {}
};

/// Maps the first `count` samples of both pieces.
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

/// Nearest points of a piece, precomputed for the cells of a cube around the origin: fast, and accurate to about a
/// cell.
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

// Judges a map between two pieces by the points in contact and those that contradict it.

/// The evidence of the contacts of two pieces for and against a map.
struct Contact_evidence {
  std::array<double, 2> inliers{};        ///< fractions of the samples of source and target in contact
  std::array<double, 2> contradictions{}; ///< fractions of the informative samples that contradict
  double area = 0;                        ///< in contact
  double rms = std::numeric_limits<double>::infinity();
  double log10_false_alarms = 0;
  double rigidity = 0;        ///< displacement of points off the other surface per small motion of the kind
  double affine_rigidity = 0; ///< the same for affine maps, one of which may be free
};

/// The fractions of the informative samples of source and target that contradict the map.
inline std::array<double, 2> contradictions_of(const Mapped_samples& samples) {
  std::array<double, 2> result;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto hits = double(count_of(samples[side], Contact::TOUCHING));
    const auto misses = double(count_of(samples[side], Contact::CONTRADICTING));
    result[side] = misses / std::max(1.0, hits + misses);
  }
  return result;
}

/// The distances of samples that touch or contradict; others count as outside of the domain.
inline std::vector<Mapped_point> informative_points(const std::vector<Mapped_sample>& samples) {
  std::vector<Mapped_point> result;
  for (const Mapped_sample& s : samples) {
    const bool is_informative = s.contact != Contact::NONE;
    const double distance = (s.point - s.nearest).norm();
    result.push_back({s.point, {is_informative ? distance : std::numeric_limits<double>::quiet_NaN(), s.normal}});
  }
  return result;
}

/// The rms displacements, in increasing order, of the points in contact off the other surface by infinitesimal maps
/// of a kind, in units of the size of these points.
inline Eigen::VectorXd rigidities(const Mapped_samples& samples, Map_kind kind) {
  Moment_sums_3 sums(samples[0].front().point);
  std::vector<const Mapped_sample*> touching;
  for (const auto& side : samples)
    for (const Mapped_sample& s : side)
      if (s.contact == Contact::TOUCHING) touching.push_back(&s), sums.add_point(s.point);
  const Eigen::MatrixXd maps = infinitesimal_maps(kind);
  if (touching.empty()) return Eigen::VectorXd::Zero(maps.cols());
  const Moments_3 moments = sums.moments();
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(12, 12);
  for (const Mapped_sample* s : touching) {
    const Eigen::Vector3d x = (s->point - moments.centroid) / moments.size();
    Eigen::Matrix<double, 12, 1> row;
    for (int i = 0; i < 3; ++i) row.segment<3>(3 * i) = s->normal[i] * x;
    row.tail<3>() = s->normal;
    squares += row * row.transpose() / double(touching.size());
  }
  const Eigen::MatrixXd of_maps = maps.transpose() * squares * maps;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(of_maps, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
}

/// Judges a map by the contacts of both pieces. `chances` are the fractions of space within a unit of distance from
/// the source and the target.
inline Contact_evidence contact_evidence(const Mapped_samples& samples, Map_kind kind,
                                         const std::array<double, 2>& areas, const std::array<double, 2>& chances,
                                         const Judgement& how) {
  Contact_evidence result;
  Map_evidence evidence;
  double sum = 0, count = 0;
  result.contradictions = contradictions_of(samples);
  for (std::size_t side = 0; side < 2; ++side) {
    const auto hits = double(count_of(samples[side], Contact::TOUCHING));
    const auto all = double(samples[side].size());
    result.inliers[side] = hits / all;
    result.area += areas[side] * hits / all / 2;
    judge_one_way(Sorted_distances(informative_points(samples[side]), 1), chances[1 - side], how, evidence);
    for (const Mapped_sample& s : samples[side])
      if (s.contact == Contact::TOUCHING) sum += (s.point - s.nearest).squaredNorm(), count += 1;
  }
  if (count > 0) result.rms = std::sqrt(sum / count);
  result.log10_false_alarms = std::min(0.0, evidence.log10_false_alarms + std::log10(2 * most_tolerances * how.tests));
  result.rigidity = rigidities(samples, kind)[0];
  result.affine_rigidity = rigidities(samples, Map_kind::AFFINE)[1];
  return result;
}

} // namespace equiaffine::internal

#endif
