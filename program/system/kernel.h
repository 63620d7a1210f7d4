// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_KERNEL_H
#define EQUIAFFINE_PROGRAM_SYSTEM_KERNEL_H

#include <CGAL/Simple_cartesian.h>

namespace equiaffine {

/// The kernel of the program.
using Kernel = CGAL::Simple_cartesian<double>;

} // namespace equiaffine

#endif
