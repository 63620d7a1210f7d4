// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/warn_of_outside.h"

#include <sstream>

namespace equiaffine {

void warn_of_outside(const Source_options& options, const Source& source, std::size_t outside, std::size_t all,
                     const std::string& points, Progress& progress) {
  if (outside == 0 || !source.spline) return;
  constexpr int least_degree = 5;
  const int degree = source.spline->degree;
  const std::size_t nodes = source.spline->least_nodes;
  std::ostringstream text;
  text << outside << " of " << all << ' ' << points << " are outside and have no attributes: ";
  if (nodes <= std::size_t(degree))
    text << "a spline of degree " << degree << " needs " << degree + 1 << " nodes along each axis, and there are "
         << nodes << " along one; " << (nodes > least_degree ? "use --spline-degree 5 or" : "give") << " more nodes";
  else if (options.narrow_band)
    text << "distances are known in the band of --narrow-band " << *options.narrow_band
         << " only; give a larger one or leave it out";
  else return;
  progress.warn(text.str());
}

} // namespace equiaffine
