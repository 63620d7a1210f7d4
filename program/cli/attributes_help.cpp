// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/attributes_help.h"

#include "attributes/estimate_names.h"
#include <equiaffine/attributes/Attribute_selection.h>

#include <cstddef>
#include <sstream>
#include <vector>

namespace equiaffine {

namespace {

template <class Names>
std::string joined(const Names& names, const std::string& separator) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : separator) + std::string(name);
  return text;
}

/// Breaks a text into as few lines as can hold its words.
std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string result, line;
  for (std::string word; words >> word;) {
    const bool is_full = !line.empty() && line.size() + 1 + word.size() > width;
    if (is_full) result += line + '\n';
    line = is_full || line.empty() ? word : line + ' ' + word;
  }
  return result + line;
}

/// The names of the estimates that are not of the error.
std::vector<std::string> estimates_of_scale() {
  std::vector<std::string> names;
  for (const auto& attribute : estimate_attributes())
    if (attribute.kind != Estimate_kind::ERROR) names.push_back(attribute.name);
  return names;
}

} // namespace

std::string attributes_of_fit_help() {
  const Attribute_names names = attribute_names();
  return wrapped("what to compute: basic (the default) is " + joined(names.basic, ", ") + ", status, " +
                     joined(error_attributes(), ", ") + "; all adds " + joined(names.added_by_all, ", ") + ", " +
                     joined(estimates_of_scale(), ", ") + "; LIST is some of these words with commas between, also " +
                     joined(names.by_name, ", "),
                 88);
}

std::string attributes_help() {
  const Attribute_names names = attribute_names();
  return wrapped("what to compute: basic (the default) is " + joined(names.basic, ", ") + ", status; all adds " +
                     joined(names.added_by_all, ", ") + "; LIST is some of these words with commas between, also " +
                     joined(names.by_name, ", ") +
                     ", signature (affine curvatures, pick_invariant, and the norms of their gradients); for a "
                     "spline affine_gaussian_curvature_error, affine_mean_curvature_error; for a fit basic also has "
                     "the estimate NAME_error of every NAME in it, and all adds " +
                     joined(estimates_of_scale(), ", "),
                 88);
}

} // namespace equiaffine
