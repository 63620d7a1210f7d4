// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/function/capabilities.h> // IWYU pragma: export
