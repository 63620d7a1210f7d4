// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/check_delaunay_surface.h"

#include <equiaffine/Input_error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace equiaffine {

namespace {

double greatest_coordinate(const CGAL::Bbox_3& box) {
  double greatest = 0;
  for (int a = 0; a < 3; ++a) greatest = std::max({greatest, std::abs(box.min(a)), std::abs(box.max(a))});
  return greatest;
}

} // namespace

void check_box_of_delaunay_surface(const CGAL::Bbox_3& box, double diagonal) {
  constexpr double least = 1e-40, greatest = 1e40;
  const double farthest = std::max(diagonal, greatest_coordinate(box));
  if (diagonal >= least && farthest <= greatest) return;
  std::ostringstream text;
  text << "the box of the function has the diagonal " << diagonal << ", and coordinates to " << farthest
       << "; --method delaunay works with numbers from " << least << " to " << greatest << ": choose another unit";
  throw Input_error(text.str());
}

void check_radius_of_delaunay_surface(const CGAL::Bbox_3& box, double radius) {
  const double farthest = greatest_coordinate(box);
  const double least = 1024 * std::numeric_limits<double>::epsilon() * farthest;
  if (radius >= least) return;
  std::ostringstream text;
  text << "a radius of " << radius << " is too small beside coordinates to " << farthest << ", which takes " << least
       << ": choose a larger --radius, or an origin nearer to the box";
  throw Input_error(text.str());
}

} // namespace equiaffine
