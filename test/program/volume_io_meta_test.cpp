// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/volume_io_fixture.h"
#include "system/files.h"
#include "volume/Shared_volume.h"
#include "volume/volume_io.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

namespace volume_io_meta_test {

using namespace volume_io_fixture;

#ifdef EQUIAFFINE_WITH_ITK

TEST_F(Program_volume_io, a_meta_header_with_damaged_fields_is_refused) {
  const std::string data(8 * sizeof(float), '\0');
  const auto header = [](const std::string& axes, const std::string& size, const std::string& spacing,
                         const std::string& file) {
    return "ObjectType = Image\nNDims = " + axes +
           "\nBinaryData = True\nBinaryDataByteOrderMSB = False\nDimSize = " + size + "\nElementSpacing = " + spacing +
           "\nElementType = MET_FLOAT\nElementDataFile = " + file + "\n";
  };
  const auto expect_error_of = [&](const std::string& text, const std::string& part) {
    write_file("wrong.mha", text + data);
    expect_reading_error("wrong.mha", part);
  };
  write_file("right.mha", header("3", "2 2 2", "1 1 1", "LOCAL") + data);
  EXPECT_EQ(read_volume(path("right.mha")).to_volume().values, std::vector<double>(8, 0));
  for (const char* axes : {"4294967296", "-1", "0", "three", "11"}) // MetaIO takes memory for the first without end
    expect_error_of(header(axes, "2 2 2", "1 1 1", "LOCAL"), "NDims '" + std::string(axes) + "'");
  for (const char* size : {"2 2", "2 2 0", "2 2 -2", "2 2 99999999999", "2 2 2.5"})
    expect_error_of(header("3", size, "1 1 1", "LOCAL"), "DimSize '" + std::string(size) + "'");
  for (const char* spacing : {"1 1", "1 1 nan", "1 1 inf", "1 1 1e999", "1 1 x"})
    expect_error_of(header("3", "2 2 2", spacing, "LOCAL"), "ElementSpacing '" + std::string(spacing) + "'");
  write_file("list.mhd", header("3", "2 2 2", "1 1 1", "LIST"));
  expect_reading_error("list.mhd", "names 0 data files");
  write_file("list.mhd", header("3", "2 2 2", "1 1 1", "LIST") + "slice.raw\n");
  expect_reading_error("list.mhd", "'slice.raw' is missing");
}

std::string meta_of_slices(const std::string& file, const std::string& more = {}) {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nDimSize = 2 2 3\n" + more +
         "ElementType = MET_FLOAT\nElementDataFile = " + file + "\n";
}

TEST_F(Program_volume_io, the_slices_that_a_header_names_are_all_there) {
  const auto slice = [](float first) { return bytes_of(std::vector<float>{first, first + 1, first + 2, first + 3}); };
  for (const int k : {0, 1, 2}) write_file("s" + std::to_string(k) + ".raw", slice(float(4 * k)));
  const auto expect_error_of = [&](const std::string& file, const std::string& part) {
    write_file("wrong.mhd", meta_of_slices(file));
    expect_reading_error("wrong.mhd", part);
  };
  std::vector<double> expected(12);
  std::iota(expected.begin(), expected.end(), 0);
  for (const char* files : {"s%d.raw 0 2 1", "LIST\ns0.raw\ns1.raw\ns2.raw", "LIST 2D\ns0.raw\ns1.raw\ns2.raw"}) {
    write_file("right.mhd", meta_of_slices(files));
    EXPECT_EQ(read_volume(path("right.mhd")).to_volume().values, expected) << files;
  }
  expect_error_of("s%d.raw 1 3 1", "'s3.raw' is missing");
  expect_error_of("s%d.raw", "'s3.raw' is missing"); // these begin with 1
  expect_error_of("s%d.raw 0 1 1", "2 data files, but its sizes require 3");
  expect_error_of("LIST\ns0.raw\ns1.raw", "2 data files");
  for (const char* pattern : {"s%d.raw 0 2", "s%d.raw 0 2 0", "s%s.raw 0 2 1", "s%d%d.raw 0 2 1", "s%d.raw 2 0 1",
                              "s%d.raw 0 2147483647 1", "s%n.raw 0 2 1", "%"})
    expect_error_of(pattern, "the pattern of names '" + std::string(pattern) + "'");
}

TEST_F(Program_volume_io, data_outside_of_the_folder_of_their_header_are_read_if_that_is_allowed) {
  fs::create_directory(path("headers"));
  fs::create_directory(path("headers/data"));
  const std::string data = bytes_of(std::vector<float>(12, 7.F));
  write_file("data.raw", data);
  write_file("headers/data/data.raw", data);
  fs::create_symlink("../data.raw", path("headers/link.raw"));
  for (const std::string name : {"data/data.raw", "./data/../data/data.raw", "link.raw"}) {
    write_file("headers/a.mhd", meta_of_slices(name));
    EXPECT_EQ(read_volume(path("headers/a.mhd")).to_volume().values, std::vector<double>(12, 7)) << name;
  }
  for (const std::string& name : {std::string("../data.raw"), path("data.raw"), std::string("data/../../data.raw")}) {
    write_file("headers/a.mhd", meta_of_slices(name));
    write_file("headers/a.nhdr", "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 3\nencoding: raw\nendian: little\n"
                                 "data file: " +
                                     name + "\n");
    for (const char* header : {"headers/a.mhd", "headers/a.nhdr"}) {
      expect_reading_error(header, "outside its folder; move it to the header's folder, or add --allow-outside");
      const Volume volume = read_volume(path(header), equiaffine::Samples_in::FILE, {{}, {}, true}).to_volume();
      EXPECT_EQ(volume.values, std::vector<double>(12, 7)) << name;
    }
  }
  write_file("headers/a.mhd", meta_of_slices("data"));
  expect_reading_error("headers/a.mhd", "not a regular file");
}

TEST_F(Program_volume_io, a_component_and_a_volume_of_a_4D_file_can_be_chosen) {
  std::vector<float> values(24);
  std::iota(values.begin(), values.end(), 0.F);
  write_file("vectors.mha", meta_of_slices("LOCAL", "ElementNumberOfChannels = 2\n") + bytes_of(values));
  write_file("times.mha", "ObjectType = Image\nNDims = 4\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
                          "DimSize = 2 2 3 2\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n" +
                              bytes_of(values));
  for (const auto where : {equiaffine::Samples_in::FILE, equiaffine::Samples_in::MEMORY}) {
    const Volume component = read_volume(path("vectors.mha"), where, {2}).to_volume(),
                 time = read_volume(path("times.mha"), where, {{}, 2}).to_volume();
    ASSERT_EQ(component.values.size(), 12u);
    for (std::size_t n = 0; n < 12; ++n) {
      EXPECT_EQ(component.values[n], double(2 * n + 1));
      EXPECT_EQ(time.values[n], double(12 + n));
    }
  }
  expect_reading_error("vectors.mha", "choose one with --component");
  expect_reading_error("times.mha", "2 volumes; choose one with --time N, from 1 to 2");
}

TEST_F(Program_volume_io, both_files_of_a_meta_image_replace_the_old_ones_together) {
  const Volume volume = sampled(rotated_lattice());
  write_file("a.mhd", "old");
  write_file("a.raw", "old");
  equiaffine::Output_file file(path("a.mhd"));
  write_volume(file, volume, false);
  EXPECT_EQ(read_file("a.mhd"), "old");
  EXPECT_EQ(read_file("a.raw"), "old");
  file.commit();
  EXPECT_EQ(number_of_files(), 2u);
  EXPECT_EQ(read_volume(path("a.mhd")).to_volume().values, volume.values);
}

#endif

} // namespace volume_io_meta_test
