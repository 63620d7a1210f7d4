// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/base/Input_error.h> // IWYU pragma: export
