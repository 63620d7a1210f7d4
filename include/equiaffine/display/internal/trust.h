// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_INTERNAL_TRUST_H
#define EQUIAFFINE_DISPLAY_INTERNAL_TRUST_H

#include <equiaffine/display/color_map.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <string>
#include <vector>

/// \file
/// How far pictures trust the numbers of a column, based on the error estimates in the column NAME_error.

// These functions are compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

const Vertex_attributes::Column* find_errors(const Vertex_attributes& attributes, const std::string& name);

/// Returns whether a number is known to one digit: its estimated error is at most half of its size.
bool is_known(double size, double error);

/// Returns the reference magnitudes for the errors of a column: those of attribute_table.h, or the numbers themselves,
/// but at least twice a negligible error.
std::vector<double> sizes_of_numbers(const Vertex_attributes::Column& column, const Vertex_attributes& attributes);

/// Returns the fraction of the numbers of a column that are not known to one digit, because the estimated error
/// exceeds half of their size; 0 if there are no numbers.
double unknown_fraction(const Vertex_attributes::Column& column, const std::vector<double>& errors,
                        const Vertex_attributes& attributes);

/// Returns a warning for every column in which fewer than half of the numbers are known to one digit.
std::vector<std::string> sentences_of_doubt(const Vertex_attributes& attributes);

/// Returns whether at least half of the numbers are known to one digit. Numbers without error estimates are trusted,
/// except affine ones if other affine columns are not trusted: they depend on the same derivatives.
bool is_trusted(const Vertex_attributes::Column& column, const Vertex_attributes& attributes);

/// Returns whether a column is shown only on request: a component of a vector or of the metric, or the errors, noise,
/// or detail of another column. The error of a vector is an angle; there is no column with the name of the vector
/// itself.
bool is_component_or_error(const std::string& name, const Vertex_attributes& attributes);

/// Returns what pages and pictures show first: the attribute of the library with the lowest rank among those with
/// trusted numbers, or with any numbers if none is trusted, or another column with numbers; otherwise `status` or
/// `plain`.
std::string first_shown(const Vertex_attributes& attributes);

/// Returns how uncertain a color is: 0 if the value is exact, 1 if its error bar spans half of the color bar or more.
/// An unknown error counts as infinite.
double color_doubt(double value, double error, const Color_mapping& mapping);

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
