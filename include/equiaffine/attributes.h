// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/attributes.h> // IWYU pragma: export
