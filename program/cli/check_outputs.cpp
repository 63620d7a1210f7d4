// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/check_outputs.h"

#include "cli/formula_file.h"
#include "volume/volume_io.h"
#include <equiaffine/base/Input_error.h>

#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

namespace equiaffine {

namespace {

/// Makes names of the same file equal, whatever links and dots lead there.
std::filesystem::path canonical_path(const std::string& path) {
  if (path == "-") return path;
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error),
                              canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : canonical;
}

/// Whether two paths lead to the same file, by symbolic or hard links, too.
bool are_same_file(const std::string& path, const std::string& other) {
  std::error_code error;
  return canonical_path(path) == canonical_path(other) || std::filesystem::equivalent(path, other, error);
}

} // namespace

std::vector<std::string> input_files(const Option_reader& reader) {
  std::vector<std::string> files;
  for (const char* option :
       {"FILE", "--volume", "--distance-to", "--fit", "--points", "--range-of", "MESH.ply", "MESH"})
    if (reader.has(option)) files.push_back(reader.word(option));
  if (const Source_options& source = reader.draft().source; source.kind == Source_kind::VOLUME && !source.raw)
    for (std::string& file : files_read_with(source.text)) files.push_back(std::move(file));
  if (reader.has("--function"))
    if (const auto file = formula_file(reader.word("--function"))) files.push_back(*file);
  return files;
}

void check_outputs(const std::vector<std::string>& inputs, const std::vector<std::optional<std::string>>& outputs) {
  std::set<std::filesystem::path> paths;
  for (const auto& path : outputs) {
    if (!path) continue;
    if (!paths.insert(canonical_path(*path)).second)
      throw Input_error("two outputs go to " + (path == "-" ? "standard output" : "'" + *path + "'") +
                        "; give each its own name");
    for (const std::string& input : inputs)
      if (path != "-" && input != "-" && are_same_file(*path, input))
        throw Input_error("the output '" + *path + "' would replace the file that is read; give it another name");
  }
}

void need_output(const Option_reader& reader) { reader.need("--output", "name the file to write, -o FILE"); }

void refuse_picture_options(const Option_reader& reader) {
  if (!reader.has("--png"))
    reader.refuse({"--size", "--arrows"}, "it is for the picture of --png", "add --png or leave it out");
}

void refuse_page_options(const Option_reader& reader) {
  if (!reader.has("--html") && !reader.has("--png"))
    reader.refuse({"--color", "--up", "--colors", "--range", "--range-of"},
                  "it is for the page of --html and the picture of --png", "add one of them or leave it out");
}

} // namespace equiaffine
