// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/volume_io_fixture.h"
#include "system/process.h"
#include "volume/Shared_volume.h"
#include "volume/volume_formats.h"
#include "volume/volume_io.h"
#include <equiaffine/base/Input_error.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace volume_io_inr_test {

using namespace volume_io_fixture;

std::string inr(const std::string& fields, const std::string& data) {
  std::string header = "#INRIMAGE-4#{\n" + fields;
  header.append(256 - header.size() - 4, '\n');
  return header + "##}\n" + data;
}

constexpr const char* inr_size = "XDIM=4\nYDIM=3\nZDIM=2\nVX=0.5\nVY=1.5\nVZ=2.5\n";
constexpr const char* inr_place = "TX=-1\nTY=2\nTZ=30\n";

TEST_F(Program_volume_io, an_inr_file_has_its_spacing_and_translation) {
  std::vector<float> values(24);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(i) - 7.25F;
  const std::string fields = std::string(inr_size) + inr_place + "VDIM=1\nTYPE=float\nPIXSIZE=32 bits\n";
  write_file("little.inr", inr(fields + "CPU=decm\n", bytes_of(values)));
  write_file("big.inr", inr(fields + "CPU=sun\n", bytes_of(values, true)));
  const std::string zipped = read_file("little.inr");
  const gzFile file = gzopen(path("zipped.inr.gz").c_str(), "wb");
  gzwrite(file, zipped.data(), unsigned(zipped.size()));
  gzclose(file);
  for (const char* name : {"little.inr", "big.inr", "zipped.inr.gz"}) {
    SCOPED_TRACE(name);
    const Volume volume = read_volume(path(name)).to_volume();
    EXPECT_EQ(volume.values, std::vector<double>(values.begin(), values.end()));
    EXPECT_EQ(volume.lattice.point(0, 0, 0), Point_3(-1, 2, 30));
    EXPECT_EQ(volume.lattice.point(3, 2, 1), Point_3(-1 + 3 * 0.5, 2 + 2 * 1.5, 30 + 2.5));
    const std::string bytes = read_file(name);
    write_file(name, bytes.substr(0, bytes.size() - 20));
    expect_reading_error(name, "not a complete INRIMAGE-4 file");
  }
}

TEST_F(Program_volume_io, an_inr_file_may_have_integers_but_no_vectors_and_no_rotation) {
  const std::vector<std::int16_t> values = {-300, 2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12,
                                            13,   14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24};
  const std::string type = "TYPE=signed fixed\nPIXSIZE=16 bits\nCPU=decm\n";
  write_file("a.inr", inr(std::string(inr_size) + "VDIM=1\n" + type, bytes_of(values)));
  EXPECT_EQ(read_volume(path("a.inr")).to_volume().values, std::vector<double>(values.begin(), values.end()));
  write_file("v.inr", inr(std::string(inr_size) + "VDIM=2\n" + type, bytes_of(values) + bytes_of(values)));
  expect_reading_error("v.inr", "2 components");
  write_file("r.inr", inr(std::string(inr_size) + "VDIM=1\nRZ=0.5\n" + type, bytes_of(values)));
  expect_reading_error("r.inr", "rotated");
}

TEST_F(Program_volume_io, an_inr_file_of_vectors_needs_the_number_of_a_component) {
  std::vector<float> values(48);
  std::iota(values.begin(), values.end(), 0.F);
  write_file("v.inr", inr(std::string(inr_size) + "VDIM=2\nTYPE=float\nPIXSIZE=32 bits\nCPU=decm\n", bytes_of(values)));
  expect_reading_error("v.inr", "2 components; choose one with --component N, from 1 to 2");
  const Volume second = read_volume(path("v.inr"), equiaffine::Samples_in::FILE, {2}).to_volume();
  for (std::size_t n = 0; n < 24; ++n) EXPECT_EQ(second.values[n], double(2 * n + 1));
  EXPECT_THROW(read_volume(path("v.inr"), equiaffine::Samples_in::FILE, {3}), Input_error);
  EXPECT_THROW(read_volume(path("v.inr"), equiaffine::Samples_in::FILE, {2, 2}), Input_error);
}

TEST_F(Program_volume_io, an_inr_header_is_told_what_is_wrong_with_which_field) {
  const std::string data = bytes_of(std::vector<float>(24, 1.5F));
  const std::string size = inr_size, type = "VDIM=1\nTYPE=float\nPIXSIZE=32 bits\nCPU=decm\n";
  write_file("right.inr", inr(size + type, data));
  EXPECT_EQ(read_volume(path("right.inr")).to_volume().values, std::vector<double>(24, 1.5));
  const auto expect_error_at = [&](const std::string& fields, const std::string& part) {
    write_file("wrong.inr", inr(fields, data));
    expect_reading_error("wrong.inr", part);
  };
  expect_error_at("XDIM=3\nYDIM=3\nZDIM=2\n" + type, "XDIM, YDIM, ZDIM"); // the file has more data than these
  expect_error_at("XDIM=24\nYDIM=1\nZDIM=1\n" + type, "24 x 1 x 1 nodes");
  expect_error_at("XDIM=5\nYDIM=3\nZDIM=2\n" + type, "have less than 120 bytes");
  expect_error_at("XDIM=-4\nYDIM=3\nZDIM=2\n" + type, "XDIM '-4'");
  expect_error_at("YDIM=3\nZDIM=2\n" + type, "no XDIM");
  expect_error_at(size + "TYPE=flxxt\nPIXSIZE=32 bits\nCPU=decm\n", "TYPE 'flxxt'");
  expect_error_at(size + "TYPE=float\nPIXSIZE=many\nCPU=decm\n", "PIXSIZE 'many'");
  expect_error_at(size + "TYPE=float\nPIXSIZE=32 bits\nCPU=cray\n", "CPU 'cray'");
  expect_error_at(size + "TYPE=signed fixed\nPIXSIZE=24 bits\nCPU=decm\n", "PIXSIZE '24 bits'");
  for (const char* spacing : {"VX=0", "VY=-1", "VZ=nan", "VX=1e999", "VX="})
    expect_error_at(size + spacing + "\n" + type, std::string(spacing, 2) + " '");
  expect_error_at(size + "TY=inf\n" + type, "TY 'inf'");
}

TEST_F(Program_volume_io, an_inr_file_has_floats_of_32_or_64_bits) {
  const std::string fields = std::string(inr_size) + "VDIM=1\nTYPE=float\nCPU=decm\n";
  for (const std::size_t bytes : {1u, 2u}) { // the data have the size that the header says
    const std::string bits = std::to_string(8 * bytes) + " bits";
    write_file("narrow.inr", inr(fields + "PIXSIZE=" + bits + "\n", std::string(24 * bytes, '\0')));
    expect_reading_error("narrow.inr", "PIXSIZE '" + bits + "'; write 32 bits or 64 bits");
  }
}

TEST_F(Program_volume_io, an_inr_file_may_decompress_to_what_its_header_says) {
  const gzFile file = gzopen(path("zeros.inr.gz").c_str(), "wb");
  const std::string header = inr("XDIM=220\nYDIM=220\nZDIM=220\nVX=1\nVY=1\nVZ=1\nVDIM=1\nTYPE=float\n"
                                 "PIXSIZE=64 bits\nCPU=decm\n",
                                 "");
  const std::string plane(220 * 220 * sizeof(double), '\0');
  gzwrite(file, header.data(), unsigned(header.size()));
  for (int k = 0; k < 220; ++k) gzwrite(file, plane.data(), unsigned(plane.size()));
  gzclose(file);
  equiaffine::Shared_volume volume;
  equiaffine::run_in_child([&] { equiaffine::read_inr_volume(path("zeros.inr.gz"), {}, volume); }, little_memory);
  EXPECT_EQ(volume.lattice().size(), compressible_size);
}

} // namespace volume_io_inr_test
