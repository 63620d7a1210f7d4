// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a source: its kind, how to read it, and how to make it a function.
#ifndef EQUIAFFINE_PROGRAM_REQUEST_SOURCE_OPTIONS_H
#define EQUIAFFINE_PROGRAM_REQUEST_SOURCE_OPTIONS_H

#include "system/kernel.h"
#include "system/memory_limit.h"
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_options.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace equiaffine {

/// The types of samples in a file without a header.
inline constexpr std::array<std::string_view, 10> raw_types = {"uint8", "int8",   "uint16", "int16", "uint32",
                                                               "int32", "uint64", "int64",  "float", "double"};

/// What a header would contain, for a file of samples without one.
struct Raw_layout {
  std::array<std::size_t, 3> dims = {};
  std::array<double, 3> spacing = {1, 1, 1}, origin = {0, 0, 0};
  std::size_t type = 0; ///< the position in raw_types
};

/// What to read from a volume file with a header.
struct Volume_selection {
  std::optional<std::size_t> component = {}, time = {}; ///< of a node's values, and of a 4D file, counted from 1
  bool allow_outside = false;                           ///< whether a header may name files outside of its folder
};

enum class Source_kind { FUNCTION, VOLUME, DISTANCE, FIT };

/// Where derivatives come from: the formula or the fit itself, or a spline through samples.
enum class Derivatives { JETS, SPLINE };

/// SOURCE of the command line, with the options that change the function.
struct Source_options {
  Source_kind kind = Source_kind::FUNCTION;
  std::string text; ///< the expression, or the path of the volume, mesh or points
  std::map<std::string, double> constants;
  double level = 0; ///< the surface is the level set f = level
  std::optional<CGAL::Bbox_3> box;
  std::optional<std::array<std::size_t, 3>> resolution;
  Derivatives derivatives = Derivatives::JETS;
  Volume_options spline;
  Fit_options fit;
  bool estimates_errors = false; ///< whether the errors of affine curvatures are estimated
  bool is_registered = false;    ///< allow few data, and also make the unsmoothed spline that registration needs
  std::optional<Raw_layout> raw; ///< set for a volume without a header
  Volume_selection selection;    ///< for a volume with a header
  Memory_use memory_use = Memory_use::HALF;
  std::optional<double> narrow_band; ///< the distance in voxels beyond which distances are not needed
  std::optional<CGAL::Aff_transformation_3<Kernel>> transformation;
  /// If set, these return data in memory: then `text` is only their name, and no file is read.
  std::function<Volume_view_3<Kernel>()> volume;
  std::function<Annotated_mesh_3<Kernel>()> data;
};

} // namespace equiaffine

#endif
