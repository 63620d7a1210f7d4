// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/annotate.h> // IWYU pragma: export
