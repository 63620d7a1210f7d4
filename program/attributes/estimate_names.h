// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_ATTRIBUTES_ESTIMATE_NAMES_H
#define EQUIAFFINE_PROGRAM_ATTRIBUTES_ESTIMATE_NAMES_H

#include <equiaffine/attributes/internal/error_table.h>

#include <string>
#include <vector>

namespace equiaffine {

/// What an estimate is of: the error; what noise makes; or what detail makes that a scale leaves out.
enum class Estimate_kind { ERROR, NOISE, DETAIL };

/// A column with estimates.
struct Estimate_attribute {
  std::string name;
  Estimate_kind kind;
  const Error_row<double>* row;
  bool is_of_splines; ///< whether splines have it, too, and not fits alone
};

/// All of them, in the order of the columns of a file.
const std::vector<Estimate_attribute>& estimate_attributes();

/// The names of the columns with estimates of errors.
std::vector<std::string> error_attributes();

} // namespace equiaffine

#endif
