// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/Shared_volume.h"
#include "volume/header_text.h"
#include "volume/volume_formats.h"

#include <CGAL/Image_3.h>

#include <algorithm>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace equiaffine {

namespace {

constexpr std::string_view magic = "#INRIMAGE-4#{", end_of_header = "##}\n";

/// The fields of the header: lines NAME=CONTENT.
std::map<std::string_view, std::string_view> fields_of(std::string_view header) {
  std::map<std::string_view, std::string_view> fields;
  while (!header.empty()) {
    const std::string_view line = header.substr(0, header.find('\n'));
    header.remove_prefix(std::min(line.size() + 1, header.size()));
    if (const std::size_t equals = line.find('='); equals != std::string_view::npos) {
      std::string_view content = line.substr(equals + 1);
      content = content.substr(0, content.find_last_not_of(" \r") + 1);
      fields[line.substr(0, equals)] = content;
    }
  }
  return fields;
}

class Inr_header {
public:
  Inr_header(const std::string& path, std::string_view header) : path_(path), fields_(fields_of(header)) {}

  Lattice_3<Kernel>::Size number_of_nodes() const { return {positive("XDIM"), positive("YDIM"), positive("ZDIM")}; }

  /// The bytes of all samples, according to the header.
  double size_of_data() const {
    double size = double(positive("PIXSIZE")) / 8;
    for (const std::size_t nodes : number_of_nodes()) size *= double(nodes);
    return fields_.contains("VDIM") ? size * double(positive("VDIM")) : size;
  }

  void check_words() const {
    check_word("TYPE", {"float", "unsigned fixed", "signed fixed"});
    if (fields_.at("TYPE") == "float") check_word("PIXSIZE", {"32 bits", "64 bits"});
    else check_word("PIXSIZE", {"8 bits", "16 bits", "32 bits", "64 bits"});
    check_word("CPU", {"decm", "alpha", "pc", "sun", "sgi"});
  }

  void check_numbers() const {
    for (const auto& [field, content] : fields_) {
      const bool is_axis = field.size() == 2 && field[1] >= 'X' && field[1] <= 'Z';
      const bool is_spacing = is_axis && field[0] == 'V';
      if (!is_spacing && !(is_axis && (field[0] == 'T' || field[0] == 'R'))) continue;
      const std::optional<double> number = to_number(content);
      if (is_spacing && !(number && *number > 0)) fail_at_field(path_, field, content, "write a positive number");
      if (!number) fail_at_field(path_, field, content, "write a finite number");
    }
  }

private:
  std::string_view content_of(std::string_view field, const std::string& expected) const {
    const auto found = fields_.find(field);
    if (found == fields_.end())
      fail_to_read_volume(path_, "its header has no " + std::string(field), "add one: " + expected);
    return found->second;
  }

  std::size_t positive(std::string_view field) const {
    const std::string_view content = content_of(field, "a positive integer");
    const std::optional<long long> number = to_integer(content.substr(0, content.find(' ')), 1, INT_MAX);
    if (!number) fail_at_field(path_, field, content, "write a positive integer");
    return std::size_t(*number);
  }

  void check_word(std::string_view field, std::initializer_list<std::string_view> words) const {
    std::string list;
    for (const std::string_view word : words) list.append(list.empty() ? "" : " or ").append(word);
    const std::string_view content = content_of(field, list);
    if (std::find(words.begin(), words.end(), content) == words.end())
      fail_at_field(path_, field, content, "write " + list);
  }

  std::string path_;
  std::map<std::string_view, std::string_view> fields_;
};

std::size_t sample_type_of(const CGAL::Image_3& image) {
  using namespace CGAL; // for the constants, which are global in CGAL 5
  const auto& header = *image.image();
  return header.wordKind == WK_FLOAT ? floating_sample_type(header.wdim)
                                     : integer_sample_type(header.wdim, header.sign == SGN_SIGNED);
}

} // namespace

void check_inr_header(const std::string& path) {
  constexpr std::size_t header_size = 1 << 16;
  const std::string beginning = beginning_of(path, header_size);
  const std::size_t end = beginning.find(end_of_header);
  if (!beginning.starts_with(magic) || end == std::string::npos)
    fail_to_read_volume(path,
                        "it is not a complete INRIMAGE-4 file: its header does not begin with " + std::string(magic) +
                            " or does not end with ##}",
                        "get the complete file again");
  const Inr_header header(path, std::string_view(beginning).substr(0, end));
  header.check_words();
  header.check_numbers();
  const double expected = header.size_of_data();
  const std::optional<double> size = decompressed_size(path);
  if (!size || *size - double(end + end_of_header.size()) < expected)
    fail_to_read_volume(path,
                        "it is not a complete INRIMAGE-4 file: its data have less than " +
                            std::to_string(std::uint64_t(expected)) +
                            " bytes, the product of XDIM, YDIM, ZDIM, "
                            "VDIM and PIXSIZE",
                        "get the complete file again or correct these fields");
  if (const double length = *size - double(end + end_of_header.size()); length > expected)
    fail_to_read_volume(path,
                        "its data have " + std::to_string(std::uint64_t(length)) +
                            " bytes, but the product of "
                            "XDIM, YDIM, ZDIM, VDIM and PIXSIZE is " +
                            std::to_string(std::uint64_t(expected)),
                        "correct these fields");
  admit_nodes(path, header.number_of_nodes());
}

void read_inr_volume(const std::string& path, const Volume_selection& selection, Shared_volume& volume) {
  check_inr_header(path);
  CGAL::Image_3 image;
  bool has_been_read = false;
  {
    const Captured_standard_error standard_error;
    has_been_read = image.read(path);
  }
  if (!has_been_read) fail_to_read_volume(path, "it is not a complete INRIMAGE-4 file", "get the complete file again");
  const auto& header = *image.image();
  if (header.rx != 0 || header.ry != 0 || header.rz != 0)
    fail_to_read_volume(path, "its axes are rotated (RX, RY, RZ), which readers of .inr ignore",
                        "convert it to .nrrd or .mha");
  const Lattice_3<Kernel> lattice = make_lattice(
      path, {header.xdim, header.ydim, header.zdim}, Kernel::Point_3(header.tx, header.ty, header.tz),
      {Kernel::Vector_3(header.vx, 0, 0), Kernel::Vector_3(0, header.vy, 0), Kernel::Vector_3(0, 0, header.vz)});
  chosen_time(path, selection, 1);
  const std::size_t type = sample_type_of(image);
  copy_samples(type, image.data(), chosen_component(path, selection, header.vdim), header.vdim,
               lattice.number_of_nodes(), volume.allocate(lattice, type));
}

} // namespace equiaffine
