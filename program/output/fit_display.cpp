// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/fit_display.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace equiaffine {

namespace {

constexpr const char *scale_label = "Scale", *own_scale = "none: the curvatures are the surface's own",
                     *noise_label = "Noise", *parabolic_label = "Parabolic",
                     *known_label = "Known to 20 / 50 % at so many %", *errors_label = "Errors";
constexpr std::array<std::string_view, 4> labels = {scale_label, noise_label, parabolic_label, known_label};
constexpr std::size_t longest_value = 200;
constexpr std::string_view begin_of_comment = "fit ", end_of_label = ": ";

bool has_errors(const Vertex_attributes& attributes) {
  return std::any_of(attributes.columns.begin(), attributes.columns.end(),
                     [](const auto& column) { return column.name.ends_with("_error"); });
}

} // namespace

Description description_of(const Fit_statistics& fit) {
  Description rows = {{scale_label, fit.scale ? number_text(*fit.scale, 3) : own_scale},
                      {noise_label, number_text(fit.noise, 2)}};
  if (const auto percent = std::lround(100 * fit.parabolic); percent > 0)
    rows.emplace_back(parabolic_label, std::to_string(percent) + " % of the vertices");
  rows.emplace_back(known_label, table_of_known(fit));
  return rows;
}

std::vector<std::string> comments_of(const Fit_statistics& statistics) {
  if (!std::isfinite(statistics.noise)) return {}; // nothing was fitted
  const Description fit = description_of(statistics);
  std::vector<std::string> comments;
  for (const auto& [label, value] : fit)
    comments.push_back((std::string(begin_of_comment) + label).append(end_of_label) + value);
  return comments;
}

Description description_of_fit(const Vertex_attributes& attributes) {
  Description fit;
  for (const std::string_view comment : attributes.comments) {
    const std::size_t colon = comment.find(end_of_label);
    if (!comment.starts_with(begin_of_comment) || colon == std::string_view::npos) continue;
    const std::string_view label = comment.substr(begin_of_comment.size(), colon - begin_of_comment.size());
    const std::string_view value = comment.substr(colon + end_of_label.size());
    const bool is_known = std::find(labels.begin(), labels.end(), label) != labels.end();
    const bool is_new = std::none_of(fit.begin(), fit.end(), [&](const auto& row) { return row.first == label; });
    if (is_known && is_new && value.size() < longest_value) fit.emplace_back(label, value);
  }
  if (!fit.empty() && !has_errors(attributes))
    fit.emplace_back(errors_label,
                     "lost: the file has no column NAME_error, so that the colors do not tell what is known");
  return fit;
}

std::string label_suffix(const Description& fit) {
  for (const auto& [label, value] : fit)
    if (label == scale_label && std::strtod(value.c_str(), nullptr) > 0) return " at scale " + value;
  return {};
}

std::vector<Surface_note> notes_of(const Description& fit) {
  std::string text;
  for (const auto& [label, value] : fit)
    if (label != scale_label) text += (text.empty() ? "" : "; ") + label + ": " + value;
  if (text.empty()) return {};
  return {{std::nullopt, text}};
}

} // namespace equiaffine
