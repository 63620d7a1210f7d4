// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/volume_io_fixture.h"
#include "volume/Shared_volume.h"
#include "volume/volume_io.h"
#include <equiaffine/base/Input_error.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace volume_io_nifti_test {

using namespace volume_io_fixture;

#ifdef EQUIAFFINE_WITH_ITK

/// The bytes of NIfTI's header that say how many axes there are and how values are scaled.
void patch_nifti(std::string& bytes, std::array<std::int16_t, 6> dimensions, float slope, float intercept) {
  std::memcpy(&bytes[40], dimensions.data(), sizeof dimensions);
  std::memcpy(&bytes[112], &slope, sizeof slope);
  std::memcpy(&bytes[116], &intercept, sizeof intercept);
}

TEST_F(Program_volume_io, a_compressed_nifti_file_is_read_although_another_one_lies_beside_it) {
  Volume volume = sampled(rotated_lattice()), other = volume;
  for (double& value : other.values) value *= 7;
  write_volume(path("a.nii.gz"), volume, false);
  write_volume(path("a.nii"), other, false);
  EXPECT_EQ(read_volume(path("a.nii.gz")).to_volume().values, volume.values);
  EXPECT_EQ(read_volume(path("a.nii")).to_volume().values, other.values);
  write_volume(path("a.nii.gz"), volume, false);
  EXPECT_EQ(read_volume(path("a.nii.gz")).to_volume().values, volume.values);
}

TEST_F(Program_volume_io, a_nifti_file_may_have_a_fourth_axis_of_one_volume_and_a_scale) {
  const Volume volume = sampled(rotated_lattice());
  write_volume(path("a.nii"), volume, false);
  std::string bytes = read_file("a.nii");
  patch_nifti(bytes, {4, 5, 4, 3, 1, 1}, 1, 0);
  write_file("single.nii", bytes);
  EXPECT_EQ(read_volume(path("single.nii")).to_volume().values, volume.values);
  patch_nifti(bytes, {4, 5, 4, 1, 3, 1}, 1, 0);
  write_file("slices.nii", bytes);
  expect_reading_error("slices.nii", "5 x 4 x 1 nodes");
  patch_nifti(bytes, {3, 5, 4, 3, 1, 1}, 2, -3);
  write_file("scaled.nii", bytes);
  const Volume scaled = read_volume(path("scaled.nii")).to_volume();
  for (std::size_t node = 0; node < volume.values.size(); ++node)
    EXPECT_EQ(scaled.values[node], 2 * volume.values[node] - 3);
}

TEST_F(Program_volume_io, a_nifti_file_may_have_volumes_and_components_of_which_one_is_read) {
  const Volume volume = sampled({{2, 2, 6}, CGAL::ORIGIN, {Vector_3(1, 0, 0), Vector_3(0, 1, 0), Vector_3(0, 0, 1)}});
  write_volume(path("a.nii"), volume, false);
  write_volume(path("a.nii.gz"), volume, false);
  std::string bytes = read_file("a.nii");
  patch_nifti(bytes, {5, 2, 2, 2, 3, 1}, 0, 7); // without a slope the intercept does not count, either
  write_file("times.nii", bytes);
  const gzFile file = gzopen(path("times.nii.gz").c_str(), "wb");
  gzwrite(file, bytes.data(), unsigned(bytes.size()));
  gzclose(file);
  patch_nifti(bytes, {5, 2, 2, 2, 1, 3}, 1, 0);
  write_file("vectors.nii", bytes);
  const auto part = [&](std::size_t n) {
    return std::vector<double>(volume.values.begin() + std::ptrdiff_t(8 * n),
                               volume.values.begin() + std::ptrdiff_t(8 * n + 8));
  };
  for (std::size_t n = 0; n < 3; ++n)
    for (const auto where : {equiaffine::Samples_in::FILE, equiaffine::Samples_in::MEMORY}) {
      EXPECT_EQ(read_volume(path("times.nii"), where, {{}, n + 1}).to_volume().values, part(n));
      EXPECT_EQ(read_volume(path("times.nii.gz"), where, {{}, n + 1}).to_volume().values, part(n));
      EXPECT_EQ(read_volume(path("vectors.nii"), where, {n + 1}).to_volume().values, part(n));
    }
  expect_reading_error("times.nii", "3 volumes; choose one with --time N, from 1 to 3");
  expect_reading_error("vectors.nii", "3 components; choose one with --component N, from 1 to 3");
}

/// Replaces a number in the header of a NIfTI file.
template <class Number>
std::string with_number(const std::string& bytes, std::size_t place, Number number) {
  std::string result = bytes;
  result.replace(place, sizeof number, reinterpret_cast<const char*>(&number), sizeof number);
  return result;
}

TEST_F(Program_volume_io, a_nifti_header_with_a_damaged_frame_is_refused) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  write_volume(path("a.nii"), sampled(rotated_lattice()), false);
  const std::string bytes = read_file("a.nii");
  const auto expect_error_of = [&](const std::string& damaged, const std::string& part) {
    write_file("damaged.nii", damaged);
    expect_reading_error("damaged.nii", part);
  };
  for (const float number : {nan, infinity, -infinity}) {
    expect_error_of(with_number(bytes, 80, number), "pixdim");
    expect_error_of(with_number(bytes, 108, number), "vox_offset");
    expect_error_of(with_number(bytes, 256, number), "quatern");
    expect_error_of(with_number(bytes, 280, number), "srow");
    expect_error_of(with_number(bytes, 292, number), "srow");
  }
  expect_error_of(with_number(bytes, 288, -1.7e38F), "srow");
  expect_error_of(with_number(bytes, 108, -352.F), "vox_offset '-352'");
  expect_error_of(with_number(bytes, 0, std::int32_t(540)), "sizeof_hdr");
  expect_error_of(with_number(bytes, 40, std::int16_t(-3)), "dim[0] '-3'");
  expect_error_of(with_number(bytes, 42, std::int16_t(0)), "dim[1] '0'");
  expect_error_of(bytes.substr(0, 100), "shorter than stated");
}

TEST_F(Program_volume_io, a_nifti_file_has_the_steps_of_its_sform_sheared_or_not) {
  write_volume(path("a.nii"), sampled(axis_parallel_lattice()), false);
  std::string bytes = read_file("a.nii");
  const std::array<float, 12> rows = {1, 0.5F, 0, 10, 0, 2, 0.25F, 20, 0, 0, 3, 30};
  std::memcpy(&bytes[280], rows.data(), sizeof rows);
  const Lattice expected({5, 4, 3}, Point_3(-10, -20, 30),
                         {Vector_3(-1, 0, 0), Vector_3(-0.5, -2, 0), Vector_3(0, -0.25, 3)});
  const auto distance = [&](std::int16_t qform, std::int16_t sform) {
    write_file("b.nii", with_number(with_number(bytes, 252, qform), 254, sform));
    return largest_distance_between_nodes(read_volume(path("b.nii")).lattice(), expected);
  };
  EXPECT_EQ(distance(0, 1), 0);
  EXPECT_EQ(distance(0, 2), 0);
  EXPECT_EQ(distance(1, 1), 0) << "the sform of the scanner comes before a qform, which cannot be sheared";
  EXPECT_GT(distance(1, 2), 1) << "the qform of the scanner comes before other sforms";
  write_file("b.nii",
             with_number(with_number(with_number(bytes, 252, std::int16_t(0)), 254, std::int16_t(1)), 123, char(3)));
  EXPECT_NEAR(read_volume(path("b.nii")).lattice().origin().z(), 0.03, 1e-12) << "micrometers become millimeters";
}

TEST_F(Program_volume_io, a_nifti_header_that_contradicts_itself_is_refused) {
  write_volume(path("a.nii"), sampled(rotated_lattice()), false);
  const std::string bytes = read_file("a.nii");
  const auto expect_error_of = [&](const std::string& damaged, const std::string& part) {
    write_file("damaged.nii", damaged);
    expect_reading_error("damaged.nii", part);
  };
  const std::string half = bytes.substr(0, 352 + (bytes.size() - 352) / 2);
  for (const int bits : {0, 8, 32})
    expect_error_of(with_number(half, 72, std::int16_t(bits)),
                    "bitpix '" + std::to_string(bits) + "'; correct it to 64");
  expect_error_of(with_number(bytes, 70, std::int16_t(16)), "bitpix '64'; correct it to 32");
  expect_error_of(with_number(bytes, 70, std::int16_t(3)), "sample type is not supported");
  expect_error_of(with_number(bytes.substr(0, bytes.size() - 340), 108, 0.F), "vox_offset '0'");
  for (const float step : {0.F, -1.F})
    for (const std::size_t axis : {1u, 2u, 3u})
      expect_error_of(with_number(bytes, 76 + 4 * axis, step), "pixdim[" + std::to_string(axis) + "] '");
}

TEST_F(Program_volume_io, coordinates_far_from_the_origin_are_refused_by_nifti) {
  const Volume volume = sampled(Lattice({2, 2, 2}, CGAL::Bbox_3(1e4 + 1. / 3, 0, 0, 1e4 + 1. / 3 + 0.01, 1, 1)));
  EXPECT_THROW(write_volume(path("a.nii"), volume, false), Input_error);
  EXPECT_NO_THROW(write_volume(path("a.nrrd"), volume, false));
}

#endif

} // namespace volume_io_nifti_test
