// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_H
#define EQUIAFFINE_ATTRIBUTES_H

#include <equiaffine/Indexed_triangle_mesh_3.h>
#include <equiaffine/Input_error.h>
#include <equiaffine/Local_structure_3.h>
#include <equiaffine/Pack.h>
#include <equiaffine/concepts.h>
#include <equiaffine/internal/parallel_for.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// One number of the local structure, as it is named in files: a scalar, or a component of a vector.
struct Attribute {
  std::string_view name;
  std::string_view group; ///< the vector or form it belongs to; for a scalar its own name
  bool is_basic;
  double (*get)(const Local_structure_3<double>&);
  Pack<double> (*get_lanes)(const Local_structure_3<Pack<double>>&);

  constexpr Attribute(std::string_view its_name, std::string_view its_group, bool basic, auto of_structure)
      : name(its_name), group(its_group), is_basic(basic), get(of_structure), get_lanes(of_structure) {}
};

/// All attributes in the order of the columns of a file.
inline constexpr auto all_attributes = [] {
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
  };
}();

/// Which attributes to compute, in the order of the table; with at least one of them, or `status` alone, comes the
/// status.
struct Attribute_selection {
  std::vector<Attribute> columns;
  bool has_status = true;
};

/// Reads `basic`, `all`, `none`, or a comma-separated list of names of attributes, of their groups (`normal`, `metric`)
/// and `status`. \throw Input_error for another name.
inline Attribute_selection select_attributes(std::string_view list) {
  if (list == "none") return {{}, false};
  std::array<bool, all_attributes.size()> is_selected{};
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string_view name = list.substr(begin, end - begin);
    bool is_known = name == "status";
    for (std::size_t n = 0; n < all_attributes.size(); ++n) {
      const Attribute& attribute = all_attributes[n];
      const bool matches =
          name == attribute.name || name == attribute.group || name == "all" || (name == "basic" && attribute.is_basic);
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

namespace internal {

template <class Point_3>
auto magnitude(const Point_3& p) {
  using std::abs;
  return std::max({abs(p.x()), abs(p.y()), abs(p.z())});
}

} // namespace internal

/// The local structure of the level set of f through p. `sampled_status` is what the sampler says of p: a point that is
/// UNCONVERGED stays so, with the numbers that exist, unless it is OUTSIDE.
template <ImplicitFunctionTraits_3 Traits>
Local_structure_3<typename Traits::FT> local_structure_at(const Traits& traits, const typename Traits::Point_3& p,
                                                          Point_status sampled_status = Point_status::REGULAR) {
  auto structure = local_structure(traits.taylor(p), internal::magnitude(p));
  if (sampled_status == Point_status::UNCONVERGED && structure.status != Point_status::OUTSIDE)
    structure.status = Point_status::UNCONVERGED;
  return structure;
}

namespace internal {

template <class FT>
Jet_3<FT> lane(const Jet_3<Pack<FT>>& jet, std::size_t i) {
  Jet_3<FT> result;
  for (std::size_t n = 0; n < result.size; ++n) result.coefficients()[n] = jet.coefficients()[n][i];
  return result;
}

/// The expansions at `count` <= Pack::size points, the last one repeated: from the model's own packs if it has them and
/// its function does not branch differently there, else one by one.
template <class Traits, class FT = typename Traits::FT>
Jet_3<Pack<FT>> taylor_lanes(const Traits& traits, const typename Traits::Point_3* points, std::size_t count) {
  const auto point = [&](std::size_t lane) -> decltype(auto) { return points[std::min(lane, count - 1)]; };
  if constexpr (PackImplicitFunctionTraits_3<Traits>) {
    try {
      return traits.taylor(Pack<FT>::generate([&](std::size_t i) { return point(i).x(); }),
                           Pack<FT>::generate([&](std::size_t i) { return point(i).y(); }),
                           Pack<FT>::generate([&](std::size_t i) { return point(i).z(); }));
    } catch (const Lanes_disagree&) {
    }
  }
  std::array<Jet_3<FT>, Pack<FT>::size> jets;
  for (std::size_t i = 0; i < count; ++i) jets[i] = traits.taylor(points[i]);
  Jet_3<Pack<FT>> result;
  for (std::size_t n = 0; n < result.size; ++n)
    result.coefficients()[n] =
        Pack<FT>::generate([&](std::size_t i) { return jets[std::min(i, count - 1)].coefficients()[n]; });
  return result;
}

/// Fills the rows [first, first + count), count <= Pack::size, of the columns. Lanes that are not regular are done
/// again as single points, where the reason is found.
template <class Traits>
void compute_block_of_attributes(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                 std::size_t first, std::size_t count, const Attribute_selection& selection,
                                 Vertex_attributes& result) {
  using Lanes = Pack<double>;
  const auto jet = taylor_lanes(traits, &points[first], count);
  const Lanes magnitudes =
      Lanes::generate([&](std::size_t i) { return magnitude(points[first + std::min(i, count - 1)]); });
  const Local_structure_lanes<Lanes> lanes(jet, Monge_chart_3<Lanes>(jet, magnitudes));
  for (std::size_t n = 0; n < selection.columns.size(); ++n) {
    const Lanes values = selection.columns[n].get_lanes(lanes.structure);
    for (std::size_t i = 0; i < count; ++i) result.columns[n].values[first + i] = values[i];
  }
  for (std::size_t i = 0; i < count; ++i) {
    Point_status& status = (*result.status)[first + i];
    status = Point_status::REGULAR;
    if (lanes.is_regular[i]) continue;
    const auto structure = local_structure(lane(jet, i), magnitudes[i]);
    for (std::size_t n = 0; n < selection.columns.size(); ++n)
      result.columns[n].values[first + i] = selection.columns[n].get(structure);
    status = structure.status;
  }
}

} // namespace internal

/// Attributes of points, one column per scalar, in double. One Taylor expansion of order 4 per point; the same for
/// CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit. Points are taken in packs; the numbers are those of
/// local_structure_at, bit for bit unless the compiler contracts products and sums (-ffp-contract=off).
/// `sampled_status` is empty or has one entry per point.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits>
Vertex_attributes compute_attributes(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                     const Attribute_selection& selection,
                                     std::span<const Point_status> sampled_status = {}) {
  static_assert(std::is_same_v<typename Traits::FT, double>);
  Vertex_attributes result;
  for (const Attribute& attribute : selection.columns)
    result.columns.push_back({std::string(attribute.name), std::vector<double>(points.size())});
  if (!selection.has_status) return result;
  std::vector<Point_status>& status = result.status.emplace(points.size());
  constexpr std::size_t block = Pack<double>::size;
  internal::parallel_for<ConcurrencyTag>(
      0, (points.size() + block - 1) / block,
      [&](std::size_t n) {
        const std::size_t first = n * block, count = std::min(block, points.size() - first);
        internal::compute_block_of_attributes(traits, points, first, count, selection, result);
        for (std::size_t i = first; i < first + count && !sampled_status.empty(); ++i)
          if (sampled_status[i] == Point_status::UNCONVERGED && status[i] != Point_status::OUTSIDE)
            status[i] = Point_status::UNCONVERGED;
      },
      256 / block);
  return result;
}

} // namespace equiaffine

#endif
