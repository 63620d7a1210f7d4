// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_INTERNAL_TRUST_H
#define EQUIAFFINE_DISPLAY_INTERNAL_TRUST_H

#include <equiaffine/display/color_map.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <string>
#include <vector>

/// \file
/// How far pictures trust the numbers of a column: the column NAME_error has estimates of the errors of those in NAME.

// The library defines these functions.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

const Vertex_attributes::Column* find_errors(const Vertex_attributes& attributes, const std::string& name);

/// Returns whether a number is known to one digit: the estimated error is at most half of the size of the number.
bool is_known(double size, double error);

/// Returns the reference magnitudes for the errors of a column: those of attribute_table.h, or the numbers themselves,
/// but at least twice a negligible error.
std::vector<double> sizes_of_numbers(const Vertex_attributes::Column& column, const Vertex_attributes& attributes);

/// Returns the part of the numbers of a column that are not known to one digit: the estimated error is more than half
/// of the size of the number. It is 0 without numbers.
double part_in_doubt(const Vertex_attributes::Column& column, const std::vector<double>& errors,
                     const Vertex_attributes& attributes);

/// Returns a sentence for every column of which less than half of the numbers are known to one digit.
std::vector<std::string> sentences_of_doubt(const Vertex_attributes& attributes);

/// Returns whether at least half of the numbers are known to one digit. Numbers without estimates are trusted, unless
/// they are affine ones beside others that are not: they are made of the same derivatives.
bool is_trusted(const Vertex_attributes::Column& column, const Vertex_attributes& attributes);

/// Returns whether a column is shown on request only: a component of a vector or of the metric, errors, or what noise
/// or detail make of numbers. The error of a vector, an angle, has no column of that name beside it.
bool is_component_or_error(const std::string& name, const Vertex_attributes& attributes);

/// Returns what pages and pictures show first: of our attributes with numbers that are trusted the one of the least
/// rank, or of all with numbers if none is trusted, or another column with numbers; else `status` or `plain`.
std::string first_shown(const Vertex_attributes& attributes);

/// Returns how little the color of a number says, from 0 for an exact one to 1 if the numbers within the error take
/// half of the color bar or more. An error that is not known is infinite.
double color_doubt(double value, double error, const Color_mapping& mapping);

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
