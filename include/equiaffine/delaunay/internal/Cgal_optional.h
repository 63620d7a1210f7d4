// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_CGAL_OPTIONAL_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_CGAL_OPTIONAL_H

#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1060000000
#include <optional>
#else
#include <boost/optional.hpp>
#endif

namespace equiaffine {

/// The optional value that CGAL's mesher takes: the standard library's since CGAL 6, Boost's before.
#if CGAL_VERSION_NR >= 1060000000
template <class T>
using Cgal_optional = std::optional<T>;
#else
template <class T>
using Cgal_optional = boost::optional<T>;
#endif

} // namespace equiaffine

#endif
