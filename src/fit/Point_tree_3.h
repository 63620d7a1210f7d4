// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_POINT_TREE_3_H
#define EQUIAFFINE_SRC_FIT_POINT_TREE_3_H

#include "fit/Data_points_3.h"
#include <equiaffine/base/internal/Point_tree.h>

namespace equiaffine::internal {

/// Finds the nearest of data.
using Point_tree_3 = Point_tree<3, Data_points_3::Index>;

} // namespace equiaffine::internal

#endif
