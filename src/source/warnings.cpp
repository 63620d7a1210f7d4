// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/warnings.h"

#include <cmath>
#include <sstream>

namespace equiaffine {

void warn_of_outside(const Source_options& options, const Source& source, std::size_t outside, std::size_t all,
                     const std::string& points, Progress& progress) {
  if (outside > 0 && source.fit)
    progress.warn(std::to_string(outside) + " of " + std::to_string(all) + ' ' + points +
                  " are outside and have no attributes: a fit has values within some two spacings of the data only");
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

void warn_of_doubt(const Fit_statistics& fit, std::size_t vertices, std::size_t parabolic, Progress& progress) {
  const auto known = std::size_t(std::llround(fit.known.back() * double(vertices)));
  if (2 * known >= vertices - parabolic) return;
  progress.warn(std::to_string(vertices - parabolic - known) + " of " + std::to_string(vertices) +
                " vertices have no fit, or an estimated error of the affine Gaussian curvature of more than 50 %: the "
                "points are too few, or their noise is too large for fourth derivatives; give more points, or a "
                "larger --scale");
}

} // namespace equiaffine
