// SPDX-License-Identifier: GPL-3.0-or-later
// The output files of a command, and writers of surfaces, points and curves.
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_OUTPUTS_H
#define EQUIAFFINE_PROGRAM_OUTPUT_OUTPUTS_H

#include "request/Request.h"
#include "system/files.h"
#include "system/kernel.h"
#include "system/progress.h"
#include <equiaffine/io/read_points.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <CGAL/assertions.h>

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace equiaffine {

/// The purposes of the files that commands write.
enum class Output_kind { RESULT, PAGE, PICTURE, CURVES, MOVED, STATISTICS };

/// The output files of a command: all of them are written, or none.
class Outputs {
public:
  Outputs() = default;

  /// Adds the result, then the page and the picture if requested.
  Outputs(const std::string& result, const Display_request& display);

  /// Adds an output if there is a path. Throws `Input_error` now, rather than after a long computation, if the file
  /// cannot be written.
  void add(Output_kind kind, const std::optional<std::string>& path);

  /// Adds the page and the picture if requested.
  void add_displays(const Display_request& options);

  /// Removes the output of this kind, if there is one.
  void remove(Output_kind kind);

  /// The file of this kind, or null.
  Output_file* find(Output_kind kind);

  /// The file of this kind. \pre it was added.
  Output_file& operator[](Output_kind kind) {
    CGAL_precondition(find(kind) != nullptr);
    return *find(kind);
  }

  /// Closes all files except the statistics, which contain the time of writing.
  void close_results();

  /// Closes all files and moves them into place. Throws `Input_error` if one could not be stored; existing files are
  /// then unchanged.
  void commit();

  /// Whether one of them is standard output, which must then contain nothing else.
  bool use_standard_output() const { return equiaffine::use_standard_output(files_); }

  /// Writes a line "wrote FILE" for each file, in the order in which they were added.
  void report(std::ostream& out) const { report_written(out, files_); }

private:
  std::vector<Output_kind> kinds_;
  std::vector<Output_file> files_;
};

/// Throws `Input_error` if the path has the extension of another format, so that no page is written to a mesh's name.
void check_format(const std::string& path, File_format right, const std::string& kind, const std::string& advised);

/// Throws `Input_error` unless the path is "-" or `write_surface` supports its extension.
void check_surface_output(const std::string& path);

/// Writes the mesh in the format of the path's extension, OFF for "-", without committing.
void write_surface(Output_file& file, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes);

/// Throws `Input_error` unless the path is "-" or `write_vertices` supports its extension.
void check_vertices_output(const std::string& path);

/// Writes the unchanged input mesh or points with additional attributes in the format of the path's extension, CSV for
/// "-", without committing. Computed columns replace those of the same name.
void write_vertices(Output_file& file, const Point_table_3<Kernel>& table, const Vertex_attributes& attributes);

/// Throws `Input_error` unless the path is "-" or `write_curves` supports its extension.
void check_curves_output(const std::string& path);

/// Writes the curves in the format of the path's extension, OBJ for "-", without committing.
void write_curves(Output_file& file, const Parabolic_curves_3<Kernel>& curves);

/// Throws `Input_error` if the path has an extension other than .json.
void check_statistics_output(const std::string& path);

/// Throws `Input_error` if the path has an extension other than .json.
void check_maps_output(const std::string& path);

/// Warns if at least 1 % of the points coincide with others in the precision of the file: STL has single precision.
void warn_of_lost_points(const std::string& path, const std::vector<Kernel::Point_3>& points, Progress& progress);

} // namespace equiaffine

#endif
