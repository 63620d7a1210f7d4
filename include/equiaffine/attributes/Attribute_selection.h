// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_ATTRIBUTE_SELECTION_H
#define EQUIAFFINE_ATTRIBUTES_ATTRIBUTE_SELECTION_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// One number of the local structure over FT, as it is named in files: a scalar, or a component of a vector.
template <class FT>
struct Attribute_of {
  std::string_view name;
  std::string_view group; ///< the vector or form it belongs to; for a scalar its own name
  bool is_basic;
  FT (*get)(const Local_structure_3<FT>&);
};

/// Those of affine_gradient_norms(), in its order.
inline constexpr std::array<std::string_view, 3> gradient_names = {
    "affine_gaussian_curvature_gradient", "affine_mean_curvature_gradient", "pick_invariant_gradient"};

/// A local structure does not know it.
template <class FT>
constexpr Attribute_of<FT> gradient_attribute(std::string_view name) {
  return {name, name, false, [](const Local_structure_3<FT>&) { return FT(std::numeric_limits<double>::quiet_NaN()); }};
}

/// All attributes in the order of the columns of a file.
template <class FT>
inline constexpr auto all_attributes_of = [] {
  using Attribute = Attribute_of<FT>;
  return std::array{
      Attribute{"nx", "normal", true, [](const auto& s) { return s.euclidean.normal[0]; }},
      Attribute{"ny", "normal", true, [](const auto& s) { return s.euclidean.normal[1]; }},
      Attribute{"nz", "normal", true, [](const auto& s) { return s.euclidean.normal[2]; }},
      Attribute{"k1", "k1", true, [](const auto& s) { return s.euclidean.k1; }},
      Attribute{"k2", "k2", true, [](const auto& s) { return s.euclidean.k2; }},
      Attribute{"gaussian_curvature", "gaussian_curvature", true,
                [](const auto& s) { return s.euclidean.gaussian_curvature; }},
      Attribute{"mean_curvature", "mean_curvature", true, [](const auto& s) { return s.euclidean.mean_curvature; }},
      Attribute{"conormal_x", "conormal", true, [](const auto& s) { return s.affine.conormal[0]; }},
      Attribute{"conormal_y", "conormal", true, [](const auto& s) { return s.affine.conormal[1]; }},
      Attribute{"conormal_z", "conormal", true, [](const auto& s) { return s.affine.conormal[2]; }},
      Attribute{"affine_normal_x", "affine_normal", true, [](const auto& s) { return s.affine.normal[0]; }},
      Attribute{"affine_normal_y", "affine_normal", true, [](const auto& s) { return s.affine.normal[1]; }},
      Attribute{"affine_normal_z", "affine_normal", true, [](const auto& s) { return s.affine.normal[2]; }},
      Attribute{"affine_gaussian_curvature", "affine_gaussian_curvature", true,
                [](const auto& s) { return s.affine.gaussian_curvature; }},
      Attribute{"affine_mean_curvature", "affine_mean_curvature", true,
                [](const auto& s) { return s.affine.mean_curvature; }},
      Attribute{"pick_invariant", "pick_invariant", true, [](const auto& s) { return s.affine.pick_invariant; }},
      Attribute{"affine_k1", "affine_k1", false, [](const auto& s) { return s.affine.k1; }},
      Attribute{"affine_k2", "affine_k2", false, [](const auto& s) { return s.affine.k2; }},
      Attribute{"direction1_x", "direction1", false, [](const auto& s) { return s.euclidean.direction1[0]; }},
      Attribute{"direction1_y", "direction1", false, [](const auto& s) { return s.euclidean.direction1[1]; }},
      Attribute{"direction1_z", "direction1", false, [](const auto& s) { return s.euclidean.direction1[2]; }},
      Attribute{"direction2_x", "direction2", false, [](const auto& s) { return s.euclidean.direction2[0]; }},
      Attribute{"direction2_y", "direction2", false, [](const auto& s) { return s.euclidean.direction2[1]; }},
      Attribute{"direction2_z", "direction2", false, [](const auto& s) { return s.euclidean.direction2[2]; }},
      Attribute{"metric_xx", "metric", false, [](const auto& s) { return s.affine.metric[0]; }},
      Attribute{"metric_xy", "metric", false, [](const auto& s) { return s.affine.metric[1]; }},
      Attribute{"metric_xz", "metric", false, [](const auto& s) { return s.affine.metric[2]; }},
      Attribute{"metric_yy", "metric", false, [](const auto& s) { return s.affine.metric[3]; }},
      Attribute{"metric_yz", "metric", false, [](const auto& s) { return s.affine.metric[4]; }},
      Attribute{"metric_zz", "metric", false, [](const auto& s) { return s.affine.metric[5]; }},
      Attribute{"quadric_defect", "quadric_defect", false, [](const auto& s) { return s.affine.quadric_defect; }},
      gradient_attribute<FT>(gradient_names[0]),
      gradient_attribute<FT>(gradient_names[1]),
      gradient_attribute<FT>(gradient_names[2]),
  };
}();

using Attribute = Attribute_of<double>;
inline constexpr auto all_attributes = all_attributes_of<double>;

/// Which attributes to compute, in the order of the table; with at least one of them, or `status` alone, comes the
/// status.
struct Attribute_selection {
  std::vector<Attribute> columns;
  bool has_status = true;
};

namespace internal {

/// `signature` is K, H, J and the norms of their gradients. These, which take 40 times as long, and the quadric defect
/// come only by name.
inline bool is_selected_by(const Attribute& attribute, std::string_view name) {
  const bool is_gradient =
      std::find(gradient_names.begin(), gradient_names.end(), attribute.name) != gradient_names.end();
  if (name == "basic") return attribute.is_basic;
  if (name == "all") return !is_gradient && attribute.name != "quadric_defect";
  if (name == "signature")
    return is_gradient || attribute.name == "affine_gaussian_curvature" || attribute.name == "affine_mean_curvature" ||
           attribute.name == "pick_invariant";
  return name == attribute.name || name == attribute.group;
}

} // namespace internal

/// Reads `basic`, `all`, `none`, or a comma-separated list of names of attributes, of their groups (`normal`, `metric`,
/// `signature`) and `status`. \throw Input_error for another name.
inline Attribute_selection select_attributes(std::string_view list) {
  if (list == "none") return {{}, false};
  std::array<bool, all_attributes.size()> is_selected{};
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string_view name = list.substr(begin, end - begin);
    bool is_known = name == "status";
    for (std::size_t n = 0; n < all_attributes.size(); ++n) {
      const bool matches = internal::is_selected_by(all_attributes[n], name);
      is_selected[n] = is_selected[n] || matches;
      is_known = is_known || matches;
    }
    if (!is_known)
      throw Input_error("unknown attribute '" + std::string(name) +
                        "': use basic, all, none, or a list of names such as normal,affine_mean_curvature,status");
    begin = end + 1;
  }
  Attribute_selection selection;
  for (std::size_t n = 0; n < all_attributes.size(); ++n)
    if (is_selected[n]) selection.columns.push_back(all_attributes[n]);
  return selection;
}

} // namespace equiaffine

#endif
