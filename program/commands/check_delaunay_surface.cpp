// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/check_delaunay_surface.h"

#include <equiaffine/base/Input_error.h>
#include <equiaffine/delaunay/internal/Delaunay_range.h>

#include <algorithm>
#include <sstream>

namespace equiaffine {

void check_box_of_delaunay_surface(const CGAL::Bbox_3& box) {
  const Delaunay_range range(box);
  if (range.has_box()) return;
  std::ostringstream text;
  text << "the box of the function has the diagonal " << range.diagonal() << ", and coordinates to "
       << std::max(range.diagonal(), range.greatest_coordinate()) << "; --method delaunay works with numbers from "
       << Delaunay_range::least << " to " << Delaunay_range::greatest << ": choose another unit";
  throw Input_error(text.str());
}

void check_radius_of_delaunay_surface(const CGAL::Bbox_3& box, double radius) {
  const Delaunay_range range(box);
  if (radius >= range.least_radius()) return;
  std::ostringstream text;
  text << "a radius of " << radius << " is too small beside coordinates to " << range.greatest_coordinate()
       << ", which takes " << range.least_radius() << ": choose a larger --radius, or an origin nearer to the box";
  throw Input_error(text.str());
}

} // namespace equiaffine
