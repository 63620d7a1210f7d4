// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/volume_io_fixture.h"
#include "system/process.h"
#include "volume/Shared_volume.h"
#include "volume/data_files.h"
#include "volume/volume_formats.h"
#include "volume/volume_io.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace volume_io_vti_test {

using namespace volume_io_fixture;

#ifdef EQUIAFFINE_WITH_VTK

std::string vti(const std::string& arrays) {
  return "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
         "<ImageData WholeExtent=\"1 2 3 4 -1 1\" Origin=\"10 20 30\" Spacing=\"0.5 1.5 2\" "
         "Direction=\"0 1 0 1 0 0 0 0 1\">\n<Piece Extent=\"1 2 3 4 -1 1\">\n" +
         arrays + "</Piece>\n</ImageData>\n</VTKFile>\n";
}

std::string data_array(const std::string& attributes, const std::string& numbers) {
  return "<DataArray type=\"Int16\" format=\"ascii\" " + attributes + ">" + numbers + "</DataArray>\n";
}

TEST_F(Program_volume_io, a_vti_file_has_its_extent_and_directions) {
  write_file("a.vti", vti("<PointData>" + data_array("Name=\"f\"", "1 2 3 4 5 6 7 8 9 10 11 -12") + "</PointData>"));
  const Volume volume = read_volume(path("a.vti")).to_volume();
  EXPECT_EQ(volume.values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, -12}));
  // Node (1, 3, -1) of the extent; x and y are exchanged by the directions.
  EXPECT_EQ(volume.lattice.point(0, 0, 0), Point_3(10 + 3 * 1.5, 20 + 0.5, 30 - 2));
  EXPECT_EQ(volume.lattice.point(1, 1, 2), Point_3(10 + 4 * 1.5, 20 + 2 * 0.5, 30 + 2));
}

/// A VTI file of 2 x 3 x 2 floats, appended as they are in memory, in which one text replaces another.
std::string appended_vti(const std::string& old = {}, const std::string& replacement = {}) {
  std::string text = R"(<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<ImageData WholeExtent="1 2 3 5 -1 0" Origin="1 2 3" Spacing="2 1 4">
<Piece Extent="1 2 3 5 -1 0">
<PointData Scalars="f">
<DataArray type="Float64" Name="g" format="appended" offset="56"/>
<DataArray type="Float32" Name="f" format="appended" offset="0"/>
</PointData>
</Piece>
</ImageData>
<AppendedData encoding="raw">
_)";
  if (const auto place = text.find(old); !old.empty()) text.replace(place, old.size(), replacement);
  const std::uint64_t length = 12 * sizeof(float);
  text.append(reinterpret_cast<const char*>(&length), sizeof length);
  for (int n = 1; n <= 12; ++n) {
    const auto sample = float(n);
    text.append(reinterpret_cast<const char*>(&sample), sizeof sample);
  }
  const std::uint64_t other_length = 12 * sizeof(double);
  text.append(reinterpret_cast<const char*>(&other_length), sizeof other_length);
  return text + std::string(other_length, '\1') + "\n</AppendedData>\n</VTKFile>\n";
}

TEST_F(Program_volume_io, the_samples_of_a_vti_file_may_stay_there) {
  constexpr std::size_t type_float = 8;
  const auto place = [&](const std::string& text) {
    write_file("a.vti", text);
    const auto data = equiaffine::find_raw_data(path("a.vti"), equiaffine::Volume_format::VTI, type_float, 12);
    return data ? data->first : 0;
  };
  EXPECT_EQ(place(appended_vti()), appended_vti().find("\n_") + 2 + sizeof(std::uint64_t));
  const Volume volume = read_volume(path("a.vti")).to_volume();
  EXPECT_EQ(volume.values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  EXPECT_EQ(volume.lattice.point(1, 2, 1), Point_3(1 + 2 * 2, 2 + 5, 3));
  const std::array<std::array<const char*, 2>, 10> changes = {{{"LittleEndian", "BigEndian"},
                                                               {"UInt64\"", "UInt64\" compressor=\"zlib\""},
                                                               {"WholeExtent=\"1 2", "WholeExtent=\"0 2"},
                                                               {"<Piece", "<Piece Extent=\"1 2 3 5 -1 0\"/><Piece"},
                                                               {"Scalars=\"f\"", ""},
                                                               {"Scalars=\"f\"", "Scalars=\"g\""},
                                                               {"\"Float32\"", "\"Float32\" NumberOfComponents=\"3\""},
                                                               {"\"0\"/>", "\"-8\"/>"},
                                                               {"offset=\"0\"", "offset=\"99999\""},
                                                               {"encoding=\"raw\"", "encoding=\"base64\""}}};
  for (const auto& [old, replacement] : changes) EXPECT_EQ(place(appended_vti(old, replacement)), 0u) << replacement;
}

TEST_F(Program_volume_io, a_vti_file_whose_arrays_end_early_is_refused) {
  const std::string whole = appended_vti();
  const std::size_t end = whole.find("\n</AppendedData");
  write_file("a.vti", whole);
  EXPECT_EQ(read_volume(path("a.vti")).lattice().size(), (Lattice::Size{2, 3, 2}));
  for (const std::size_t missing : {std::size_t(1), std::size_t(20), std::size_t(96), std::size_t(130)})
    for (const std::string& rest : {std::string(), whole.substr(end)}) {
      write_file("a.vti", whole.substr(0, end - missing - 1) + rest);
      expect_reading_error("a.vti", "the data are damaged or shorter than stated");
    }
  const std::string text = "RwAAAA=="; // the length 71, and no byte
  for (const std::string& numbers : {text, std::string("R"), std::string()}) {
    write_file("b.vti", vti("<PointData><DataArray type=\"Int16\" Name=\"f\" format=\"binary\">" + numbers +
                            "</DataArray></PointData>"));
    expect_reading_error("b.vti", "the data are damaged or shorter than stated");
  }
}

TEST_F(Program_volume_io, a_vti_file_with_numbers_in_cells_has_nodes_at_their_centers) {
  const std::string text = "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
                           "<ImageData WholeExtent=\"1 3 0 2 0 2\" Origin=\"10 20 30\" Spacing=\"2 4 8\">\n"
                           "<Piece Extent=\"1 3 0 2 0 2\">\n<CellData>" +
                           data_array("Name=\"f\"", "1 2 3 4 5 6 7 8") + "</CellData></Piece></ImageData></VTKFile>\n";
  write_file("cells.vti", text);
  const Volume volume = read_volume(path("cells.vti")).to_volume();
  EXPECT_EQ(volume.values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(volume.lattice.point(0, 0, 0), Point_3(10 + 3, 20 + 2, 30 + 4));
  EXPECT_EQ(volume.lattice.point(1, 1, 1), Point_3(10 + 5, 20 + 6, 30 + 12));
}

TEST_F(Program_volume_io, a_vti_file_may_decompress_to_what_its_header_says) {
  const Lattice lattice(compressible_size, CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  write_volume(path("zeros.vti"), {lattice, std::vector<double>(lattice.number_of_nodes())}, false);
  equiaffine::Shared_volume volume;
  equiaffine::run_in_child(
      [&] { equiaffine::read_vti_volume(path("zeros.vti"), equiaffine::Samples_in::MEMORY, {}, volume); },
      little_memory);
  EXPECT_EQ(volume.lattice().size(), compressible_size);
}

TEST_F(Program_volume_io, a_vti_header_with_damaged_fields_is_refused) {
  const auto vti = [](const std::string& extent, const std::string& spacing, const std::string& type) {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
           "<ImageData WholeExtent=\"" +
           extent + "\" Origin=\"0 0 0\" Spacing=\"" + spacing +
           "\">"
           "<Piece Extent=\"" +
           extent + "\"><PointData Scalars=\"f\"><DataArray type=\"" + type +
           "\" Name=\"f\" format=\"ascii\">1 2 3 4 5 6 7 8</DataArray></PointData></Piece></ImageData></VTKFile>\n";
  };
  const auto expect_error_of = [&](const std::string& text, const std::string& part) {
    write_file("wrong.vti", text);
    expect_reading_error("wrong.vti", part);
  };
  const std::string unit = "0 1 0 1 0 1";
  write_file("right.vti", vti(unit, "1 1 1", "Float32"));
  EXPECT_EQ(read_volume(path("right.vti")).to_volume().values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8}));
  const std::string largest = "0 2147483647 ";
  expect_error_of(vti(largest + largest + largest, "1 1 1", "Float32"), "do not fit into memory");
  expect_error_of(vti("1 0 0 1 0 1", "1 1 1", "Float32"), "WholeExtent '1 0 0 1 0 1'");
  expect_error_of(vti("0 1 0 1", "1 1 1", "Float32"), "WholeExtent");
  expect_error_of(vti("0 1 0 1 0 4294967297", "1 1 1", "Float32"), "WholeExtent");
  for (const char* spacing : {"1 1 nan", "1 1 inf", "1 1", "1 1 x"})
    expect_error_of(vti(unit, spacing, "Float32"), "Spacing '" + std::string(spacing) + "'");
  expect_error_of(vti(unit, "1 1 1", "String"), "a DataArray of the type 'String'");
  expect_error_of("this is no XML", "no element ImageData");
}

TEST_F(Program_volume_io, a_vti_file_needs_one_array_of_scalars_at_its_points) {
  const std::string numbers = "1 2 3 4 5 6 7 8 9 10 11 12";
  write_file("none.vti", vti(""));
  expect_reading_error("none.vti", "no data at its points or cells");
  write_file("two.vti", vti("<PointData>" + data_array("Name=\"f\"", numbers) + data_array("Name=\"g\"", numbers) +
                            "</PointData>"));
  expect_reading_error("two.vti", "marked as scalars");
  write_file("marked.vti", vti("<PointData Scalars=\"g\">" + data_array("Name=\"f\"", numbers) +
                               data_array("Name=\"g\"", "0 2 3 4 5 6 7 8 9 10 11 12") + "</PointData>"));
  EXPECT_EQ(read_volume(path("marked.vti")).to_volume().values[0], 0);
  write_file(
      "vector.vti",
      vti("<PointData>" + data_array("Name=\"f\" NumberOfComponents=\"2\"", numbers + " " + numbers) + "</PointData>"));
  expect_reading_error("vector.vti", "2 components; choose one with --component N, from 1 to 2");
  const Volume second = read_volume(path("vector.vti"), equiaffine::Samples_in::FILE, {2}).to_volume();
  EXPECT_EQ(second.values, (std::vector<double>{2, 4, 6, 8, 10, 12, 2, 4, 6, 8, 10, 12}));
  write_file("short.vti", vti("<PointData>" + data_array("Name=\"f\"", "1 2 3 4 5") + "</PointData>"));
  expect_reading_error("short.vti", "damaged");
  write_file("text.vti", "this is no XML");
  expect_reading_error("text.vti", "ImageData");
}

#endif

} // namespace volume_io_vti_test
