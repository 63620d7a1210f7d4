// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/volume_io_fixture.h"
#include "volume/data_files.h"
#include "volume/volume_formats.h"
#include "volume/volume_io.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace volume_io_data_files_test {

using namespace volume_io_fixture;

TEST_F(Program_volume_io, the_size_of_a_volume_is_that_of_its_header_and_the_files_that_it_names) {
  using equiaffine::Volume_format;
  fs::create_directory(path("data"));
  for (const char* name : {"data/1.raw", "data/2.raw", "data/03.raw", "alone.raw"})
    write_file(name, std::string(1000, '\0'));
  write_file("data/other.bin", std::string(20000, '\0'));
  write_file("other.raw", std::string(30000, '\0'));
  const auto expect_size = [&](const std::string& text, Volume_format format, double size_of_data) {
    write_file("header", text);
    EXPECT_EQ(equiaffine::size_of_volume(path("header"), format), double(text.size()) + size_of_data) << text;
  };
  const std::string meta = "ObjectType = Image\nNDims = 3\nElementDataFile = ";
  expect_size(meta + "alone.raw", Volume_format::META, 1000);
  expect_size(meta + "alone.raw\r\nElementDataFile = other.raw\n", Volume_format::META, 1000);
  expect_size(meta + "absent.raw", Volume_format::META, 0);
  expect_size(meta + path("alone.raw"), Volume_format::META, 1000);
  expect_size(meta + "LIST\ndata/1.raw\n\n data/03.raw\n", Volume_format::META, 2000);
  expect_size(meta + "data/%d.raw 1 3 1", Volume_format::META, 2000);
  expect_size(meta + "data/%02d.raw 1 3 1", Volume_format::META, 1000);
  expect_size("NDims = 3\nDimSize = 4 4 2\nElementDataFile = data/%d.raw", Volume_format::META, 2000);
  expect_size(meta + "LOCAL\nElementDataFile = other.raw\n", Volume_format::META, 0);
  const std::string nrrd = "NRRD0004\n# other.raw\ntype: float\n";
  expect_size(nrrd + "data file: alone.raw\n", Volume_format::NRRD, 1000);
  expect_size(nrrd + "DataFile: ./data/%02d.raw 3 3 1\n", Volume_format::NRRD, 1000);
  expect_size(nrrd + "data file: data/%d.raw 3 1 -1\n", Volume_format::NRRD, 2000);
  expect_size(nrrd + "data file: LIST\ndata/1.raw\ndata/2.raw", Volume_format::NRRD, 2000);
  expect_size(nrrd + "\ndata file: other.raw\n", Volume_format::NRRD, 0);
  expect_size(nrrd + "data file: data/%", Volume_format::NRRD, 0);
  expect_size("ElementDataFile = other.raw", Volume_format::VTI, 0);
  EXPECT_EQ(equiaffine::size_of_volume(path("data"), std::nullopt), 23000);
}

TEST_F(Program_volume_io, samples_that_lie_in_a_file_as_in_memory_are_found_there) {
  using equiaffine::Volume_format;
  constexpr std::size_t type_float = 8;
  const auto place = [&](const std::string& text, Volume_format format) -> std::string {
    write_file("header", text);
    const auto data = equiaffine::find_raw_data(path("header"), format, type_float, 16);
    return data ? fs::path(data->path).filename().string() + " " + std::to_string(data->first) : "elsewhere";
  };
  write_file("samples.raw", std::string(64, 'x'));
  const std::string meta = "ObjectType = Image\nNDims = 3\nBinaryData = True\n", local = "ElementDataFile = LOCAL\n";
  const auto meta_image = [&](const std::string& text) { return place(meta + text, Volume_format::META); };
  const std::string samples(64, '\n'), first = std::to_string((meta + local).size());
  EXPECT_EQ(meta_image(local + samples), "header " + first);
  EXPECT_EQ(meta_image(local + samples + "more"), "header " + first);
  EXPECT_EQ(meta_image(local + samples.substr(1)), "elsewhere") << "it ends early";
  EXPECT_EQ(meta_image("CompressedData = False\nElementDataFile = samples.raw\n"), "samples.raw 0");
  EXPECT_EQ(meta_image("ElementDataFile = " + path("samples.raw") + "\r\n"), "samples.raw 0");
  EXPECT_EQ(meta_image("ElementDataFile = absent.raw\n"), "elsewhere");
  EXPECT_EQ(meta_image("ElementDataFile = LIST\nsamples.raw\n"), "elsewhere");
  EXPECT_EQ(meta_image("ElementDataFile = samples%d.raw 1 2 1\n"), "elsewhere");
  for (const char* const line :
       {"CompressedData = True\n", "BinaryDataByteOrderMSB = True\n", "BinaryData = False\n",
        "ElementByteOrderMSB = true\n", "HeaderSize = -1\n", "CompressedData : True\n", "ElementByteOrderMSB == True\n",
        "HeaderSize: -1\n", "CompressedData True\n", "CompressedData =\n = True\n"})
    EXPECT_EQ(meta_image(line + local + samples), "elsewhere") << line;

  const auto nrrd = [&](const std::string& text) {
    return place("NRRD0004\ntype: float\n" + text, Volume_format::NRRD);
  };
  EXPECT_EQ(nrrd("encoding: raw\nendian: little\n# x: y\n\n" + samples), "header 58");
  EXPECT_EQ(nrrd("Encoding: RAW\r\n\r\n" + samples), "header 38") << "numbers of a byte have no order";
  for (const char* const line :
       {"encoding: gzip\n", "endian: big\n", "data file: samples.raw\n", "byte skip: -1\n", "line skip: 1\n"})
    EXPECT_EQ(nrrd("encoding: raw\nendian: little\n" + std::string(line) + "\n" + samples), "elsewhere") << line;

  const auto nifti = [&](float offset, float slope, float intercept, std::int16_t type = 16) {
    std::string header(352, '\0');
    const std::int32_t size = 348;
    const auto bits = std::int16_t(type == 16 ? 32 : 16);
    std::memcpy(header.data() + 72, &bits, sizeof bits);
    std::memcpy(header.data() + 70, &type, sizeof type);
    const std::array<float, 3> numbers = {offset, slope, intercept};
    std::memcpy(header.data(), &size, sizeof size);
    std::memcpy(header.data() + 108, numbers.data(), sizeof numbers);
    header.replace(344, 3, "n+1");
    return place(header + samples, Volume_format::NIFTI);
  };
  EXPECT_EQ(nifti(352, 0, 0), "header 352");
  EXPECT_EQ(nifti(352, 1, 0), "header 352");
  EXPECT_EQ(nifti(352, 0, 5), "header 352") << "without a slope there is no intercept";
  EXPECT_EQ(nifti(352, 1, 0, 4), "elsewhere") << "the reader says float, and these are integers of 16 bits";
  for (const auto& [offset, slope, intercept] : {std::array<float, 3>{352, 2, 0}, {352, 1, 1}, {353, 1, 0}})
    EXPECT_EQ(nifti(offset, slope, intercept), "elsewhere");
}

TEST_F(Program_volume_io, a_volume_is_the_same_in_its_file_and_through_a_reader) {
  const Volume volume = sampled(rotated_lattice());
  for (const std::string name : {"a.mha", "a.mhd", "a.nrrd", "a.nii"}) {
    write_volume(path(name), volume, true);
    const auto format = name == "a.nrrd"  ? equiaffine::Volume_format::NRRD
                        : name == "a.nii" ? equiaffine::Volume_format::NIFTI
                                          : equiaffine::Volume_format::META;
    constexpr std::size_t type_float = 8;
    const auto data = equiaffine::find_raw_data(path(name), format, type_float, volume.values.size());
    ASSERT_TRUE(data) << name;
    std::ifstream file(data->path, std::ios::binary);
    file.seekg(std::streamoff(data->first));
    std::vector<float> samples(volume.values.size());
    file.read(reinterpret_cast<char*>(samples.data()), std::streamsize(samples.size() * sizeof(float)));
    for (const auto where : {equiaffine::Samples_in::FILE, equiaffine::Samples_in::MEMORY})
      EXPECT_EQ(read_volume(path(name), where).to_volume().values, std::vector<double>(samples.begin(), samples.end()));
    for (std::size_t n = 0; n < samples.size(); ++n) EXPECT_EQ(samples[n], float(volume.values[n])) << name;
  }
}

} // namespace volume_io_data_files_test
