// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BENCHMARK_USER_SURFACE_H
#define EQUIAFFINE_BENCHMARK_USER_SURFACE_H

#include <equiaffine/attributes/attributes.h>
#include <equiaffine/function/Analytic_function_traits_3.h>

#include <CGAL/Simple_cartesian.h>

/// The function of the programs in this folder.
struct Surface {
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    const auto r2 = x * x + y * y;
    const auto q = r2 * z + x * z;
    return q * q + exp(z) - 1.0;
  }
};

using Kernel = CGAL::Simple_cartesian<double>;
using Traits = equiaffine::Analytic_function_traits_3<Kernel, Surface>;

inline Traits surface_traits() { return {Surface(), CGAL::Bbox_3(-2, -2, -2, 2, 2, 2)}; }

#endif
