// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_WRITE_CURVES_H
#define EQUIAFFINE_IO_WRITE_CURVES_H

#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <CGAL/number_utils.h>

#include <cstddef>
#include <ostream>

namespace equiaffine {

/// Writes OBJ: the points of the curves with 17 significant digits, and one `l` line per curve. The line of a closed
/// curve ends with its first point.
template <class Kernel>
void write_OBJ(std::ostream& stream, const Parabolic_curves_3<Kernel>& curves) {
  internal::Buffered_output out(stream);
  for (const auto& line : curves.polylines)
    for (const auto& p : line.points)
      out << "v " << CGAL::to_double(p.x()) << ' ' << CGAL::to_double(p.y()) << ' ' << CGAL::to_double(p.z()) << '\n';
  std::size_t next = 1;
  for (const auto& line : curves.polylines) {
    const std::size_t first = next;
    out << 'l';
    for (; next < first + line.points.size(); ++next) out << ' ' << next;
    if (line.is_closed) out << ' ' << first;
    out << '\n';
  }
  out.flush();
}

} // namespace equiaffine

#endif
