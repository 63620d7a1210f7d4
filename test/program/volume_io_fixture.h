// SPDX-License-Identifier: GPL-3.0-or-later
// A folder for files of volumes, and volumes to write there.
#ifndef EQUIAFFINE_TEST_PROGRAM_VOLUME_IO_FIXTURE_H
#define EQUIAFFINE_TEST_PROGRAM_VOLUME_IO_FIXTURE_H

#include "system/process.h"
#include "volume/volume_io.h"
#include <equiaffine/base/Input_error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace volume_io_fixture {

namespace fs = std::filesystem;

using equiaffine::Input_error;
using equiaffine::Kernel;
using equiaffine::read_volume;
using equiaffine::write_volume;
using Lattice = equiaffine::Lattice_3<Kernel>;
using Volume = equiaffine::Volume_3<Kernel>;
using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// What a reader may use before a header tells it more, far less than the samples of compressible_size take.
inline constexpr equiaffine::Child_limits little_memory = {60, 1 << 26};
inline constexpr Lattice::Size compressible_size = {220, 220, 220};

class Program_volume_io : public testing::Test {
protected:
  Program_volume_io() {
    std::string name = (fs::temp_directory_path() / "equiaffine-test-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Program_volume_io() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void write_file(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }

  std::string read_file(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  std::size_t number_of_files() const {
    return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  /// The message of the error, which is one line that names the file; nothing may be printed.
  std::string reading_error(const std::string& name) const {
    testing::internal::CaptureStderr();
    std::string message = "no error";
    try {
      read_volume(path(name));
    } catch (const Input_error& error) {
      message = error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_NE(message.find(path(name)), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }

  void expect_reading_error(const std::string& name, const std::string& part) const {
    const std::string message = reading_error(name);
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }

private:
  fs::path folder_;
};

/// All values differ, and no value is a float.
inline Volume sampled(const Lattice& lattice) {
  Volume volume{lattice, {}};
  for (std::size_t node = 0; node < lattice.number_of_nodes(); ++node) volume.values.push_back(double(node) + 1. / 3);
  return volume;
}

inline Lattice axis_parallel_lattice() {
  return {
      {5, 4, 3}, Point_3(-1.2, 0.1, 1. / 3), {Vector_3(2.4 / 63, 0, 0), Vector_3(0, 1.1 / 7, 0), Vector_3(0, 0, 2.5)}};
}

/// A lattice with a general rotation and different steps, whose axes are left-handed.
inline Lattice rotated_lattice() {
  const Vector_3 a = Vector_3(2, -1, 0.5) / std::sqrt(5.25);
  const Vector_3 b = Vector_3(1, 2, 0) / std::sqrt(5.);
  const Vector_3 c = CGAL::cross_product(b, a);
  return {{5, 4, 3}, Point_3(-10.1, 3.7, 1. / 3), {0.7 * a, 1.3 * b, 2.1 * c}};
}

inline double largest_coordinate(const Lattice& lattice) {
  const CGAL::Bbox_3 box = lattice.bbox();
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) largest = std::max({largest, std::abs(box.min(axis)), std::abs(box.max(axis))});
  return largest;
}

inline double largest_distance_between_nodes(const Lattice& a, const Lattice& b) {
  EXPECT_EQ(a.size(), b.size());
  double distance = 0;
  for (unsigned k = 0; k < a.size()[2]; ++k)
    for (unsigned j = 0; j < a.size()[1]; ++j)
      for (unsigned i = 0; i < a.size()[0]; ++i)
        distance = std::max(distance, std::sqrt(CGAL::squared_distance(a.point(i, j, k), b.point(i, j, k))));
  return distance;
}

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers, bool is_reversed = false) {
  std::string bytes;
  for (const Number number : numbers) {
    std::array<char, sizeof(Number)> word;
    std::memcpy(word.data(), &number, sizeof number);
    if (is_reversed) std::reverse(word.begin(), word.end());
    bytes.append(word.data(), word.size());
  }
  return bytes;
}

} // namespace volume_io_fixture

#endif
