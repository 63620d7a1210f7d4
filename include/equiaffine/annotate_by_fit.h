// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/annotate_by_fit.h> // IWYU pragma: export
