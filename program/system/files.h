// SPDX-License-Identifier: GPL-3.0-or-later
// What names of files say, outputs that appear whole or not at all, and the temporary folders in which they are made.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_FILES_H
#define EQUIAFFINE_PROGRAM_SYSTEM_FILES_H

#include <filesystem>
#include <fstream>
#include <memory>
#include <ostream>
#include <span>
#include <string>

namespace equiaffine {

/// The formats of files that are no volumes, for which there is Volume_format.
enum class File_format {
  PLY,
  OFF,
  OBJ,
  STL,
  VTP,
  CSV,
  XYZ,
  HTML,
  PNG,
  JSON,
  OTHER,  ///< the path has another extension
  UNNAMED ///< the path has none
};

/// The format that the extension of a path stands for, in lower or upper case.
File_format file_format(const std::string& path);

/// The name of a file or folder without the folders above it, which others need not see. It is what files that
/// are passed on, such as pages and statistics, call a source.
inline std::string name_of_file(const std::filesystem::path& path) {
  const std::filesystem::path normal = path.lexically_normal();
  const std::filesystem::path last = normal.has_filename() ? normal.filename() : normal.parent_path().filename();
  return last.empty() ? path.string() : last.string();
}

/// A folder of its own name that is removed with this object, or by `remove_all_temporary_folders()`. A lock on it
/// tells other processes that it is in use. The constructor removes those in the same place that nobody uses, which a
/// process left that was killed; it throws `std::system_error` if the folder cannot be made.
class Temporary_folder {
public:
  explicit Temporary_folder(const std::filesystem::path& parent);
  ~Temporary_folder();
  Temporary_folder(const Temporary_folder&) = delete;
  Temporary_folder& operator=(const Temporary_folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  int lock_ = -1;
};

/// Removes the temporary folders of this process, which is about to end: threads that make or remove one from now on
/// wait for that end.
void remove_all_temporary_folders();

/// An output that appears whole or not at all. What is written goes to a temporary folder beside the target, so that
/// `commit()` is a rename; without `commit()` nothing remains. "-" is standard output; it and devices receive a copy.
/// A file that is replaced hands on its permissions.
/// The constructor already finds out whether the target can be written: make it before a long computation.
/// Every member that can fail throws `Input_error`.
class Output_file {
public:
  explicit Output_file(const std::string& path);

  const std::string& path() const { return path_; }

  bool is_standard_output() const { return path_ == "-"; }

  /// Whether the target receives a copy: standard output and devices, which may refuse it.
  bool has_to_be_copied() const { return has_to_be_copied_; }

  /// The temporary file as a binary stream.
  std::ostream& stream();

  /// The temporary file, for libraries that want a name: it has the target's name, and files written beside it (the
  /// `.raw` of an `.mhd`) are committed with it.
  std::filesystem::path temporary_path() const;

  /// Ends writing to `stream()`; fails if not everything could be stored.
  void close();

  /// Closes and puts the output in place.
  void commit();

private:
  void copy_to_target();
  void rename_to_target();

  std::string path_;
  std::filesystem::path target_;
  bool has_to_be_copied_;
  std::unique_ptr<Temporary_folder> folder_;
  std::ofstream stream_;
};

/// Commits several outputs after all of them were closed without error. Those that are renamed, which hardly fails,
/// come last: a device that refuses its copy leaves every file as it was.
void commit_all(std::span<Output_file> files);

/// Whether one of the files is standard output, where nothing else may be written then.
bool use_standard_output(std::span<const Output_file> files);

/// Tells people which files were written, a line each.
void report_written(std::ostream& out, std::span<const Output_file> files);

} // namespace equiaffine

#endif
