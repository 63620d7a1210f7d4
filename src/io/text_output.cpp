// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/io/internal/Ply_writer.h>
#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/io/write_CSV.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <ios>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>

namespace equiaffine {

namespace internal {

Buffered_output& Buffered_output::operator<<(double number) {
  if (std::isnan(number)) return *this << "nan";
#ifdef __cpp_lib_to_chars
  std::array<char, 32> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number + 0., std::chars_format::general, 17);
  return *this << std::string_view(digits.data(), std::size_t(end.ptr - digits.data()));
#else // for libc++ before version 14
  std::ostringstream digits;
  digits.imbue(std::locale::classic());
  digits << std::setprecision(17) << number + 0.;
  return *this << digits.str();
#endif
}

Buffered_output& Buffered_output::operator<<(std::size_t number) {
  std::array<char, 24> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return *this << std::string_view(digits.data(), std::size_t(end.ptr - digits.data()));
}

void Buffered_output::write_block(std::string_view text) {
  if (!buffer_.empty()) flush();
  Progress_observer::step();
  stream_.write(text.data(), std::streamsize(text.size()));
}

void Buffered_output::flush() {
  Progress_observer::step();
  stream_.write(buffer_.data(), std::streamsize(buffer_.size()));
  buffer_.clear();
}

void write_line(Buffered_output& out, std::string_view keyword, const std::array<double, 3>& numbers) {
  out << keyword << numbers[0] << ' ' << numbers[1] << ' ' << numbers[2] << '\n';
}

std::array<double, 3> unit_normal(const std::array<std::array<double, 3>, 3>& corners) {
  std::array<double, 3> u{}, v{}, normal{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = corners[1][i] - corners[0][i];
    v[i] = corners[2][i] - corners[0][i];
  }
  for (std::size_t i = 0; i < 3; ++i) normal[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  for (double& component : normal) component = length > 0 ? component / length : 0;
  return normal;
}

void write_CSV_names(Buffered_output& out, const Vertex_attributes& attributes, char separator) {
  for (const auto& column : attributes.columns) out << separator << column.name;
  if (attributes.status) out << separator << "status";
  out << '\n';
}

} // namespace internal

void Ply_writer::write_header(std::size_t vertices, std::size_t faces, const Vertex_attributes& layout) {
  out_ << "ply\nformat binary_little_endian 1.0\ncomment made by equiaffine";
  if (layout.status) {
    out_ << "; status:";
    for (std::size_t i = 0; i < number_of_point_statuses; ++i) out_ << ' ' << i << ' ' << to_string(Point_status(i));
  }
  for (std::string line : layout.comments) {
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    out_ << "\ncomment " << line;
  }
  out_ << "\nelement vertex " << vertices << "\nproperty double x\nproperty double y\nproperty double z\n";
  for (const auto& column : layout.columns) out_ << "property double " << column.name << '\n';
  if (layout.status) out_ << "property uchar status\n";
  out_ << "element face " << faces << "\nproperty list uchar int vertex_indices\nend_header\n";
}

} // namespace equiaffine
