// SPDX-License-Identifier: GPL-3.0-or-later
// The output files of a command, and those of them that hold surfaces, points and curves.
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

/// The output files of a command, of which all appear or none.
class Outputs {
public:
  Outputs() = default;

  /// Adds the result, then page and picture, as far as they are asked for.
  Outputs(const std::string& result, const Display_request& display);

  /// Throws `Input_error` if the file cannot be written, which is to be known before a long computation. Without a path
  /// there is no such output.
  void add(Output_kind kind, const std::optional<std::string>& path);

  /// Adds page and picture, as far as they are asked for.
  void add_displays(const Display_request& options);

  /// Forgets the file of that kind, if there is one, so that nothing is written.
  void remove(Output_kind kind);

  /// The file of that kind, or null.
  Output_file* find(Output_kind kind);

  /// The file of that kind. \pre it was added.
  Output_file& operator[](Output_kind kind) {
    CGAL_precondition(find(kind) != nullptr);
    return *find(kind);
  }

  /// Ends writing to all files but that of the statistics, which tell how long it took.
  void close_results();

  /// Ends writing and puts all files in place. Throws `Input_error` if one could not be stored, and then leaves what
  /// was there.
  void commit();

  /// Whether one of them is standard output, where nothing else may be written then.
  bool use_standard_output() const { return equiaffine::use_standard_output(files_); }

  /// Tells people which files were written, in the order in which they were added, a line each.
  void report(std::ostream& out) const { report_written(out, files_); }

private:
  std::vector<Output_kind> kinds_;
  std::vector<Output_file> files_;
};

/// Throws `Input_error` if the file has the extension of another format: what looks like a mesh is not to become a
/// page.
void check_format(const std::string& path, File_format right, const std::string& kind, const std::string& advised);

/// Throws `Input_error` unless `write_surface` knows the extension of the path, or it is "-".
void check_surface_output(const std::string& path);

/// Writes the mesh in the format of the path's extension, OFF for "-", without committing.
void write_surface(Output_file& file, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes);

/// Throws `Input_error` unless `write_vertices` knows the extension of the path, or it is "-".
void check_vertices_output(const std::string& path);

/// Writes a mesh or points as they came with more attributes in the format of the path's extension, CSV for "-",
/// without committing. Computed columns replace those of the same name.
void write_vertices(Output_file& file, const Point_table_3<Kernel>& table, const Vertex_attributes& attributes);

/// Throws `Input_error` unless `write_curves` knows the extension of the path, or it is "-".
void check_curves_output(const std::string& path);

/// Writes the curves in the format of the path's extension, OBJ for "-", without committing.
void write_curves(Output_file& file, const Parabolic_curves_3<Kernel>& curves);

/// Throws `Input_error` if the path has an extension that is not .json.
void check_statistics_output(const std::string& path);

/// Throws `Input_error` if the path has an extension that is not .json.
void check_maps_output(const std::string& path);

/// Warns if the format of a file that the points of a mesh were written to cannot tell a hundredth of them from others:
/// STL, which has single precision.
void warn_of_lost_points(const std::string& path, const std::vector<Kernel::Point_3>& points, Progress& progress);

} // namespace equiaffine

#endif
