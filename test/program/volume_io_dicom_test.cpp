// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/volume_io_fixture.h"
#include "system/process.h"
#include "volume/Shared_volume.h"
#include "volume/volume_formats.h"
#include "volume/volume_io.h"

#include <gtest/gtest.h>

#ifdef EQUIAFFINE_WITH_ITK
#include <itkGDCMImageIO.h>
#include <itkMetaDataObject.h>
#endif

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace volume_io_dicom_test {

using namespace volume_io_fixture;

#ifdef EQUIAFFINE_WITH_ITK

/// One slice of a CT series, with its place in the patient; its first value tells it from the others.
void write_slice(const std::string& path, const std::string& position, std::size_t width,
                 const std::vector<std::int16_t>& values, bool is_compressed) {
  const itk::GDCMImageIO::Pointer io = itk::GDCMImageIO::New();
  itk::MetaDataDictionary& dictionary = io->GetMetaDataDictionary();
  const auto set = [&](const char* tag, const std::string& value) { itk::EncapsulateMetaData(dictionary, tag, value); };
  set("0008|0016", "1.2.840.10008.5.1.4.1.1.2");
  set("0008|0018", "1.2.826.0.1.3680043.2.1125.9." + std::to_string(values[0]));
  set("0008|0060", "CT");
  set("0020|000d", "1.2.826.0.1.3680043.2.1125.7");
  set("0020|000e", "1.2.826.0.1.3680043.2.1125.8");
  set("0020|0032", position);
  set("0020|0037", R"(0.36\0.48\-0.8\-0.8\0.6\0)");
  io->KeepOriginalUIDOn();
  io->SetNumberOfDimensions(2);
  io->SetDimensions(0, width);
  io->SetDimensions(1, values.size() / width);
  io->SetSpacing(0, 0.5);
  io->SetSpacing(1, 0.75);
  io->SetPixelType(itk::IOPixelEnum::SCALAR);
  io->SetNumberOfComponents(1);
  io->SetComponentType(itk::IOComponentEnum::SHORT);
  io->SetUseCompression(is_compressed);
  io->SetFileName(path);
  io->Write(values.data());
}

/// A slice of 4 x 3 values, which increase.
void write_slice(const std::string& path, const std::string& position, std::int16_t first_value) {
  std::vector<std::int16_t> values(12);
  std::iota(values.begin(), values.end(), first_value);
  write_slice(path, position, 4, values, false);
}

TEST_F(Program_volume_io, a_dicom_series_is_ordered_by_the_places_of_its_slices) {
  const fs::path series = path("series");
  fs::create_directory(series);
  expect_reading_error("series", "0 DICOM series");
  // The third direction is the cross product (0.48, 0.64, 0.6). Slices lie 2 apart along it, in another order than the
  // names of their files.
  write_slice(series / "c.dcm", R"(10\20\30)", 100);
  write_slice(series / "a.dcm", R"(10.96\21.28\31.2)", 200);
  write_slice(series / "b.dcm", R"(11.92\22.56\32.4)", 300);
  const Volume volume = read_volume(series).to_volume();
  ASSERT_EQ(volume.lattice.size(), (Lattice::Size{4, 3, 3}));
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(volume(i, j, k), double(100 * (k + 1) + 4 * j + i));
  const Lattice expected({4, 3, 3}, Point_3(10, 20, 30),
                         {Vector_3(0.18, 0.24, -0.4), Vector_3(-0.6, 0.45, 0), Vector_3(0.96, 1.28, 1.2)});
  EXPECT_LE(largest_distance_between_nodes(volume.lattice, expected), 16 * epsilon * largest_coordinate(expected));
  write_slice(series / "e.dcm", R"(13.84\25.12\34.8)", 500);
  expect_reading_error("series", "not evenly spaced");
}

TEST_F(Program_volume_io, a_dicom_series_may_decompress_to_what_its_headers_say) {
  const fs::path series = path("series");
  fs::create_directory(series);
  constexpr std::size_t width = 3200;
  write_slice(series / "a.dcm", R"(0\0\0)", width, std::vector<std::int16_t>(width * width, 1), true);
  write_slice(series / "b.dcm", R"(0.96\1.28\1.2)", width, std::vector<std::int16_t>(width * width, 2), true);
  equiaffine::Shared_volume volume;
  equiaffine::run_in_child([&] { equiaffine::read_dicom_volume(series, {}, volume); }, little_memory);
  EXPECT_EQ(volume.lattice().size(), (Lattice::Size{width, width, 2}));
}

#endif

} // namespace volume_io_dicom_test
