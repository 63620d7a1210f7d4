// SPDX-License-Identifier: GPL-3.0-or-later
// Frames of DICOM files: their places make the lattice.
#include "volume/volume_io.h"
#include <equiaffine/base/Input_error.h>

#include <gtest/gtest.h>

#ifdef EQUIAFFINE_WITH_ITK

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace dicom_test {

namespace fs = std::filesystem;

using equiaffine::Kernel;
using equiaffine::read_volume;
using Volume = equiaffine::Volume_3<Kernel>;

std::string little_endian(std::uint32_t number, std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += char(number >> 8 * i & 0xFF);
  return text;
}

/// An element in explicit little endian.
std::string element(std::uint16_t group, std::uint16_t number, const std::string& type, std::string value) {
  if (value.size() % 2 == 1) value += type == "UI" ? '\0' : ' ';
  const bool is_long = type == "OB" || type == "OW" || type == "SQ";
  return little_endian(group, 2) + little_endian(number, 2) + type +
         (is_long ? std::string(2, '\0') + little_endian(std::uint32_t(value.size()), 4)
                  : little_endian(std::uint32_t(value.size()), 2)) +
         value;
}

std::string sequence(std::uint16_t group, std::uint16_t number, const std::vector<std::string>& items) {
  std::string value;
  for (const std::string& item : items)
    value += little_endian(0xE000FFFE, 4) + little_endian(std::uint32_t(item.size()), 4) + item;
  return element(group, number, "SQ", value);
}

std::string position(const std::string& place) { return element(0x20, 0x32, "DS", place); }
std::string scaling(const std::string& slope, const std::string& intercept) {
  return element(0x28, 0x1052, "DS", intercept) + element(0x28, 0x1053, "DS", slope);
}

constexpr std::size_t width = 4, height = 3;
constexpr const char* enhanced = "1.2.840.10008.5.1.4.1.1.2.1";
constexpr const char* secondary_capture = "1.2.840.10008.5.1.4.1.1.7.3";
constexpr const char* dose = "1.2.840.10008.5.1.4.1.1.481.2";
constexpr const char* tomography = "1.2.840.10008.5.1.4.1.1.2";

/// What a file has besides its frames.
struct Parts {
  std::string kind, spacing = {}; ///< the latter is a list of elements of group 0018
  std::string place = {};         ///< elements of group 0020
  std::string groups = {};        ///< elements behind group 0028
  std::string series = "1.2.3";
  std::size_t rows = height;
};

/// A file whose frame number f has the values 100 f + 4 j + i.
std::string dicom(const Parts& parts, const std::vector<int>& frames) {
  const std::string instance = "1.2.3.4." + std::to_string(frames.at(0));
  const std::string meta = element(2, 1, "OB", std::string("\0\1", 2)) + element(2, 2, "UI", parts.kind) +
                           element(2, 3, "UI", instance) + element(2, 0x10, "UI", "1.2.840.10008.1.2.1");
  std::string pixels;
  for (const int frame : frames)
    for (std::size_t p = 0; p < width * parts.rows; ++p)
      pixels += little_endian(std::uint32_t(100 * frame) + std::uint32_t(p), 2);
  const auto number = [](std::uint16_t tag, std::size_t value) {
    return element(0x28, tag, "US", little_endian(std::uint32_t(value), 2));
  };
  return std::string(128, '\0') + "DICM" + element(2, 0, "UL", little_endian(std::uint32_t(meta.size()), 4)) + meta +
         element(8, 0x16, "UI", parts.kind) + element(8, 0x18, "UI", instance) + element(8, 0x60, "CS", "CT") +
         parts.spacing + element(0x20, 0xE, "UI", parts.series) + parts.place + number(2, 1) +
         element(0x28, 4, "CS", "MONOCHROME2") + element(0x28, 8, "IS", std::to_string(frames.size())) +
         number(0x10, parts.rows) + number(0x11, width) + element(0x28, 0x30, "DS", R"(0.75\0.5)") + number(0x100, 16) +
         number(0x101, 16) + number(0x102, 15) + number(0x103, 1) + parts.groups + element(0x7FE0, 0x10, "OW", pixels);
}

class Program_dicom : public testing::Test {
protected:
  Program_dicom() {
    std::string name = (fs::temp_directory_path() / "equiaffine-test-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Program_dicom() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& bytes) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  void expect_error(const std::string& path, const std::string& part) const {
    try {
      read_volume(path);
      ADD_FAILURE() << "no error: " << part;
    } catch (const equiaffine::Input_error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  std::string series() const { return (folder_ / "series").string(); }

private:
  fs::path folder_;
};

/// Expects the values 100 f + 4 j + i in the slices, for these f, at (1, 2, 3) + (0.5 i, 0.75 j, height of the slice).
void expect_slices(const Volume& volume, const std::vector<int>& frames, double step) {
  ASSERT_EQ(volume.lattice.size(), (equiaffine::Lattice_3<Kernel>::Size{width, height, frames.size()}));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (std::size_t j = 0; j < height; ++j)
      for (std::size_t i = 0; i < width; ++i)
        EXPECT_EQ(volume(i, j, k), double(100 * frames[k]) + double(4 * j + i)) << k;
    const Kernel::Point_3 corner = volume.lattice.point(3, 2, double(k));
    EXPECT_NEAR(corner.x(), 2.5, 1e-12);
    EXPECT_NEAR(corner.y(), 3.5, 1e-12);
    EXPECT_NEAR(corner.z(), 3 + double(k) * step, 1e-12);
  }
}

const std::string axes = element(0x20, 0x37, "DS", R"(1\0\0\0\1\0)"), start = position(R"(1\2\3)");

std::string spacing_between_slices(const std::string& text) { return element(0x18, 0x88, "DS", text); }

TEST_F(Program_dicom, frames_lie_one_spacing_after_the_other) {
  for (const char* kind : {secondary_capture, tomography}) {
    const std::string path =
        write("a.dcm",
              dicom({kind, element(0x18, 0x50, "DS", "9") + spacing_between_slices("2.5"), start + axes}, {1, 2, 3}));
    expect_slices(read_volume(path).to_volume(), {1, 2, 3}, 2.5);
  }
  expect_slices(
      read_volume(write("named", dicom({tomography, spacing_between_slices("2"), start + axes}, {1, 2}))).to_volume(),
      {1, 2}, 2);
  expect_error(write("a.dcm", dicom({tomography, element(0x18, 0x50, "DS", "1"), start + axes}, {1, 2})),
               "both the positions (0020,0032) and the spacing (0018,0088) of its 2 frames are missing");
  expect_error(write("a.dcm", dicom({tomography, spacing_between_slices("x"), start + axes}, {1, 2})),
               "element 0018|0088 'x '; write a finite number");
}

TEST_F(Program_dicom, a_dose_has_the_offsets_of_its_frames) {
  const auto grid = [](const std::string& offsets) { return element(0x3004, 0xC, "DS", offsets); };
  expect_slices(read_volume(write("a.dcm", dicom({dose, {}, start + axes, grid(R"(0\4\8)")}, {1, 2, 3}))).to_volume(),
                {1, 2, 3}, 4);
  expect_error(write("a.dcm", dicom({dose, {}, start + axes, grid(R"(0\4\9)")}, {1, 2, 3})), "not evenly spaced");
}

/// The groups of an enhanced image, whose frames lie at these heights.
std::string enhanced_groups(const std::vector<std::string>& heights, const std::vector<std::string>& slopes = {}) {
  std::vector<std::string> frames;
  for (std::size_t f = 0; f < heights.size(); ++f)
    frames.push_back(sequence(0x20, 0x9113, {position(R"(1\2\)" + heights[f])}) +
                     (slopes.empty() ? "" : sequence(0x28, 0x9145, {scaling(slopes[f], "10")})));
  return sequence(
             0x5200, 0x9229,
             {sequence(0x20, 0x9116, {axes}) +
              sequence(0x28, 0x9110, {element(0x18, 0x88, "DS", "7") + element(0x28, 0x30, "DS", R"(0.75\0.5)")})}) +
         sequence(0x5200, 0x9230, frames);
}

TEST_F(Program_dicom, the_places_of_frames_decide_in_whatever_order_they_are) {
  const auto path_of = [&](const std::vector<std::string>& heights, const std::vector<int>& frames) {
    return write("a.dcm", dicom({enhanced, {}, {}, enhanced_groups(heights)}, frames));
  };
  expect_slices(read_volume(path_of({"3", "5", "7"}, {1, 2, 3})).to_volume(), {1, 2, 3}, 2);
  expect_slices(read_volume(path_of({"7", "5", "3"}, {1, 2, 3})).to_volume(), {3, 2, 1}, 2);
  expect_slices(read_volume(path_of({"5", "3", "9", "7"}, {1, 2, 3, 4})).to_volume(), {2, 1, 4, 3}, 2);
  expect_error(path_of({"3", "9", "5"}, {1, 2, 3}),
               "not evenly spaced: frame 3 of 'a.dcm' and frame 2 of 'a.dcm' are 4 mm apart, but frame 1 of 'a.dcm' "
               "and frame 3 of 'a.dcm' 2 mm");
  expect_error(path_of({"3", "3", "5"}, {1, 2, 3}), "frame 1 of 'a.dcm' and frame 2 of 'a.dcm' have the same position");
  expect_error(path_of({"3", "5"}, {1, 2, 3}), "it has 3 frames, but positions of 2");
}

TEST_F(Program_dicom, frames_have_scales_of_their_own) {
  const Volume volume =
      read_volume(write("a.dcm", dicom({enhanced, {}, {}, enhanced_groups({"3", "4"}, {"0.5", "2"})}, {1, 2})))
          .to_volume();
  EXPECT_EQ(volume(1, 1, 0), 0.5 * 105 + 10);
  EXPECT_EQ(volume(1, 1, 1), 2 * 205 + 10.);
}

TEST_F(Program_dicom, slices_that_do_not_belong_together_are_named) {
  const auto add = [&](const std::string& name, Parts parts, int frame) {
    parts.kind = tomography;
    return write("series/" + name, dicom(parts, {frame}));
  };
  const auto place = [](const std::string& z) { return position(R"(1\2\)" + z) + axes; };
  const std::string first = add("b.dcm", {{}, {}, place("3")}, 1);
  expect_error(first, "only one slice; name the folder");
  expect_error(series(), "only one slice");
  add("a.dcm", {{}, {}, place("5")}, 2);
  write("series/notes.txt", "two slices");
  expect_slices(read_volume(series()).to_volume(), {1, 2}, 2);
  Parts low = {{}, {}, place("7")};
  low.rows = 2;
  const std::string other = add("c.dcm", low, 3);
  expect_error(series(), "'c.dcm' has 4 x 2 pixels, but 'a.dcm' has 4 x 3");
  add("c.dcm", {{}, {}, position(R"(1\2\7)") + element(0x20, 0x37, "DS", R"(0\1\0\1\0\0)")}, 3);
  expect_error(series(), "'c.dcm' is rotated or scaled relative to 'a.dcm'");
  add("c.dcm", {{}, {}, place("7"), {}, "1.2.4"}, 3);
  expect_error(series(), "2 DICOM series");
  const std::string bytes = dicom({tomography, {}, place("7")}, {3});
  write("series/c.dcm", bytes.substr(0, 300));
  expect_error(series(), "'c.dcm' is damaged");
  write("series/c.dcm", bytes.substr(0, bytes.size() - 10));
  expect_error(series(), "'c.dcm' is damaged; get the complete");
}

} // namespace dicom_test

#endif
