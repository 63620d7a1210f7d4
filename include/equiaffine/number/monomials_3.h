// SPDX-License-Identifier: GPL-3.0-or-later
// The monomials of total degree <= 4 in three variables in the order in which Jet_3 keeps coefficients, and sets of
// them: monomial_index, number_of_monomials and others, all in equiaffine::internal.
#ifndef EQUIAFFINE_NUMBER_MONOMIALS_3_H
#define EQUIAFFINE_NUMBER_MONOMIALS_3_H

#include <equiaffine/number/internal/monomials_3.h> // IWYU pragma: export

#endif
