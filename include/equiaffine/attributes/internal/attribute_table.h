// SPDX-License-Identifier: GPL-3.0-or-later
// The table of all attributes. A new one is a row here: columns of files, lists of names, property maps of `annotate`,
// web pages, pictures and the help of the program follow.
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_ATTRIBUTE_TABLE_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_ATTRIBUTE_TABLE_H

#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/affine_frame.h>
#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/geometry/euclidean_structure.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

/// Sentences that tell people what a quantity is, and what red (positive) and blue (negative) mean.
namespace equiaffine::meanings {

inline constexpr std::string_view k1 =
    "The greater principal curvature. Red where the surface bends towards its normals in some direction, blue where "
    "it bends away from them in all.";
inline constexpr std::string_view k2 =
    "The lesser principal curvature. Blue where the surface bends away from its normals in some direction, red "
    "where it bends towards them in all.";
inline constexpr std::string_view gaussian_curvature =
    "The product of the principal curvatures. Red where the surface is rounded like a ball, blue where it is a "
    "saddle, white where it can be unrolled.";
inline constexpr std::string_view mean_curvature =
    "The mean of the principal curvatures. Blue where the surface bulges to the side of its normals, red where it "
    "is hollow there.";
inline constexpr std::string_view affine_gaussian_curvature =
    "How affine normals spread, the same after affine maps of determinant 1. Red where they turn as on an "
    "ellipsoid, blue where they turn to opposite sides, white as on a paraboloid.";
inline constexpr std::string_view affine_mean_curvature =
    "The mean of the affine principal curvatures. For normals that point out of the shape: blue as on an ellipsoid, "
    "white as on a paraboloid, red as on a hyperboloid of two sheets.";
inline constexpr std::string_view pick_invariant =
    "How far the surface is from a quadric, where it is white. Blue where it bulges to the side of its normals, red "
    "where it is hollow there, either on saddles.";
inline constexpr std::string_view affine_normal_angle =
    "How far the affine normal leans from the Euclidean one, in degrees: 0 as on a sphere. Darker is more.";
inline constexpr std::string_view affine_area_density =
    "The affine area per Euclidean area, the fourth root of the size of the Gaussian curvature. Darker is more "
    "curved, in both directions; pale where the surface can be unrolled.";
inline constexpr std::string_view affine_k1 =
    "The greater eigenvalue of the affine shape operator, where it is real. Red and blue as for the affine mean "
    "curvature.";
inline constexpr std::string_view affine_k2 =
    "The lesser eigenvalue of the affine shape operator, where it is real. Red and blue as for the affine mean "
    "curvature.";
inline constexpr std::string_view quadric_defect =
    "How far the surface is from the quadric that touches it best, zero on quadrics and nowhere else. Darker is "
    "farther.";
inline constexpr std::string_view shape_index =
    "The form regardless of size. Blue for a dome on the side of the normals, white for a saddle, red for a bowl.";
inline constexpr std::string_view curvedness = "How strongly the surface is curved, whatever its form. Darker is more.";
inline constexpr std::string_view affine_frame_scale =
    "The size of the affine curvatures taken together, which the affine frame has for its unit. Darker is more.";
inline constexpr std::string_view affine_frame_quality = "How well the affine frame is determined. Darker is better.";

} // namespace equiaffine::meanings

namespace equiaffine {

/// The named lists that an attribute belongs to, as bits. An attribute that is in no list is computed only if it is
/// selected by its own name.
namespace attribute_lists {

inline constexpr unsigned none = 0, all = 1, basic = 2 | all, signature = 4;

} // namespace attribute_lists

/// The words and symbols by which people read of a scalar attribute.
struct Quantity {
  std::string_view label;  ///< if it is empty, people read the name of the attribute
  std::string_view symbol; ///< UTF-8
  std::string_view group;
  int weight = 0;                          ///< under p -> s p the number is multiplied by s^(weight / 2)
  int rank = unranked;                     ///< attributes with smaller ranks are offered first
  bool exists_at_parabolic_points = false; ///< said of an affine one, most of which do not
  std::string_view meaning = {};           ///< what it is, and what red (positive) and blue (negative) mean

  static constexpr int unranked = 12; ///< offered after all others, in the order of the columns
};

/// A scalar, or a vector or form with several components.
template <class FT>
struct Attribute_row {
  std::string_view name;
  std::array<std::string_view, 6> components; ///< their names in files; empty for a scalar, which is called `name`
  unsigned lists;                             ///< bits of `attribute_lists`
  /// Returns the component with the given number. It is null for an attribute that a local structure does not have.
  FT (*get)(const Local_structure_3<FT>&, std::size_t component);
  Quantity quantity = {};
  std::optional<std::size_t> gradient = {}; ///< index in the result of affine_gradient_norms()

  constexpr bool is_scalar() const { return components[0].empty(); }

  constexpr std::size_t size() const {
    std::size_t count = 0;
    while (count < components.size() && !components[count].empty()) ++count;
    return is_scalar() ? 1 : count;
  }

  /// The name of a column of a file.
  constexpr std::string_view column(std::size_t component) const { return is_scalar() ? name : components[component]; }
};

// clang-format off

/// The attributes of frames, and norms of gradients, which are computed by name only.
template <class FT>
inline constexpr auto attribute_table_of_frames = [] {
  using namespace attribute_lists;
  using Row = Attribute_row<FT>;
  return std::array{
      Row{"affine_frame1", {"affine_frame1_x", "affine_frame1_y", "affine_frame1_z"}, none,
          [](const auto& s, auto i) { return affine_frame(s.affine).e1[i]; }},
      Row{"affine_frame2", {"affine_frame2_x", "affine_frame2_y", "affine_frame2_z"}, none,
          [](const auto& s, auto i) { return affine_frame(s.affine).e2[i]; }},
      Row{"affine_frame3", {"affine_frame3_x", "affine_frame3_y", "affine_frame3_z"}, none,
          [](const auto& s, auto i) { return affine_frame(s.affine).xi[i]; }},
      Row{"affine_frame_scale", {}, none, [](const auto& s, auto) { return affine_frame(s.affine).scale; },
          {"Scale of the affine frame", "r", "Affine", -3, Quantity::unranked, false, meanings::affine_frame_scale}},
      Row{"affine_frame_quality", {}, none, [](const auto& s, auto) { return affine_frame(s.affine).quality; },
          {"Quality of the affine frame", "q", "Affine", 0, Quantity::unranked, false, meanings::affine_frame_quality}},
      Row{"affine_signature", {"affine_signature1", "affine_signature2", "affine_signature3", "affine_signature4"}, none,
          [](const auto& s, auto i) { return affine_frame(s.affine).signature[i]; }},
      Row{"affine_gaussian_curvature_gradient", {}, signature, nullptr, {}, 0},
      Row{"affine_mean_curvature_gradient", {}, signature, nullptr, {}, 1},
      Row{"pick_invariant_gradient", {}, signature, nullptr, {}, 2},
  };
}();

/// All attributes in the order of the columns of a file.
template <class FT>
inline constexpr auto attribute_table = [] {
  using namespace attribute_lists;
  using Row = Attribute_row<FT>;
  const std::array rows = {
      Row{"normal", {"nx", "ny", "nz"}, basic, [](const auto& s, auto i) { return s.euclidean.normal[i]; }},
      Row{"k1", {}, basic, [](const auto& s, auto) { return s.euclidean.k1; },
          {"Principal curvature 1", "k₁", "Euclidean", -2, 10, false, meanings::k1}},
      Row{"k2", {}, basic, [](const auto& s, auto) { return s.euclidean.k2; },
          {"Principal curvature 2", "k₂", "Euclidean", -2, 11, false, meanings::k2}},
      Row{"gaussian_curvature", {}, basic, [](const auto& s, auto) { return s.euclidean.gaussian_curvature; },
          {"Gaussian curvature", "Kₑ", "Euclidean", -4, 9, false, meanings::gaussian_curvature}},
      Row{"mean_curvature", {}, basic, [](const auto& s, auto) { return s.euclidean.mean_curvature; },
          {"Mean curvature", "Hₑ", "Euclidean", -2, 8, false, meanings::mean_curvature}},
      Row{"conormal", {"conormal_x", "conormal_y", "conormal_z"}, basic,
          [](const auto& s, auto i) { return s.affine.conormal[i]; }},
      Row{"affine_normal", {"affine_normal_x", "affine_normal_y", "affine_normal_z"}, basic,
          [](const auto& s, auto i) { return s.affine.normal[i]; }},
      Row{"affine_gaussian_curvature", {}, basic | signature,
          [](const auto& s, auto) { return s.affine.gaussian_curvature; },
          {"Affine Gaussian curvature", "K", "Affine", -6, 0, false, meanings::affine_gaussian_curvature}},
      Row{"affine_mean_curvature", {}, basic | signature, [](const auto& s, auto) { return s.affine.mean_curvature; },
          {"Affine mean curvature", "H", "Affine", -3, 1, false, meanings::affine_mean_curvature}},
      Row{"pick_invariant", {}, basic | signature, [](const auto& s, auto) { return s.affine.pick_invariant; },
          {"Pick invariant", "J", "Affine", -3, 2, false, meanings::pick_invariant}},
      Row{"affine_k1", {}, all, [](const auto& s, auto) { return s.affine.k1; },
          {"Affine principal curvature 1", "κ₁", "Affine", -3, 5, false, meanings::affine_k1}},
      Row{"affine_k2", {}, all, [](const auto& s, auto) { return s.affine.k2; },
          {"Affine principal curvature 2", "κ₂", "Affine", -3, 6, false, meanings::affine_k2}},
      Row{"direction1", {"direction1_x", "direction1_y", "direction1_z"}, all,
          [](const auto& s, auto i) { return s.euclidean.direction1[i]; }},
      Row{"direction2", {"direction2_x", "direction2_y", "direction2_z"}, all,
          [](const auto& s, auto i) { return s.euclidean.direction2[i]; }},
      Row{"metric", {"metric_xx", "metric_xy", "metric_xz", "metric_yy", "metric_yz", "metric_zz"}, all,
          [](const auto& s, auto i) { return s.affine.metric[i]; }},
      Row{"affine_normal_angle", {}, basic,
          [](const auto& s, auto) { return angle_in_degrees(s.affine.normal, s.euclidean.normal); },
          {"Angle of affine and Euclidean normal", "∠(ξ, n)", "Affine", 0, 3, false, meanings::affine_normal_angle}},
      Row{"affine_area_density", {}, basic,
          [](const auto& s, auto) { return affine_area_density(s.euclidean.gaussian_curvature); },
          {"Affine area density", "|Kₑ|^¼", "Affine", -1, 4, true, meanings::affine_area_density}},
      Row{"quadric_defect", {}, none, [](const auto& s, auto) { return s.affine.quadric_defect; },
          {"Quadric defect", "|T| / |II|²", "Affine", 0, 7, false, meanings::quadric_defect}},
      Row{"shape_index", {}, none, [](const auto& s, auto) { return shape_index(s.euclidean.k1, s.euclidean.k2); },
          {"Shape index", "s", "Euclidean", 0, Quantity::unranked, false, meanings::shape_index}},
      Row{"curvedness", {}, none, [](const auto& s, auto) { return curvedness(s.euclidean.k1, s.euclidean.k2); },
          {"Curvedness", "c", "Euclidean", -2, Quantity::unranked, false, meanings::curvedness}},
  };
  std::array<Row, rows.size() + attribute_table_of_frames<FT>.size()> all_rows{};
  std::copy(attribute_table_of_frames<FT>.begin(), attribute_table_of_frames<FT>.end(),
            std::copy(rows.begin(), rows.end(), all_rows.begin()));
  return all_rows;
}();

// clang-format on

/// Returns the words for the scalar attribute with that name, or null if it has no label or is none of our attributes.
constexpr const Quantity* find_quantity(std::string_view name) {
  for (const auto& row : attribute_table<double>)
    if (row.name == name && !row.quantity.label.empty()) return &row.quantity;
  return nullptr;
}

/// Returns the rank of the attribute with that name: pages and pictures offer attributes with smaller ranks first.
constexpr int rank_of_quantity(std::string_view name) {
  const Quantity* const quantity = find_quantity(name);
  return quantity ? quantity->rank : Quantity::unranked;
}

/// Returns whether numbers of that attribute do not exist where the Gaussian curvature is zero. On both sides of such a
/// curve they grow without bound, unless they are zero.
constexpr bool is_undefined_at_parabolic_points(std::string_view name) {
  const Quantity* const quantity = find_quantity(name);
  return quantity != nullptr && quantity->group == "Affine" && !quantity->exists_at_parabolic_points;
}

/// Returns the difference below which two numbers of a column are equal up to rounding, on a surface whose box has that
/// diagonal: 1e-9 in the surface's own unit of length, which is the accuracy promised for curvatures. Returns zero for
/// a column that is none of our attributes, since nothing is known about it.
inline double rounding_of_quantity(std::string_view name, double diagonal) {
  const Quantity* const quantity = find_quantity(name);
  if (quantity == nullptr || !(diagonal > 0)) return 0;
  return 1e-9 * std::pow(diagonal, quantity->weight / 2.);
}

} // namespace equiaffine

#endif
