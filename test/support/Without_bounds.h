// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_WITHOUT_BOUNDS_H
#define EQUIAFFINE_TEST_SUPPORT_WITHOUT_BOUNDS_H

#include <equiaffine/number/Interval.h>

#include <CGAL/Bbox_3.h>

#include <utility>

/// The same function without bounds, so that Marching Cubes evaluates it at all nodes.
template <class Traits>
struct Without_bounds : Traits {
  explicit Without_bounds(Traits traits) : Traits(std::move(traits)) {}
  equiaffine::Interval bounds(const CGAL::Bbox_3&) const = delete;
};

#endif
