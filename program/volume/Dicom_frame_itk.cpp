// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/name_of_file.h"
#include "volume/Dicom_frame.h"
#include "volume/header_text.h"
#include "volume/volume_formats.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <filesystem>
#include <gdcmAttribute.h>
#include <gdcmMediaStorage.h>
#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>
#include <string_view>
#include <system_error>

namespace equiaffine {

namespace {

using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;

const gdcm::Tag series_identifier(0x0020, 0x000E), frame_count(0x0028, 0x0008), pixel_data(0x7FE0, 0x0010),
    image_position(0x0020, 0x0032), image_orientation(0x0020, 0x0037), pixel_spacing(0x0028, 0x0030),
    spacing_between_slices(0x0018, 0x0088), grid_frame_offsets(0x3004, 0x000C), rescale_intercept(0x0028, 0x1052),
    rescale_slope(0x0028, 0x1053);

/// The sequences that hold what all frames, and what each frame of an enhanced image has; their items hold sequences.
const gdcm::Tag shared_groups(0x5200, 0x9229), frame_groups(0x5200, 0x9230), plane_position(0x0020, 0x9113),
    plane_orientation(0x0020, 0x9116), pixel_measures(0x0028, 0x9110), value_transformation(0x0028, 0x9145),
    detectors(0x0054, 0x0022); ///< the last one has the place of images of nuclear medicine

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
      if (!spacing) fail("it does not say how far apart its pixels are (0028,0030)");
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
    fail_to_read_volume(path_, name_ + " cannot be placed: " + reason, "correct its header, or convert it to .nrrd");
  }

  /// So many numbers of an element of decimal numbers, if there is one that is not empty.
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

  /// The numbers that all frames have in common.
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
      fail("it has " + std::to_string(std::size_t(count)) + " frames and the places of " +
           std::to_string(frames_->GetNumberOfItems()));
    return std::size_t(count);
  }

  /// How far the frames lie from the place that they have in common, along the normal.
  std::vector<double> offsets_of(std::size_t count) const {
    std::vector<double> offsets(count);
    if (count == 1 || numbers_of_group(frames_, 0, plane_position, image_position, 3)) return offsets;
    if (const auto grid = numbers_in(data_, grid_frame_offsets, count)) {
      for (std::size_t f = 0; f < count; ++f) offsets[f] = (*grid)[f] - grid->front();
      return offsets;
    }
    const auto spacing = common(pixel_measures, spacing_between_slices, 1);
    if (!spacing)
      fail("it says neither where its " + std::to_string(count) +
           " frames are (0020,0032) nor how far apart (0018,0088)");
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

/// Whether a file ends before its last pixel, if that is known without decompressing it. The reader has read all up to
/// the first one.
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

} // namespace

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

} // namespace equiaffine
