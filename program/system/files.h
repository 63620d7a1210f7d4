// SPDX-License-Identifier: GPL-3.0-or-later
// File formats by extension, outputs that are written completely or not at all, and their temporary folders.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_FILES_H
#define EQUIAFFINE_PROGRAM_SYSTEM_FILES_H

#include <filesystem>
#include <fstream>
#include <memory>
#include <ostream>
#include <span>
#include <string>

namespace equiaffine {

/// The formats of files other than volumes; for those see Volume_format.
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

/// The format of a path by its extension, in lower or upper case.
File_format file_format(const std::string& path);

/// The name of a file or folder without the folders above it. Pages and statistics contain only this name, since they
/// may be passed on.
inline std::string name_of_file(const std::filesystem::path& path) {
  const std::filesystem::path normal = path.lexically_normal();
  const std::filesystem::path last = normal.has_filename() ? normal.filename() : normal.parent_path().filename();
  return last.empty() ? path.string() : last.string();
}

/// A folder with a unique name, which is removed with this object or by `remove_all_temporary_folders()`, and locked
/// while in use. The constructor also removes unused folders that killed processes left in the same place; it throws
/// `std::system_error` if the folder cannot be created.
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

/// Removes the temporary folders of this process just before its end: threads that create or remove one afterwards
/// block.
void remove_all_temporary_folders();

/// An output that is written completely or not at all. Data go to a temporary folder beside the target, so that
/// `commit()` is a rename; without `commit()` nothing remains. "-" is standard output; standard output and devices
/// receive a copy. A replaced file keeps its permissions. Construct it before a long computation: the constructor
/// checks whether the target can be written. Every member that can fail throws `Input_error`.
class Output_file {
public:
  explicit Output_file(const std::string& path);

  const std::string& path() const { return path_; }

  bool is_standard_output() const { return path_ == "-"; }

  /// Whether the target is standard output or a device, which receive a copy, and may refuse it.
  bool has_to_be_copied() const { return has_to_be_copied_; }

  /// The temporary file as a binary stream.
  std::ostream& stream();

  /// The temporary file, for libraries that need a path. It has the target's name; files written beside it (the `.raw`
  /// of an `.mhd`) are committed with it.
  std::filesystem::path temporary_path() const;

  /// Closes `stream()`; fails if not everything could be stored.
  void close();

  /// Closes the output and moves it into place.
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

/// Commits several outputs after closing all of them without error. Copies come first, since renames hardly fail: if a
/// device refuses its copy, all files are unchanged.
void commit_all(std::span<Output_file> files);

/// Whether one of the files is standard output, which must then contain nothing else.
bool use_standard_output(std::span<const Output_file> files);

/// Writes a line "wrote FILE" for each file.
void report_written(std::ostream& out, std::span<const Output_file> files);

} // namespace equiaffine

#endif
