// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/Outputs.h"

#include <algorithm>
#include <cstddef>

namespace equiaffine {

Outputs::Outputs(const std::string& result, const Display_options& display) {
  add(Output_kind::RESULT, result);
  add_displays(display);
}

void Outputs::add(Output_kind kind, const std::optional<std::string>& path) {
  if (!path) return;
  files_.emplace_back(*path);
  kinds_.push_back(kind);
}

void Outputs::add_displays(const Display_options& options) {
  add(Output_kind::PAGE, options.html);
  add(Output_kind::PICTURE, options.png);
}

void Outputs::remove(Output_kind kind) {
  const auto found = std::find(kinds_.begin(), kinds_.end(), kind);
  if (found == kinds_.end()) return;
  files_.erase(files_.begin() + (found - kinds_.begin()));
  kinds_.erase(found);
}

Output_file* Outputs::find(Output_kind kind) {
  const auto found = std::find(kinds_.begin(), kinds_.end(), kind);
  return found == kinds_.end() ? nullptr : &files_[std::size_t(found - kinds_.begin())];
}

void Outputs::close_results() {
  for (std::size_t i = 0; i < files_.size(); ++i)
    if (kinds_[i] != Output_kind::STATISTICS) files_[i].close();
}

void Outputs::commit() { commit_all(files_); }

} // namespace equiaffine
