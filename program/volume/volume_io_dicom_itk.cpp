// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/files.h"
#include "system/kernel.h"
#include "volume/Shared_volume.h"
#include "volume/data_files.h"
#include "volume/header_text.h"
#include "volume/itk_image.h"
#include "volume/volume_formats.h"

#include <itkGDCMImageIO.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <gdcmAttribute.h>
#include <gdcmMediaStorage.h>
#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace equiaffine {

namespace {

/// A slice of a volume: a file of a series, or one of the frames of a file.
struct Dicom_frame {
  std::string file;  ///< path
  std::size_t index; ///< in the file
  std::string name;  ///< 'slice.dcm', or frame 3 of 'volume.dcm'
  std::array<std::size_t, 2> size;
  Kernel::Point_3 position;                     ///< of the first pixel, in millimeters
  std::array<Kernel::Vector_3, 2> steps;        ///< to the next pixel of the row, and of the column
  std::optional<std::array<double, 2>> scaling; ///< slope and intercept, if frames have their own
};

/// The header of a file with an image.
struct Dicom_header {
  std::string series; ///< the identifier of the file's series
  std::vector<Dicom_frame> frames;
};

using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;

const gdcm::Tag series_identifier(0x0020, 0x000E), frame_count(0x0028, 0x0008), pixel_data(0x7FE0, 0x0010),
    image_position(0x0020, 0x0032), image_orientation(0x0020, 0x0037), pixel_spacing(0x0028, 0x0030),
    spacing_between_slices(0x0018, 0x0088), grid_frame_offsets(0x3004, 0x000C), rescale_intercept(0x0028, 0x1052),
    rescale_slope(0x0028, 0x1053);

/// The sequences with data of all frames, and of each frame, of an enhanced image; their items contain sequences.
const gdcm::Tag shared_groups(0x5200, 0x9229), frame_groups(0x5200, 0x9230), plane_position(0x0020, 0x9113),
    plane_orientation(0x0020, 0x9116), pixel_measures(0x0028, 0x9110), value_transformation(0x0028, 0x9145),
    detectors(0x0054, 0x0022); ///< the last one has the position of images of nuclear medicine

using Items = gdcm::SmartPointer<gdcm::SequenceOfItems>;

Items items_of(const gdcm::DataSet& data, const gdcm::Tag& sequence) {
  return data.FindDataElement(sequence) ? data.GetDataElement(sequence).GetValueAsSQ() : Items();
}

std::optional<std::string> text_in(const gdcm::DataSet& data, const gdcm::Tag& tag) {
  if (!data.FindDataElement(tag)) return std::nullopt;
  const gdcm::ByteValue* const bytes = data.GetDataElement(tag).GetByteValue();
  return bytes ? std::optional(std::string(bytes->GetPointer(), bytes->GetLength())) : std::nullopt;
}

class Header_reader {
public:
  Header_reader(const std::string& path, const std::string& file, const gdcm::DataSet& data)
      : path_(path), file_(file), name_('\'' + name_of_file(file) + '\''), data_(data),
        shared_(items_of(data, shared_groups)), frames_(items_of(data, frame_groups)),
        detectors_(items_of(data, detectors)) {}

  std::vector<Dicom_frame> frames(const std::array<std::size_t, 2>& size) const {
    const std::size_t count = number_of_frames();
    admit_nodes(path_,
                {std::max<std::size_t>(size[0], 2), std::max<std::size_t>(size[1], 2), std::max<std::size_t>(count, 2)},
                1);
    const std::vector<double> offsets = offsets_of(count);
    std::vector<Dicom_frame> frames;
    for (std::size_t f = 0; f < count; ++f) {
      const auto [row, column] = directions_of(f);
      const auto spacing = found(f, pixel_measures, pixel_spacing, 2);
      if (!spacing) fail("the spacing of its pixels (0028,0030) is missing");
      const auto place = found(f, plane_position, image_position, 3).value_or(std::vector<double>(3));
      frames.push_back({file_,
                        f,
                        count == 1 ? name_ : "frame " + std::to_string(f + 1) + " of " + name_,
                        size,
                        Point_3(place[0], place[1], place[2]) + offsets[f] * CGAL::cross_product(row, column),
                        {(*spacing)[1] * row, (*spacing)[0] * column},
                        scaling_of(f)});
    }
    return frames;
  }

private:
  [[noreturn]] void fail(const std::string& reason) const {
    fail_to_read_volume(path_, name_ + " has no valid position: " + reason,
                        "correct its header, or convert it to .nrrd");
  }

  /// The `count` decimal numbers of an element, or nothing if it is missing or empty.
  std::optional<std::vector<double>> numbers_in(const gdcm::DataSet& data, const gdcm::Tag& tag,
                                                std::size_t count) const {
    const std::optional<std::string> text = text_in(data, tag);
    if (!text) return std::nullopt;
    std::string blanks = *text;
    for (char& c : blanks)
      if (c == '\\' || c == '\0') c = ' ';
    if (words_of(blanks).empty()) return std::nullopt;
    const auto numbers = to_numbers(blanks, count);
    if (!numbers)
      fail_at_field(path_, "in " + name_ + " the element " + tag.PrintAsPipeSeparatedString(), *text,
                    count == 1 ? "write a finite number" : "write " + std::to_string(count) + " finite numbers");
    return numbers;
  }

  std::optional<std::vector<double>> numbers_of_group(const Items& groups, std::size_t index, const gdcm::Tag& group,
                                                      const gdcm::Tag& tag, std::size_t count) const {
    if (!groups || index >= groups->GetNumberOfItems()) return std::nullopt;
    const Items items = items_of(groups->GetItem(index + 1).GetNestedDataSet(), group);
    if (!items || items->IsEmpty()) return std::nullopt;
    return numbers_in(items->GetItem(1).GetNestedDataSet(), tag, count);
  }

  /// The numbers common to all frames.
  std::optional<std::vector<double>> common(const gdcm::Tag& group, const gdcm::Tag& tag, std::size_t count) const {
    if (auto numbers = numbers_of_group(shared_, 0, group, tag, count)) return numbers;
    if (auto numbers = numbers_in(data_, tag, count)) return numbers;
    if (!detectors_ || detectors_->IsEmpty()) return std::nullopt;
    return numbers_in(detectors_->GetItem(1).GetNestedDataSet(), tag, count);
  }

  std::optional<std::vector<double>> found(std::size_t frame, const gdcm::Tag& group, const gdcm::Tag& tag,
                                           std::size_t count) const {
    const auto own = numbers_of_group(frames_, frame, group, tag, count);
    return own ? own : common(group, tag, count);
  }

  std::size_t number_of_frames() const {
    const auto numbers = numbers_in(data_, frame_count, 1);
    const double count = numbers ? (*numbers)[0] : 1;
    if (!(count >= 1 && count <= INT_MAX && count == std::floor(count)))
      fail("its number of frames (0028,0008) is not a positive integer");
    if (frames_ && double(frames_->GetNumberOfItems()) != count)
      fail("it has " + std::to_string(std::size_t(count)) + " frames, but positions of " +
           std::to_string(frames_->GetNumberOfItems()));
    return std::size_t(count);
  }

  /// The offsets of the frames from their common position, along the normal.
  std::vector<double> offsets_of(std::size_t count) const {
    std::vector<double> offsets(count);
    if (count == 1 || numbers_of_group(frames_, 0, plane_position, image_position, 3)) return offsets;
    if (const auto grid = numbers_in(data_, grid_frame_offsets, count)) {
      for (std::size_t f = 0; f < count; ++f) offsets[f] = (*grid)[f] - grid->front();
      return offsets;
    }
    const auto spacing = common(pixel_measures, spacing_between_slices, 1);
    if (!spacing)
      fail("both the positions (0020,0032) and the spacing (0018,0088) of its " + std::to_string(count) +
           " frames are missing");
    for (std::size_t f = 0; f < count; ++f) offsets[f] = double(f) * spacing->front();
    return offsets;
  }

  /// The directions of rows and of columns.
  std::array<Vector_3, 2> directions_of(std::size_t frame) const {
    const auto numbers = found(frame, plane_orientation, image_orientation, 6);
    if (!numbers) return {Vector_3(1, 0, 0), Vector_3(0, 1, 0)};
    const auto& n = *numbers;
    const Vector_3 row(n[0], n[1], n[2]), column(n[3], n[4], n[5]);
    const double length = std::sqrt(row.squared_length()), other = std::sqrt(column.squared_length());
    if (!(length > 0 && other > 0)) fail("a direction (0020,0037) is zero");
    return {row / length, column / other};
  }

  std::optional<std::array<double, 2>> scaling_of(std::size_t frame) const {
    const auto slope = numbers_of_group(frames_, frame, value_transformation, rescale_slope, 1),
               intercept = numbers_of_group(frames_, frame, value_transformation, rescale_intercept, 1);
    return slope && intercept ? std::optional(std::array{slope->front(), intercept->front()}) : std::nullopt;
  }

  std::string path_, file_, name_;
  const gdcm::DataSet& data_;
  Items shared_, frames_, detectors_;
};

/// Whether a file ends before its last pixel, as far as this is known without decompressing it. \pre the reader has
/// read up to the first pixel
bool ends_early(const gdcm::Reader& reader, const std::string& file, const Dicom_header& header) {
  const gdcm::TransferSyntax syntax = reader.GetFile().GetHeader().GetDataSetTransferSyntax();
  if (syntax.IsEncapsulated() || syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian) return false;
  gdcm::Attribute<0x0028, 0x0002> samples = {1};
  gdcm::Attribute<0x0028, 0x0100> bits = {8};
  samples.SetFromDataSet(reader.GetFile().GetDataSet());
  bits.SetFromDataSet(reader.GetFile().GetDataSet());
  const auto& [width, height] = header.frames.front().size;
  const double pixels = double(width) * double(height) * double(header.frames.size());
  std::error_code error;
  const auto bytes = double(std::filesystem::file_size(file, error));
  return error || bytes - double(reader.GetStreamCurrentPosition()) < pixels * samples.GetValue() * bits.GetValue() / 8;
}

/// Reads the header of a DICOM file; returns nothing for a file in another format, or without an image. The volume
/// `path` is for messages. Throws `Input_error` for a damaged header, and if positions of frames are missing.
std::optional<Dicom_header> read_dicom_header(const std::string& path, const std::string& file) {
  gdcm::Reader reader;
  reader.SetFileName(file.c_str());
  if (!reader.CanRead()) return std::nullopt;
  const auto fail_if = [&](bool is_damaged) {
    if (is_damaged)
      fail_to_read_volume(path, '\'' + name_of_file(file) + "' is damaged", "get the complete file again");
  };
  fail_if(!reader.ReadUpToTag(pixel_data, {pixel_data}));
  const gdcm::DataSet& data = reader.GetFile().GetDataSet();
  gdcm::Attribute<0x0028, 0x0010> rows = {0};
  gdcm::Attribute<0x0028, 0x0011> columns = {0};
  rows.SetFromDataSet(data);
  columns.SetFromDataSet(data);
  if (rows.GetValue() == 0 || columns.GetValue() == 0) {
    gdcm::MediaStorage kind;
    fail_if(kind.SetFromFile(reader.GetFile()) && gdcm::MediaStorage::IsImage(kind));
    return std::nullopt; // a report or a directory
  }
  const std::string series = text_in(data, series_identifier).value_or("");
  const Dicom_header header = {series.substr(0, series.find_last_not_of(std::string_view(" \0", 2)) + 1),
                               Header_reader(path, file, data).frames({columns.GetValue(), rows.GetValue()})};
  fail_if(ends_early(reader, file, header));
  return header;
}

using Frames = std::vector<Dicom_frame>;

/// The maximum distance of a pixel from its position in the lattice, relative to the step between slices: positions are
/// rounded decimals.
constexpr double largest_deviation = 1e-2;

double length_of(const Vector_3& v) { return std::hypot(v.x(), v.y(), v.z()); }

/// The frames of a file, or of all files in a folder, which must be of one series.
Frames find_frames(const std::string& path) {
  std::error_code error;
  const bool is_folder = std::filesystem::is_directory(path, error);
  std::vector<std::string> files = is_folder ? files_of_volume(path, std::nullopt) : std::vector{path};
  std::sort(files.begin(), files.end());
  std::set<std::string> series;
  Frames frames;
  for (const std::string& file : files) {
    if (!std::filesystem::is_regular_file(file, error)) continue;
    const auto header = read_dicom_header(path, file);
    if (!header) continue;
    series.insert(header->series);
    frames.insert(frames.end(), header->frames.begin(), header->frames.end());
  }
  if (is_folder && series.size() != 1)
    fail_to_read_volume(path, "the folder contains " + std::to_string(series.size()) + " DICOM series",
                        series.empty() ? "name a folder with DICOM files or a volume file"
                                       : "move the files of one series to a folder of their own");
  if (frames.empty()) fail_to_read_volume(path, "it is not a DICOM file with an image", "get the complete file again");
  if (frames.size() == 1)
    fail_to_read_volume(path, "it has only one slice", "name the folder with all files of its series, at least 2");
  return frames;
}

std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// Throws unless all slices have the same numbers, spacings and directions of pixels.
void check_are_alike(const std::string& path, const Frames& frames) {
  const auto size_text = [](const Dicom_frame& frame) {
    return std::to_string(frame.size[0]) + " x " + std::to_string(frame.size[1]);
  };
  const Dicom_frame& first = frames.front();
  for (const Dicom_frame& frame : frames) {
    if (frame.size != first.size)
      fail_to_read_volume(
          path, frame.name + " has " + size_text(frame) + " pixels, but " + first.name + " has " + size_text(first),
          "leave out the slices that belong to another volume");
    const double shift = double(first.size[0] - 1) * length_of(frame.steps[0] - first.steps[0]) +
                         double(first.size[1] - 1) * length_of(frame.steps[1] - first.steps[1]);
    if (!(shift <= largest_deviation * length_of(first.steps[0])))
      fail_to_read_volume(path, frame.name + " is rotated or scaled relative to " + first.name,
                          "leave out the slices that belong to another volume");
  }
}

/// Throws an error with the closest and the farthest neighbors of sorted frames that are not evenly spaced.
[[noreturn]] void fail_at_gap(const std::string& path, const Frames& frames, double mean_distance) {
  const auto distance = [&](std::size_t f) { return length_of(frames[f + 1].position - frames[f].position); };
  const auto pair = [&](std::size_t f) { return frames[f].name + " and " + frames[f + 1].name; };
  std::size_t closest = 0, farthest = 0;
  for (std::size_t f = 1; f + 1 < frames.size(); ++f) {
    if (distance(f) < distance(closest)) closest = f;
    if (distance(f) > distance(farthest)) farthest = f;
  }
  if (distance(closest) <= largest_deviation * mean_distance)
    fail_to_read_volume(path, pair(closest) + " have the same position",
                        "leave out one of them, or one of two volumes");
  fail_to_read_volume(path,
                      "its slices are not evenly spaced: " + pair(farthest) + " are " + text_of(distance(farthest)) +
                          " mm apart, but " + pair(closest) + ' ' + text_of(distance(closest)) + " mm",
                      "add the missing slices or resample the volume first");
}

/// Sorts the frames along their normal, and makes their lattice. Throws if there are gaps.
Lattice_3<Kernel> lattice_of(const std::string& path, Frames& frames) {
  const auto [row, column] = frames.front().steps;
  const Vector_3 normal = CGAL::cross_product(row, column);
  const auto height = [&](const Dicom_frame& frame) { return (frame.position - CGAL::ORIGIN) * normal; };
  std::stable_sort(frames.begin(), frames.end(),
                   [&](const Dicom_frame& a, const Dicom_frame& b) { return height(a) < height(b); });
  const Vector_3 step = (frames.back().position - frames.front().position) / double(frames.size() - 1);
  for (std::size_t f = 0; f < frames.size(); ++f)
    if (!(length_of(frames[f].position - frames.front().position - double(f) * step) <=
          largest_deviation * length_of(step)))
      fail_at_gap(path, frames, length_of(step));
  return make_lattice(path, {frames.front().size[0], frames.front().size[1], frames.size()}, frames.front().position,
                      {row, column, step});
}

/// Reads the frames of a file into their `slices` of the volume.
void read_file(const std::string& path, const std::string& file, const std::vector<std::size_t>& slices,
               const Frames& frames, const Volume_selection& selection, double* values) {
  const itk::GDCMImageIO::Pointer io = itk::GDCMImageIO::New();
  io->SetFileName(file);
  io->ReadImageInformation();
  const std::size_t pixels = frames.front().size[0] * frames.front().size[1], type = sample_type_of(path, *io),
                    components = io->GetNumberOfComponents(), component = chosen_component(path, selection, components);
  if (std::size_t(io->GetImageSizeInPixels()) != pixels * slices.size()) fail_to_read_volume_data(path);
  io->SetIORegion(whole_region(*io));
  std::vector<char> bytes(pixels * slices.size() * components * size_of_sample(type));
  io->Read(bytes.data());
  // ITK scales all frames of a file like the first one.
  const std::array<double, 2> common = {io->GetRescaleSlope(), io->GetRescaleIntercept()};
  for (const std::size_t slice : slices) {
    const auto [slope, intercept] = frames[slice].scaling.value_or(common);
    const bool is_scaled_otherwise = std::array{slope, intercept} != common && common[0] != 0;
    with_sample_type(type, [&](auto number) {
      const auto* const samples = reinterpret_cast<const decltype(number)*>(bytes.data()) +
                                  frames[slice].index * pixels * components + component;
      for (std::size_t p = 0; p < pixels; ++p) {
        const double value = double(samples[p * components]);
        values[slice * pixels + p] = is_scaled_otherwise ? (value - common[1]) / common[0] * slope + intercept : value;
      }
    });
  }
}

} // namespace

void read_dicom_volume(const std::string& path, const Volume_selection& selection, Shared_volume& volume) {
  const Captured_standard_error standard_error;
  chosen_time(path, selection, 1);
  Frames frames = find_frames(path);
  check_are_alike(path, frames);
  const Lattice_3<Kernel> lattice = lattice_of(path, frames);
  auto* const values = static_cast<double*>(volume.allocate(lattice, floating_sample_type(sizeof(double))));
  std::map<std::string, std::vector<std::size_t>> slices_of_files;
  for (std::size_t slice = 0; slice < frames.size(); ++slice) slices_of_files[frames[slice].file].push_back(slice);
  try {
    for (const auto& [file, slices] : slices_of_files) read_file(path, file, slices, frames, selection, values);
  } catch (const itk::ExceptionObject& exception) {
    fail_to_read_volume(path, "a file of the series cannot be read" + reason_of(exception),
                        "get the complete series again or convert it");
  }
}

} // namespace equiaffine
