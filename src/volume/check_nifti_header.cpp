// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/header_checks.h"
#include "volume/header_text.h"
#include "volume/volume_formats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

namespace equiaffine {

namespace {

constexpr std::int32_t size_of_nifti_header = 348;

/// The least place of the data in a file that has the header, too.
constexpr double first_place_of_data = 352;

/// The places of fields in the header, in bytes.
enum Place : std::size_t {
  DIM = 40,
  DATATYPE = 70,
  BITPIX = 72,
  PIXDIM = 76,
  VOX_OFFSET = 108,
  QFORM = 252,
  QUATERNION = 256,
  SROW = 280,
  MAGIC = 344
};

struct Datatype {
  std::int16_t code, bits;
};

/// The types of NIfTI-1 but single bits and numbers of 128 bits. RGB and complex numbers are here since ITK reads them.
constexpr std::array datatypes = {Datatype{2, 8},      Datatype{4, 16},   Datatype{8, 32},    Datatype{16, 32},
                                  Datatype{32, 64},    Datatype{64, 64},  Datatype{128, 24},  Datatype{256, 8},
                                  Datatype{512, 16},   Datatype{768, 32}, Datatype{1024, 64}, Datatype{1280, 64},
                                  Datatype{1792, 128}, Datatype{2304, 32}};

/// The header of a NIfTI-1 file, which begins with its own length in the byte order of the file.
class Nifti_header {
public:
  explicit Nifti_header(const std::string& path) : path_(path), bytes_(beginning_of(path, size_of_nifti_header)) {
    if (bytes_.size() < size_of_nifti_header) fail_to_read_volume_data(path);
    is_swapped_ = number<std::int32_t>(0) != size_of_nifti_header;
    if (number<std::int32_t>(0) != size_of_nifti_header)
      fail_at("sizeof_hdr", number<std::int32_t>(0), "convert it to NIfTI-1, where that is 348");
  }

  void check_frame() const {
    const double offset = number<float>(VOX_OFFSET), least = is_single_file() ? first_place_of_data : 0;
    if (!(offset >= least && std::isfinite(offset)))
      fail_at("vox_offset", offset, "correct it to the number of bytes before the data, usually 352");
    for (std::size_t axis = 1; axis <= 3; ++axis)
      if (const double step = number<float>(PIXDIM, axis); !(step > 0 && std::isfinite(step)))
        fail_at("pixdim[" + std::to_string(axis) + "]", step, "correct it to the distance of two nodes");
    if (number<std::int16_t>(QFORM) > 0)
      for (std::size_t i = 0; i < 6; ++i)
        if (!std::isfinite(number<float>(QUATERNION, i)))
          fail_at("a number in quatern or qoffset of", number<float>(QUATERNION, i), "correct it to a finite number");
    if (number<std::int16_t>(QFORM, 1) > 0) check_matrix();
  }

  /// The bytes from the beginning of the file to the end of the data.
  double size_of_file() const {
    const std::int16_t axes = number<std::int16_t>(DIM);
    if (axes < 1 || axes > 7) fail_at("dim[0]", axes, "correct it to the number of axes");
    double nodes = 1;
    for (std::size_t axis = 1; axis <= std::size_t(axes); ++axis) {
      const std::int16_t size = number<std::int16_t>(DIM, axis);
      if (size < 1) fail_at("dim[" + std::to_string(axis) + "]", size, "correct it to a number of nodes");
      nodes *= size;
    }
    return double(number<float>(VOX_OFFSET)) + nodes * bits_per_sample() / 8;
  }

private:
  bool is_single_file() const { return bytes_.compare(MAGIC, 3, "n+1") == 0; }

  /// niftilib goes by the type of numbers alone, so that another number of bits shows that one of them is damaged.
  std::int16_t bits_per_sample() const {
    const auto code = number<std::int16_t>(DATATYPE), bits = number<std::int16_t>(BITPIX);
    const auto* const type = std::find_if(datatypes.begin(), datatypes.end(),
                                          [code](const Datatype& datatype) { return datatype.code == code; });
    if (type == datatypes.end()) fail_to_read_volume_type(path_);
    if (bits != type->bits)
      fail_at("bitpix", bits,
              "correct it to " + std::to_string(type->bits) + ", which is that of its datatype " +
                  std::to_string(code) + ", or correct the datatype");
    return bits;
  }

  template <class Number>
  Number number(std::size_t place, std::size_t index = 0) const {
    std::array<char, sizeof(Number)> bytes;
    std::copy_n(bytes_.begin() + std::ptrdiff_t(place + index * sizeof(Number)), bytes.size(), bytes.begin());
    if (is_swapped_) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
  }

  /// niftilib takes the matrix apart in single precision, by an iteration that overflows for very unequal steps.
  void check_matrix() const {
    constexpr double largest_ratio = 1e6; // that single precision can still tell
    double shortest = HUGE_VAL, longest = 0;
    for (std::size_t column = 0; column < 3; ++column) {
      const double step =
          std::hypot(number<float>(SROW, column), number<float>(SROW, 4 + column), number<float>(SROW, 8 + column));
      if (!(step > 0 && std::isfinite(step))) fail_at("a step in srow of", step, "correct it to a finite length");
      shortest = std::min(shortest, step);
      longest = std::max(longest, step);
    }
    if (longest > largest_ratio * shortest)
      fail_at("a step in srow of", longest, "correct it, the shortest one is a million times smaller");
    for (std::size_t row = 0; row < 3; ++row)
      if (!std::isfinite(number<float>(SROW, 4 * row + 3)))
        fail_at("an offset in srow of", number<float>(SROW, 4 * row + 3), "correct it to a finite number");
  }

  [[noreturn]] void fail_at(const std::string& field, double content, const std::string& advice) const {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", content);
    fail_at_field(path_, field, text.data(), advice);
  }

  std::string path_, bytes_;
  bool is_swapped_ = false;
};

} // namespace

void check_nifti_header(const std::string& path) {
  const Nifti_header header(path);
  header.check_frame();
  const double expected = header.size_of_file();
  // ITK's NIfTI reader says nothing when a file ends early.
  std::error_code error;
  const std::optional<double> size =
      is_gzip(path) ? decompressed_size(path) : double(std::filesystem::file_size(path, error));
  if (error || !size || *size < expected) fail_to_read_volume_data(path);
}

} // namespace equiaffine
