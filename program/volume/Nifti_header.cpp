// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/Nifti_header.h"

#include "volume/Shared_volume.h"
#include "volume/header_text.h"
#include "volume/volume_formats.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace equiaffine {

namespace {

constexpr std::int32_t size_of_nifti_header = 348;

/// The minimum offset of the data in a file with the header, and the maximum, beyond which a float is not exact.
constexpr double first_place_of_data = 352, last_place_of_data = 1 << 24;

/// The offsets of fields in the header, in bytes.
enum Place : std::size_t {
  DIM = 40,
  DATATYPE = 70,
  BITPIX = 72,
  PIXDIM = 76,
  VOX_OFFSET = 108,
  SCALING = 112,
  UNITS = 123,
  QFORM = 252,
  SFORM = 254,
  QUATERNION = 256,
  SROW = 280,
  MAGIC = 344
};

constexpr std::int16_t code_of_scanner = 1;

} // namespace

struct Nifti_header::Datatype {
  std::int16_t code;
  std::size_t type; ///< a position in raw_types
  std::size_t side_by_side;
  bool is_color = false; ///< colors are never scaled

  std::size_t bits() const { return 8 * size_of_sample(type) * side_by_side; }
};

Nifti_header::Nifti_header(const std::string& path) : path_(path), bytes_(beginning_of(path, size_of_nifti_header)) {
  if (bytes_.size() < size_of_nifti_header) fail_to_read_volume_data(path);
  is_swapped_ = number<std::int32_t>(0) != size_of_nifti_header;
  if (number<std::int32_t>(0) != size_of_nifti_header)
    fail_at("sizeof_hdr", number<std::int32_t>(0), "convert it to NIfTI-1, with 348 there");
}

template <class Number>
Number Nifti_header::number(std::size_t place, std::size_t index) const {
  std::array<char, sizeof(Number)> bytes;
  std::copy_n(bytes_.begin() + std::ptrdiff_t(place + index * sizeof(Number)), bytes.size(), bytes.begin());
  if (is_swapped_) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<Number>(bytes);
}

bool Nifti_header::is_single_file() const { return bytes_.compare(MAGIC, 3, "n+1") == 0; }

std::size_t Nifti_header::size(std::size_t axis) const {
  const std::int16_t axes = number<std::int16_t>(DIM);
  if (axes < 1 || axes > 7) fail_at("dim[0]", axes, "correct it to the number of axes");
  if (axis > std::size_t(axes)) return 1;
  const std::int16_t size = number<std::int16_t>(DIM, axis);
  if (size < 1) fail_at("dim[" + std::to_string(axis) + "]", size, "correct it to a number of nodes");
  return std::size_t(size);
}

/// The types of NIfTI-1 except single bits and numbers of 128 bits. A number of bits that does not match the type shows
/// that one of the two fields is damaged.
Nifti_header::Datatype Nifti_header::datatype() const {
  constexpr std::size_t byte = integer_sample_type(1, false), single = floating_sample_type(4),
                        twice = floating_sample_type(8);
  constexpr std::array datatypes = {Datatype{2, byte, 1},
                                    Datatype{4, integer_sample_type(2, true), 1},
                                    Datatype{8, integer_sample_type(4, true), 1},
                                    Datatype{16, single, 1},
                                    Datatype{32, single, 2},
                                    Datatype{64, twice, 1},
                                    Datatype{128, byte, 3, true},
                                    Datatype{256, integer_sample_type(1, true), 1},
                                    Datatype{512, integer_sample_type(2, false), 1},
                                    Datatype{768, integer_sample_type(4, false), 1},
                                    Datatype{1024, integer_sample_type(8, true), 1},
                                    Datatype{1280, integer_sample_type(8, false), 1},
                                    Datatype{1792, twice, 2},
                                    Datatype{2304, byte, 4, true}};
  const auto code = number<std::int16_t>(DATATYPE), bits = number<std::int16_t>(BITPIX);
  const auto* const found =
      std::find_if(datatypes.begin(), datatypes.end(), [code](const Datatype& type) { return type.code == code; });
  if (found == datatypes.end()) fail_to_read_volume_type(path_);
  if (bits < 0 || std::size_t(bits) != found->bits())
    fail_at("bitpix", bits,
            "correct it to " + std::to_string(found->bits()) + ", the number of bits of its datatype " +
                std::to_string(code) + ", or correct the datatype");
  return *found;
}

std::size_t Nifti_header::sample_type() const { return datatype().type; }

std::size_t Nifti_header::numbers_side_by_side() const { return datatype().side_by_side; }

std::size_t Nifti_header::first_byte() const {
  const double offset = number<float>(VOX_OFFSET), least = is_single_file() ? first_place_of_data : 0;
  if (!(offset >= least && offset <= last_place_of_data))
    fail_at("vox_offset", offset, "correct it to the number of bytes before the data, usually 352");
  return std::size_t(offset);
}

double Nifti_header::size_of_file() const {
  double nodes = 1;
  for (std::size_t axis = 1; axis <= 7; ++axis) nodes *= double(size(axis));
  return double(first_byte()) + nodes * double(datatype().bits()) / 8;
}

std::optional<std::array<double, 2>> Nifti_header::scaling() const {
  const double slope = number<float>(SCALING), intercept = number<float>(SCALING, 1);
  if (slope == 0 || !std::isfinite(slope) || datatype().is_color) return std::nullopt;
  if (!std::isfinite(intercept)) fail_at("scl_inter", intercept, "correct it to a finite number");
  if (slope == 1 && intercept == 0) return std::nullopt;
  return std::array{slope, intercept};
}

std::array<std::array<double, 4>, 3> Nifti_header::sform() const {
  std::array<std::array<double, 4>, 3> matrix;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      matrix[row][column] = number<float>(SROW, 4 * row + column);
      if (!std::isfinite(matrix[row][column]))
        fail_at("the number in srow", matrix[row][column], "correct it to a finite number");
    }
  constexpr double largest_ratio = 1e6; // of steps, still resolved in single precision
  std::array<double, 3> steps;
  for (std::size_t column = 0; column < 3; ++column)
    steps[column] = std::hypot(matrix[0][column], matrix[1][column], matrix[2][column]);
  const auto [shortest, longest] = std::minmax_element(steps.begin(), steps.end());
  if (!(*longest <= largest_ratio * *shortest))
    fail_at("the step in srow", *longest, "correct it: the shortest step is less than a millionth of it");
  return matrix;
}

std::array<std::array<double, 4>, 3> Nifti_header::qform() const {
  std::array<double, 6> q;
  for (std::size_t i = 0; i < q.size(); ++i)
    if (q[i] = number<float>(QUATERNION, i); !std::isfinite(q[i]))
      fail_at("the number in quatern or qoffset", q[i], "correct it to a finite number");
  auto [b, c, d, x, y, z] = q;
  constexpr double half_a_turn = 1e-7; // near half a turn, the first number vanishes up to rounding
  double a = 1 - (b * b + c * c + d * d);
  if (a < half_a_turn) {
    const double length = std::hypot(b, c, d);
    a = 0, b /= length, c /= length, d /= length;
  } else a = std::sqrt(a);
  const double along_x = number<float>(PIXDIM, 1), along_y = number<float>(PIXDIM, 2),
               along_z = number<float>(PIXDIM, 0) < 0 ? -number<float>(PIXDIM, 3) : number<float>(PIXDIM, 3);
  return {
      {{(a * a + b * b - c * c - d * d) * along_x, 2 * (b * c - a * d) * along_y, 2 * (b * d + a * c) * along_z, x},
       {2 * (b * c + a * d) * along_x, (a * a + c * c - b * b - d * d) * along_y, 2 * (c * d - a * b) * along_z, y},
       {2 * (b * d - a * c) * along_x, 2 * (c * d + a * b) * along_y, (a * a + d * d - b * b - c * c) * along_z, z}}};
}

Lattice_3<Kernel> Nifti_header::lattice() const {
  for (std::size_t axis = 1; axis <= 3; ++axis)
    if (const double step = number<float>(PIXDIM, axis); !(step > 0 && std::isfinite(step)))
      fail_at("pixdim[" + std::to_string(axis) + "]", step, "correct it to the distance between nodes");
  const auto code_of_qform = number<std::int16_t>(QFORM), code_of_sform = number<std::int16_t>(SFORM);
  const bool prefers_sform = code_of_sform > 0 && (code_of_qform <= 0 || code_of_sform == code_of_scanner);
  constexpr int mask_of_length = 7, meters = 1, micrometers = 3;
  const int units = bytes_[UNITS] & mask_of_length;
  const double unit = units == meters ? 1e3 : units == micrometers ? 1e-3 : 1;
  std::array<std::array<double, 4>, 3> matrix{};
  for (std::size_t axis = 0; axis < 3; ++axis) matrix[axis][axis] = number<float>(PIXDIM, axis + 1);
  if (code_of_qform > 0) matrix = qform();
  if (code_of_sform > 0)
    if (const auto other = sform(); prefers_sform) matrix = other; // check both
  const double sign = prefers_sform || code_of_qform > 0 ? -1 : 1; // NIfTI's x and y point in the opposite directions
  const auto column = [&](std::size_t c) {
    return unit * Kernel::Vector_3(sign * matrix[0][c], sign * matrix[1][c], matrix[2][c]);
  };
  return make_lattice(path_, {size(1), size(2), size(3)}, CGAL::ORIGIN + column(3), {column(0), column(1), column(2)},
                      size_of_sample(datatype().type));
}

void Nifti_header::fail_at(const std::string& field, double content, const std::string& advice) const {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", content);
  fail_at_field(path_, field, text.data(), advice);
}

} // namespace equiaffine
