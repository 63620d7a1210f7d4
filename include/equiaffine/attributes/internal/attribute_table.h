// SPDX-License-Identifier: GPL-3.0-or-later
// The table of all attributes. To add one, add a row here: columns of files, lists of names, error estimates,
// property maps of `annotate`, web pages, pictures and the help of the program follow.
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
#include <limits>
#include <optional>
#include <string_view>

/// For users: the meaning of a quantity, and of red (positive) and blue (negative).
namespace equiaffine::meanings {

inline constexpr std::string_view k1 =
    "The larger principal curvature. Red where the surface bends toward its normals in some direction, blue where "
    "it bends away from them in all directions.";
inline constexpr std::string_view k2 =
    "The smaller principal curvature. Blue where the surface bends away from its normals in some direction, red "
    "where it bends toward them in all directions.";
inline constexpr std::string_view gaussian_curvature =
    "The product of the principal curvatures. Red where the surface is dome- or bowl-shaped, blue where it is a "
    "saddle, white where it is developable.";
inline constexpr std::string_view mean_curvature =
    "The mean of the principal curvatures. Blue where the surface is convex on the side of its normals, red where it "
    "is concave.";
inline constexpr std::string_view affine_gaussian_curvature =
    "The determinant of the affine shape operator, invariant under affine maps of determinant 1. Red where affine "
    "normals vary as on an ellipsoid, blue where they vary in opposite directions, white as on a paraboloid.";
inline constexpr std::string_view affine_mean_curvature =
    "The mean of the affine principal curvatures. With outward normals: blue as on an ellipsoid, white as on a "
    "paraboloid, red as on a hyperboloid of two sheets.";
inline constexpr std::string_view pick_invariant =
    "The deviation from a quadric, on which it is 0 (white). Blue where the surface is convex on the side of its "
    "normals, red where it is concave, either color on saddles.";
inline constexpr std::string_view affine_normal_angle =
    "The angle between the affine and the Euclidean normal, in degrees: 0 on a sphere. Darker is larger.";
inline constexpr std::string_view affine_area_density =
    "The affine area per Euclidean area, |Gaussian curvature|^(1/4). Darker where more curved in both directions, "
    "pale where developable.";
inline constexpr std::string_view affine_k1 =
    "The larger eigenvalue of the affine shape operator, where it is real. Red and blue as for the affine mean "
    "curvature.";
inline constexpr std::string_view affine_k2 =
    "The smaller eigenvalue of the affine shape operator, where it is real. Red and blue as for the affine mean "
    "curvature.";
inline constexpr std::string_view quadric_defect =
    "The deviation from the osculating quadric: zero everywhere on quadrics and on no other surface. Darker is larger.";
inline constexpr std::string_view shape_index =
    "The shape independent of size. Blue for a dome on the side of the normals, white for a saddle, red for a bowl.";
inline constexpr std::string_view curvedness = "The amount of curvature, independent of shape. Darker is larger.";
inline constexpr std::string_view affine_frame_scale =
    "The combined magnitude of the affine curvatures, the unit of the affine frame. Darker is larger.";
inline constexpr std::string_view affine_frame_quality = "How well the affine frame is determined. Darker is better.";
inline constexpr std::string_view vertex_area =
    "The area of the vertex: a third of the area of its triangles. Darker is larger.";
inline constexpr std::string_view affine_area =
    "The affine area of the vertex: its area times the affine area density. Darker is larger.";

} // namespace equiaffine::meanings

namespace equiaffine {

/// The named lists that contain an attribute, as bits. An attribute in no list is computed only if it is selected by
/// its own name. `of_mesh` is not a list: it marks attributes that exist only at vertices of a mesh.
namespace attribute_lists {

inline constexpr unsigned none = 0, all = 1, basic = 2 | all, signature = 4, of_mesh = 8;

} // namespace attribute_lists

/// The input of the getters of the table at a point.
template <class FT>
struct Attribute_sample {
  /// `area` is a third of the area of the triangles around the vertex of a mesh; NaN for other points.
  Attribute_sample(const Local_structure_3<FT>& s, const FT& area = FT(std::numeric_limits<double>::quiet_NaN()))
      : euclidean(s.euclidean), affine(s.affine), vertex_area(area) {}

  /// The affine frame, computed when a getter first needs it.
  const Affine_frame_3<FT>& frame() const {
    if (!frame_) frame_ = affine_frame(affine);
    return *frame_;
  }

  const Euclidean_structure_3<FT>& euclidean;
  const Affine_structure_3<FT>& affine;
  FT vertex_area;

private:
  mutable std::optional<Affine_frame_3<FT>> frame_;
};

/// The displayed words and symbols for a scalar attribute.
struct Quantity {
  std::string_view label;  ///< if empty, the name of the attribute is displayed
  std::string_view symbol; ///< UTF-8
  std::string_view group;
  int weight = 0;                ///< under p -> s p the number is multiplied by s^(weight / 2)
  int rank = unranked;           ///< attributes with smaller ranks are offered first
  std::string_view meaning = {}; ///< what it is, and what red (positive) and blue (negative) mean

  static constexpr int unranked = 12; ///< after all others, in the order of the columns
};

/// The error estimate of an attribute by fits, for the column NAME_error of files.
struct Attribute_error {
  std::size_t place = 0; ///< among the columns of errors; the two that splines provide, too, come first
  double (*get)(const Local_structure_error_3<double>&) = nullptr;
  /// Returns the reference magnitude for relative errors. It does not vanish where a curvature merely changes sign.
  double (*size)(const Local_structure_3<double>&) = nullptr;
  std::string_view name_of_size = {}; ///< as printed by the program; empty if no error is estimated
  double power_of_negligible = 0;     ///< of |K_e|, in negligible(); 0 if no error is negligible

  /// Whether an error is estimated. Tests the name because GCC 12 with -fsanitize cannot compare pointers to
  /// functions at compile time.
  constexpr bool exists() const { return !name_of_size.empty(); }

  /// Returns the negligible error of an affine curvature, or -1 if no error is negligible: 1e-9 of the natural size
  /// for that K_e. A K of zero can be known to within this error, but not to within a fraction of itself.
  double negligible(double euclidean_gaussian_curvature) const {
    if (power_of_negligible == 0) return -1;
    return 1e-9 * std::pow(std::abs(euclidean_gaussian_curvature), power_of_negligible);
  }

  /// Whether a number is known to within a fraction of its size, or its error is negligible.
  bool is_known(const Local_structure_3<double>& structure, const Local_structure_error_3<double>& error,
                double part) const {
    return get(error) <= part * size(structure) || get(error) <= negligible(structure.euclidean.gaussian_curvature);
  }
};

/// A scalar, or a vector or form with several components.
template <class FT>
struct Attribute_row {
  std::string_view name;
  std::array<std::string_view, 6> components; ///< names in files; empty for a scalar, whose column has the name `name`
  unsigned lists;                             ///< bits of `attribute_lists`
  int order; ///< of the derivatives of f that it needs; scalars of order 3 and more do not exist at parabolic points
  /// Returns the component with the given index. Null for an attribute that is not in a sample.
  FT (*get)(const Attribute_sample<FT>&, std::size_t component);
  Quantity quantity = {};
  Attribute_error error = {};
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

} // namespace equiaffine

// Reference magnitudes for relative errors.
namespace equiaffine::internal {

inline double affine_size(const Local_structure_3<double>& s) {
  return std::abs(s.affine.gaussian_curvature) + s.affine.mean_curvature * s.affine.mean_curvature;
}
inline double curved_size(const Local_structure_3<double>& s) { return curvedness(s.euclidean.k1, s.euclidean.k2); }
inline double angle_size(const Local_structure_3<double>&) { return 30; } // degrees

} // namespace equiaffine::internal

namespace equiaffine {

// clang-format off

/// The attributes after the metric: combinations of others, frames, and norms of gradients.
template <class FT>
inline constexpr auto later_attributes = [] {
  using namespace attribute_lists;
  using internal::angle_size;
  using Row = Attribute_row<FT>;
  return std::array{
      Row{"affine_normal_angle", {}, basic, 3,
          [](const auto& s, auto) { return angle_in_degrees(s.affine.normal, s.euclidean.normal); },
          {"Angle of affine and Euclidean normal", "∠(ξ, n)", "Affine", 0, 3, meanings::affine_normal_angle},
          {4, [](const auto& e) { return std::hypot(e.affine_normal, e.normal); }, angle_size, "30 degrees"}},
      Row{"affine_area_density", {}, basic, 2,
          [](const auto& s, auto) { return affine_area_density(s.euclidean.gaussian_curvature); },
          {"Affine area density", "|Kₑ|^¼", "Affine", -1, 4, meanings::affine_area_density},
          {5, [](const auto& e) { return e.affine_area_density; },
           [](const auto& s) { return affine_area_density(s.euclidean.gaussian_curvature); }, "itself"}},
      Row{"quadric_defect", {}, none, 3, [](const auto& s, auto) { return s.affine.quadric_defect; },
          {"Quadric defect", "|T| / |II|²", "Affine", 0, 7, meanings::quadric_defect}},
      Row{"shape_index", {}, none, 2, [](const auto& s, auto) { return shape_index(s.euclidean.k1, s.euclidean.k2); },
          {"Shape index", "s", "Euclidean", 0, Quantity::unranked, meanings::shape_index}},
      Row{"curvedness", {}, none, 2, [](const auto& s, auto) { return curvedness(s.euclidean.k1, s.euclidean.k2); },
          {"Curvedness", "c", "Euclidean", -2, Quantity::unranked, meanings::curvedness}},
      Row{"vertex_area", {}, of_mesh, 0, [](const auto& s, auto) { return s.vertex_area; },
          {"Area", "A", "Euclidean", 4, Quantity::unranked, meanings::vertex_area}},
      Row{"affine_area", {}, of_mesh, 2,
          [](const auto& s, auto) { return s.vertex_area * affine_area_density(s.euclidean.gaussian_curvature); },
          {"Affine area", "Ω", "Affine", 3, Quantity::unranked, meanings::affine_area}},
      Row{"affine_frame1", {"affine_frame1_x", "affine_frame1_y", "affine_frame1_z"}, none, 4,
          [](const auto& s, auto i) { return s.frame().e1[i]; }},
      Row{"affine_frame2", {"affine_frame2_x", "affine_frame2_y", "affine_frame2_z"}, none, 4,
          [](const auto& s, auto i) { return s.frame().e2[i]; }},
      Row{"affine_frame3", {"affine_frame3_x", "affine_frame3_y", "affine_frame3_z"}, none, 3,
          [](const auto& s, auto i) { return s.frame().xi[i]; }},
      Row{"affine_frame_scale", {}, none, 4, [](const auto& s, auto) { return s.frame().scale; },
          {"Scale of the affine frame", "r", "Affine", -3, Quantity::unranked, meanings::affine_frame_scale}},
      Row{"affine_frame_quality", {}, none, 4, [](const auto& s, auto) { return s.frame().quality; },
          {"Quality of the affine frame", "q", "Affine", 0, Quantity::unranked, meanings::affine_frame_quality}},
      Row{"affine_signature", {"affine_signature1", "affine_signature2", "affine_signature3", "affine_signature4"},
          none, 4, [](const auto& s, auto i) { return s.frame().signature[i]; }},
      Row{"affine_gaussian_curvature_gradient", {}, signature, 5, nullptr, {}, {}, 0},
      Row{"affine_mean_curvature_gradient", {}, signature, 5, nullptr, {}, {}, 1},
      Row{"pick_invariant_gradient", {}, signature, 4, nullptr, {}, {}, 2},
  };
}();

/// All attributes in the order of the columns of a file.
template <class FT>
inline constexpr auto attribute_table = [] {
  using namespace attribute_lists;
  using internal::affine_size, internal::angle_size, internal::curved_size;
  using Row = Attribute_row<FT>;
  const std::array rows = {
      Row{"normal", {"nx", "ny", "nz"}, basic, 1, [](const auto& s, auto i) { return s.euclidean.normal[i]; },
          {}, {7, [](const auto& e) { return e.normal; }, angle_size, "30 degrees"}},
      Row{"k1", {}, basic, 2, [](const auto& s, auto) { return s.euclidean.k1; },
          {"Principal curvature 1", "k₁", "Euclidean", -2, 10, meanings::k1},
          {10, [](const auto& e) { return e.k1; }, curved_size, "the curvedness"}},
      Row{"k2", {}, basic, 2, [](const auto& s, auto) { return s.euclidean.k2; },
          {"Principal curvature 2", "k₂", "Euclidean", -2, 11, meanings::k2},
          {11, [](const auto& e) { return e.k2; }, curved_size, "the curvedness"}},
      Row{"gaussian_curvature", {}, basic, 2, [](const auto& s, auto) { return s.euclidean.gaussian_curvature; },
          {"Gaussian curvature", "Kₑ", "Euclidean", -4, 9, meanings::gaussian_curvature},
          {8, [](const auto& e) { return e.euclidean_gaussian_curvature; },
           [](const auto& s) { return curved_size(s) * curved_size(s); }, "the square of the curvedness"}},
      Row{"mean_curvature", {}, basic, 2, [](const auto& s, auto) { return s.euclidean.mean_curvature; },
          {"Mean curvature", "Hₑ", "Euclidean", -2, 8, meanings::mean_curvature},
          {9, [](const auto& e) { return e.euclidean_mean_curvature; }, curved_size, "the curvedness"}},
      Row{"conormal", {"conormal_x", "conormal_y", "conormal_z"}, basic, 2,
          [](const auto& s, auto i) { return s.affine.conormal[i]; },
          {}, {6, [](const auto& e) { return e.normal; }, angle_size, "30 degrees"}},
      Row{"affine_normal", {"affine_normal_x", "affine_normal_y", "affine_normal_z"}, basic, 3,
          [](const auto& s, auto i) { return s.affine.normal[i]; },
          {}, {3, [](const auto& e) { return e.affine_normal; }, angle_size, "30 degrees"}},
      Row{"affine_gaussian_curvature", {}, basic | signature, 4,
          [](const auto& s, auto) { return s.affine.gaussian_curvature; },
          {"Affine Gaussian curvature", "K", "Affine", -6, 0, meanings::affine_gaussian_curvature},
          {0, [](const auto& e) { return e.affine_gaussian_curvature; }, affine_size, "|K| + H^2", 1.5}},
      Row{"affine_mean_curvature", {}, basic | signature, 4,
          [](const auto& s, auto) { return s.affine.mean_curvature; },
          {"Affine mean curvature", "H", "Affine", -3, 1, meanings::affine_mean_curvature},
          {1, [](const auto& e) { return e.affine_mean_curvature; },
           [](const auto& s) { return std::sqrt(affine_size(s)); }, "(|K| + H^2)^(1/2)", .75}},
      Row{"pick_invariant", {}, basic | signature, 3, [](const auto& s, auto) { return s.affine.pick_invariant; },
          {"Pick invariant", "J", "Affine", -3, 2, meanings::pick_invariant},
          {2, [](const auto& e) { return e.pick_invariant; },
           [](const auto& s) { return std::abs(s.affine.pick_invariant); }, "|J|", .75}},
      Row{"affine_k1", {}, all, 4, [](const auto& s, auto) { return s.affine.k1; },
          {"Affine principal curvature 1", "κ₁", "Affine", -3, 5, meanings::affine_k1}},
      Row{"affine_k2", {}, all, 4, [](const auto& s, auto) { return s.affine.k2; },
          {"Affine principal curvature 2", "κ₂", "Affine", -3, 6, meanings::affine_k2}},
      Row{"direction1", {"direction1_x", "direction1_y", "direction1_z"}, all, 2,
          [](const auto& s, auto i) { return s.euclidean.direction1[i]; }},
      Row{"direction2", {"direction2_x", "direction2_y", "direction2_z"}, all, 2,
          [](const auto& s, auto i) { return s.euclidean.direction2[i]; }},
      Row{"metric", {"metric_xx", "metric_xy", "metric_xz", "metric_yy", "metric_yz", "metric_zz"}, all, 2,
          [](const auto& s, auto i) { return s.affine.metric[i]; }},
  };
  std::array<Row, rows.size() + later_attributes<FT>.size()> all_rows{};
  std::copy(later_attributes<FT>.begin(), later_attributes<FT>.end(),
            std::copy(rows.begin(), rows.end(), all_rows.begin()));
  return all_rows;
}();

// clang-format on

/// The rows with an error, in the order of the columns with errors.
inline constexpr auto rows_with_error = [] {
  constexpr auto has_error = [](const Attribute_row<double>& row) { return row.error.exists(); };
  constexpr auto& all = attribute_table<double>;
  std::array<const Attribute_row<double>*, std::size_t(std::count_if(all.begin(), all.end(), has_error))> rows{};
  for (const auto& row : all)
    if (has_error(row)) rows[row.error.place] = &row;
  return rows;
}();

/// Returns the row of the attribute, or null.
constexpr const Attribute_row<double>* find_row(std::string_view name) {
  for (const auto& row : attribute_table<double>)
    if (row.name == name) return &row;
  return nullptr;
}

/// Returns the words for the scalar attribute, or null if it has no label or is unknown.
constexpr const Quantity* find_quantity(std::string_view name) {
  const auto* const row = find_row(name);
  return row && !row->quantity.label.empty() ? &row->quantity : nullptr;
}

/// Returns the rank of the attribute: pages and pictures offer attributes with smaller ranks first.
constexpr int rank_of_quantity(std::string_view name) {
  const Quantity* const quantity = find_quantity(name);
  return quantity ? quantity->rank : Quantity::unranked;
}

/// Returns whether the attribute does not exist where the Gaussian curvature is zero. On both sides of such a curve
/// it grows without bound, unless it is zero.
constexpr bool is_undefined_at_parabolic_points(std::string_view name) {
  return find_quantity(name) != nullptr && find_row(name)->order > 2;
}

/// Returns the difference below which two numbers of a column are equal up to rounding, on a surface with a bounding
/// box of that diagonal: 1e-9 in the surface's own unit of length, the accuracy promised for curvatures. Returns 0
/// for an unknown column.
inline double rounding_of_quantity(std::string_view name, double diagonal) {
  const Quantity* const quantity = find_quantity(name);
  if (quantity == nullptr || !(diagonal > 0)) return 0;
  return 1e-9 * std::pow(diagonal, quantity->weight / 2.);
}

} // namespace equiaffine

#endif
