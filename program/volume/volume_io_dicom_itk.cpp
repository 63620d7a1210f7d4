// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/Dicom_frame.h"
#include "volume/data_files.h"
#include "volume/itk_image.h"
#include "volume/sample_type.h"
#include "volume/volume_formats.h"

#include <itkGDCMImageIO.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace equiaffine {

namespace {

using Vector_3 = Kernel::Vector_3;
using Frames = std::vector<Dicom_frame>;

/// The largest distance of a pixel from its place in the lattice, as a part of the step between slices: places are
/// rounded decimals.
constexpr double largest_deviation = 1e-2;

double length_of(const Vector_3& v) { return std::hypot(v.x(), v.y(), v.z()); }

/// The frames of a file, or of all files in a folder, which are of one series.
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
    fail_to_read_volume(path, "the folder holds " + std::to_string(series.size()) + " DICOM series",
                        series.empty() ? "name a folder with DICOM files or a volume file"
                                       : "move the files of one series to a folder of their own");
  if (frames.empty()) fail_to_read_volume(path, "it is no DICOM file with an image", "get the complete file again");
  if (frames.size() == 1)
    fail_to_read_volume(path, "it has one slice only",
                        "name the folder with all files of its series, which has at least 2");
  return frames;
}

std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// Throws unless the slices have as many pixels, which are as far apart and in the same directions.
void check_are_alike(const std::string& path, const Frames& frames) {
  const auto size_text = [](const Dicom_frame& frame) {
    return std::to_string(frame.size[0]) + " x " + std::to_string(frame.size[1]);
  };
  const Dicom_frame& first = frames.front();
  for (const Dicom_frame& frame : frames) {
    if (frame.size != first.size)
      fail_to_read_volume(
          path, frame.name + " has " + size_text(frame) + " pixels, and " + first.name + " has " + size_text(first),
          "leave out the slices that belong to another volume");
    const double shift = double(first.size[0] - 1) * length_of(frame.steps[0] - first.steps[0]) +
                         double(first.size[1] - 1) * length_of(frame.steps[1] - first.steps[1]);
    if (!(shift <= largest_deviation * length_of(first.steps[0])))
      fail_to_read_volume(path, frame.name + " is turned or scaled against " + first.name,
                          "leave out the slices that belong to another volume");
  }
}

/// Names the frames, which are sorted and not evenly spaced, that are closest to and farthest from each other.
[[noreturn]] void fail_at_gap(const std::string& path, const Frames& frames, double mean_distance) {
  const auto distance = [&](std::size_t f) { return length_of(frames[f + 1].position - frames[f].position); };
  const auto pair = [&](std::size_t f) { return frames[f].name + " and " + frames[f + 1].name; };
  std::size_t closest = 0, farthest = 0;
  for (std::size_t f = 1; f + 1 < frames.size(); ++f) {
    if (distance(f) < distance(closest)) closest = f;
    if (distance(f) > distance(farthest)) farthest = f;
  }
  if (distance(closest) <= largest_deviation * mean_distance)
    fail_to_read_volume(path, pair(closest) + " are in one place", "leave out one of them, or one of two volumes");
  fail_to_read_volume(path,
                      "its slices are not evenly spaced: " + pair(farthest) + " are " + text_of(distance(farthest)) +
                          " apart, and " + pair(closest) + ' ' + text_of(distance(closest)),
                      "add the missing ones or resample it first");
}

/// Sorts the frames along their normal, and makes the lattice whose slices they are. Throws for gaps.
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

/// Reads the frames of a file to their places, `slices`, among all.
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
  // ITK scales all frames of a file as it scales the first one.
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
    fail_to_read_volume(path, "a file of the series is not understood" + reason_of(exception),
                        "get the complete series again or convert it");
  }
}

} // namespace equiaffine
