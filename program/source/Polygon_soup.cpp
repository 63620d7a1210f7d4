// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/Polygon_soup.h"

#include "system/Shared_memory.h"
#include "system/child_process.h"
#include "system/file_format.h"
#include "system/resources.h"
#include <equiaffine/base/Input_error.h>

#include <CGAL/IO/polygon_soup_io.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <system_error>

namespace equiaffine {

namespace {

/// The words of a shared soup: the numbers of points and polygons, three coordinates per point, and per polygon the
/// number of its points and their positions.
using Word = std::uint64_t;

static_assert(sizeof(Word) == sizeof(double));

/// Copies a soup to shared memory.
void share(const Polygon_soup& soup, Shared_memory& memory) {
  std::vector<Word> words = {soup.points.size(), soup.polygons.size()};
  for (const Kernel::Point_3& p : soup.points)
    for (int axis = 0; axis < 3; ++axis) words.push_back(std::bit_cast<Word>(p[axis]));
  for (const auto& polygon : soup.polygons) {
    words.push_back(polygon.size());
    words.insert(words.end(), polygon.begin(), polygon.end());
  }
  std::memcpy(memory.allocate(words.size() * sizeof(Word)), words.data(), words.size() * sizeof(Word));
}

Polygon_soup soup_in(Shared_memory& memory) {
  const std::byte* place = memory.data();
  const auto next = [&place] {
    Word word;
    std::memcpy(&word, place, sizeof word);
    place += sizeof word;
    return word;
  };
  const auto coordinate = [&next] { return std::bit_cast<double>(next()); };
  Polygon_soup soup;
  const Word number_of_points = next(), number_of_polygons = next();
  soup.points.reserve(number_of_points);
  for (Word i = 0; i < number_of_points; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    soup.points.emplace_back(x, y, z);
  }
  soup.polygons.resize(number_of_polygons);
  for (auto& polygon : soup.polygons) {
    polygon.resize(next());
    for (std::size_t& position : polygon) position = next();
  }
  return soup;
}

/// Whether a word of a face in an OBJ file begins with an integer that ends at a slash or with the word. CGAL's reader
/// takes the integer part of other numbers.
bool is_position(const std::string& word) {
  std::size_t digits = word.starts_with('-') ? 1 : 0;
  const std::size_t begin = digits;
  while (digits < word.size() && std::isdigit(static_cast<unsigned char>(word[digits]))) ++digits;
  return digits > begin && (digits == word.size() || word[digits] == '/');
}

void check_faces_of_OBJ(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    for (std::string next; line.ends_with('\\') && std::getline(file, next); ++number)
      line.replace(line.size() - 1, 1, ' ' + next); // the line goes on
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word != "f") continue;
    while (words >> word && word[0] != '#')
      if (!is_position(word))
        fail_to_read_mesh(path, "a face in line " + std::to_string(number) + " has a vertex that is no integer",
                          "correct it");
  }
}

} // namespace

void fail_to_read_mesh(const std::string& path, const std::string& reason, const std::string& advice) {
  throw Input_error("cannot read the mesh " + (path == "-" ? "on standard input" : "'" + path + "'") + ": " + reason +
                    "; " + advice);
}

Polygon_soup read_foreign_soup(const std::string& path) {
  if (file_format(path) == File_format::OBJ) check_faces_of_OBJ(path);
  Polygon_soup soup;
  if (!CGAL::IO::read_polygon_soup(path, soup.points, soup.polygons))
    fail_to_read_mesh(path, "its content is not understood", "get the complete file again");
  return soup;
}

Polygon_soup make_in_child(const std::string& path, const std::function<Polygon_soup()>& make) {
  // A vertex or a face takes at least 6 bytes in a file, and up to 50 in each of three copies. Reading quadrangles and
  // cutting them takes a quarter of this time. A file that is larger than the memory is not read.
  constexpr double seconds = 10, bytes_per_second = 2e6, memory_for_small_files = 1 << 28, memory_per_byte = 32;
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  const double size = error ? 0 : std::min(double(bytes), physical_memory());
  Shared_memory memory;
  try {
    run_in_child([&] { share(make(), memory); },
                 {seconds + size / bytes_per_second, memory_for_small_files + memory_per_byte * size});
  } catch (const Child_failure& failure) {
    fail_to_read_mesh(path, std::string("the reader of this format ") + failure.what(), failure.advice());
  } catch (const std::bad_alloc&) {
    fail_to_read_mesh(path, "it does not fit into memory", "simplify it");
  }
  return soup_in(memory);
}

} // namespace equiaffine
