// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/errors_fixture.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace errors_files_test {

using namespace equiaffine::test;
using namespace errors_fixture;

TEST_F(Program_errors, an_output_that_cannot_be_written_is_found_out) {
  expect_error(Arguments{"mesh", "--function", "x", "-o", "no/such/out.ply"} + box,
               {"'no/such/out.ply'", "does not exist"});
  expect_error(mesh_of("x") + box + Arguments{"--html", "no/page.html"}, {"no/page.html"});
  expect_error(mesh_of("x") + box + Arguments{"--stats", "."}, {"'.'", "folder"});
  expect_error(Arguments{"mesh", "--function", "x", "-o", "out.xyz"} + box, {"'out.xyz'", ".ply .off"});
  expect_error(Arguments{"mesh", "--function", "x"} + box, {"--output is missing"});
  expect_error(mesh_of("x") + box + Arguments{"--html", "out.ply"}, {"two outputs", "'out.ply'"});
  expect_error(mesh_of("x") + box + Arguments{"--html", "./out.ply"}, {"two outputs", "'./out.ply'"});
  expect_error(mesh_of("x") + box + Arguments{"--html", "new.html", "--stats", "../work/new.html"},
               {"two outputs", "'../work/new.html'"});
  expect_error(mesh_of("x") + box + Arguments{"--parabolic-curves", "out.ply"}, {"'out.ply'"});
  expect_error(mesh_of("x") + box + Arguments{"--parabolic-curves", "curves.csv"}, {"'curves.csv'", ".obj"});
  expect_error(Arguments{"sample", "--function", "x", "-o", "v.xyz"} + box, {"v.xyz", ".nrrd"});
  expect_error({"evaluate", "--function", "x", "--points", "p.csv", "-o", "o.off"}, {"o.off", ".csv or .ply"});
  const Result full = run(Arguments{"mesh", "--function", "x", "-o", "-"} + box, "", "/dev/full");
  EXPECT_EQ(full.status, 2);
  EXPECT_TRUE(full.error.starts_with("equiaffine: error: cannot write standard output")) << full.error;
  const Result help = run({"--help"}, "", "/dev/full");
  EXPECT_EQ(help.status, 2);
  EXPECT_TRUE(help.error.starts_with("equiaffine: error: cannot write standard output")) << help.error;
}

TEST_F(Program_errors, an_output_does_not_replace_what_is_read) {
  const Arguments same = {"would overwrite an input", "give it another name"};
  run_well(Arguments{"mesh", "--function", "x^2+y^2+z^2-1", "--resolution", "9", "-o", "s.ply"} + box);
  std::filesystem::create_symlink("s.ply", folder_ / "symbolic.html");
  std::filesystem::create_hard_link(folder_ / "s.ply", folder_ / "hard.html");
  add_input("p.csv", "x,y,z\n1,2,3\n");
  add_input("f.json", "x");
  for (const char* page : {"s.ply", "./s.ply", "symbolic.html", "hard.html"})
    expect_error({"view", "s.ply", "-o", page}, same + Arguments{std::string("'").append(page).append("'")});
  expect_error({"mesh", "--distance-to", "s.ply", "-o", "../work/s.ply"}, same);
  expect_error({"sample", "--distance-to", "s.ply", "-o", "s.ply"}, same);
  expect_error({"evaluate", "--function", "x", "--points", "p.csv", "-o", "p.csv"}, same);
  expect_error(mesh_of("@f.json") + box + Arguments{"--stats", "f.json"}, same);
}

TEST_F(Program_errors, an_output_does_not_replace_data_that_a_header_names) {
  const std::string header =
      "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = ";
  add_input("d.ply", "01234567");
  add_input("s1.json", "0123");
  add_input("one.mhd", header + "d.ply\n");
  add_input("two.mhd", header + "s%d.json 0 1 1\n");
  add_input("three.nhdr", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: d.ply\n");
  const Arguments same = {"would overwrite an input", "give it another name"};
  for (const char* volume : {"one.mhd", "three.nhdr"}) expect_error({"mesh", "--volume", volume, "-o", "d.ply"}, same);
  expect_error({"mesh", "--volume", "two.mhd", "-o", "out.ply", "--stats", "s1.json"}, same);
  std::filesystem::create_directory(folder_ / "series");
  write_file(folder_ / "series/slice.ply", "x");
  before_ = names();
  expect_error({"mesh", "--volume", "series", "-o", "series/slice.ply"}, same);
  EXPECT_EQ(file("d.ply"), "01234567");
}

TEST_F(Program_errors, what_looks_like_another_file_is_no_page_and_no_statistics) {
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "s.ply"} + box);
  before_ = names();
  expect_error({"view", "s.ply", "-o", "t.ply"}, {"'t.ply'", "a page", ".html"});
  expect_error(mesh_of("x") + box + Arguments{"--html", "t.png"}, {"'t.png'", "a page", ".html"});
  expect_error(mesh_of("x") + box + Arguments{"--stats", "t.html"}, {"'t.html'", "statistics", ".json"});
}

TEST_F(Program_errors, a_formula_may_come_from_a_file_that_holds_one) {
  add_input("blank", " \n\n");
  add_input("wrong", "x +\n foo\n");
  add_input("large", std::string(2'000'000, ' '));
  expect_error(mesh_of("@none") + box, {"'none'", "no such file"});
  expect_error(mesh_of("@") + box, {"--function", "the file name after @ is missing"});
  expect_error(mesh_of("@..") + box, {"'..'", "it is a folder"});
  expect_error(mesh_of("@blank") + box, {"'blank'", "it is empty"});
  expect_error(mesh_of("@large") + box, {"'large'", "more than 1000000 bytes"});
  expect_error(mesh_of("@wrong") + box, {"foo"}, "x +  foo\n     ^\n");
}

TEST_F(Program_errors, an_output_that_refuses_its_bytes_leaves_the_others_as_they_were) {
  expect_error(mesh_of("x") + box + Arguments{"--resolution", "4", "--stats", "/dev/full"}, {"'/dev/full'"});
}

TEST_F(Program_errors, a_file_to_read_holds_something) {
  for (const char* name : {"e.csv", "e.ply", "e.off"}) {
    add_input(name, "");
    expect_error({"evaluate", "--function", "x", "--points", name, "-o", "o.csv"}, {name, "it is empty"});
  }
  expect_error({"view", "e.ply", "-o", "o.html"}, {"'e.ply'", "it is empty"});
  expect_error({"mesh", "--distance-to", "e.off", "-o", "out.ply"}, {"'e.off'", "it is empty"});
  expect_error({"mesh", "--distance-to", "-", "-o", "out.ply"}, {"standard input", "it is empty"});
  expect_error({"mesh", "--distance-to", "..", "-o", "out.ply"}, {"'..'", "it is a folder"});
  expect_error({"evaluate", "--function", "x", "--points", "..", "-o", "o.csv"}, {"'..'", "it is a folder"});
  expect_error({"view", "..", "-o", "o.html"}, {"'..'", "it is a folder"});
  expect_error({"evaluate", "--distance-to", "-", "--points", "-", "-o", "o.csv"},
               {"--distance-to and --points", "standard input"});
}

TEST_F(Program_errors, a_missing_file_is_named) {
  expect_error({"mesh", "--volume", "no.nrrd", "-o", "out.ply"}, {"no.nrrd", "no such file"});
  expect_error({"mesh", "--distance-to", "no.off", "-o", "out.ply"}, {"no.off", "no such file"});
  expect_error({"evaluate", "--function", "x", "--points", "no.csv", "-o", "o.csv"}, {"no.csv", "no such file"});
  expect_error({"view", "no.ply", "-o", "o.html"}, {"no.ply", "no such file"});
  expect_error({"view", "-o", "o.html"}, {"the mesh is missing"});
}

TEST_F(Program_errors, points_are_a_table_with_a_header) {
  add_input("p.csv", "a,y,z\n1,2,3\n");
  expect_error({"evaluate", "--function", "x", "--points", "p.csv", "-o", "o.csv"}, {"p.csv", "'x'"});
  add_input("p.csv", "x,y,z\n1,2,three\n");
  expect_error({"evaluate", "--function", "x", "--points", "p.csv", "-o", "o.csv"},
               {"p.csv", "line 2", "'z'", "'three'"});
}

TEST_F(Program_errors, a_mesh_to_measure_from_is_closed) {
  add_input("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n");
  expect_error({"mesh", "--distance-to", "open.off", "-o", "out.ply"}, {"'open.off'", "not closed", "3 border edges"});
  for (const char* far : {"1e300", "-1.1e15"}) {
    add_input("far.off",
              std::string("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 ") + far + "\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
    expect_error({"mesh", "--distance-to", "far.off", "-o", "out.ply"}, {"'far.off'", "beyond 1e15", "another unit"});
  }
  for (const std::string tiny : {"1e-77", "1e-100", "1e-200"}) {
    add_input("tiny.off", "OFF\n4 4 0\n0 0 0\n" + tiny + " 0 0\n0 " + tiny + " 0\n0 0 " + tiny +
                              "\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
    expect_error({"mesh", "--distance-to", "tiny.off", "-o", "out.ply"}, {"'tiny.off'", "underflows", "smaller unit"});
  }
  add_input("short.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n");
  expect_error({"mesh", "--distance-to", "short.off", "-o", "out.ply"}, {"short.off"});
  add_input("text.stl", "this is no mesh");
  expect_error({"mesh", "--distance-to", "text.stl", "-o", "out.ply"}, {"text.stl"});
}

TEST_F(Program_errors, a_grid_has_steps_whose_fourth_powers_are_numbers) {
  add_input("grid.raw", std::string(8 * 8 * 8, '1'));
  const Arguments volume = {"mesh", "--volume", "grid.raw", "--type", "uint8",  "--dims",
                            "8",    "8",        "8",        "-o",     "out.ply"};
  for (const std::string step : {"1e-80", "1e+80"})
    expect_error(volume + Arguments{"--spacing", "1", step, "1"}, {"'grid.raw'", "is " + step, "another unit"});
  expect_error({"mesh", "--function", "x", "--derivatives", "spline", "--box", "-1e-80", "1e-80", "-1", "1", "-1", "1",
                "-o", "out.ply"},
               {"formula x", "another unit"});
}

TEST_F(Program_errors, a_face_has_vertices_that_exist) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* face : {"f 1 2 4\n", "f 1 2 99999999\n", "f 1 2 -4\n", "f 0 1 2\n"}) {
    add_input("bad.obj", triangle + face);
    expect_error({"mesh", "--distance-to", "bad.obj", "-o", "out.ply"}, {"'bad.obj'"});
  }
  for (const char* face : {"f 1 2 2.5\n", "# f\n f 1/1/1 2//2 3x\n", "f 1 - 2\n", "f 1 \\\n2 2.5\n"}) {
    add_input("bad.obj", triangle + face);
    expect_error({"mesh", "--distance-to", "bad.obj", "-o", "out.ply"}, {"'bad.obj'", "line", "not an integer"});
  }
}

TEST_F(Program_errors, a_mesh_whose_faces_touch_themselves_and_leave_it_open_is_refused) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 2 1\nv 0 1 1\n";
  for (const char* faces : {"f 4 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n", // a diagonal of the first is an edge of the second
                            "f 2 3 7 6\nf 3 4 1 2 6 5\nf 3 4 8 7\nf 4 1 5 6\n"}) {
    add_input("bad.obj", points + faces);
    expect_error({"mesh", "--distance-to", "bad.obj", "-o", "out.ply"}, {"'bad.obj'", "the mesh is not closed"});
  }
}

#ifdef EQUIAFFINE_WITH_ITK
TEST_F(Program_errors, a_volume_is_complete) {
  run_well(Arguments{"sample", "--function", "x", "--resolution", "9", "-o", "v.nrrd"} + box);
  std::filesystem::resize_file(folder_ / "v.nrrd", std::filesystem::file_size(folder_ / "v.nrrd") / 2);
  before_ = names();
  expect_error({"mesh", "--volume", "v.nrrd", "-o", "out.ply"}, {"v.nrrd", "shorter"});
}

TEST_F(Program_errors, a_volume_in_two_files_has_both) {
  run_well(Arguments{"sample", "--function", "x", "--resolution", "9", "-o", "v.mhd"} + box);
  std::filesystem::remove(folder_ / "v.raw");
  before_ = names();
  expect_error({"mesh", "--volume", "v.mhd", "-o", "out.ply"}, {"'v.mhd'", "'v.raw' is missing"});
}

TEST_F(Program_errors, a_header_that_ends_early_is_not_explained_by_another_error) {
  add_input("h.mha", "ObjectType = Image\nNDims = 3\n");
  const Result result = run({"mesh", "--volume", "h.mha", "-o", "out.ply"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.error, "equiaffine: error: cannot read the volume 'h.mha': its header cannot be read; check that "
                          "the extension is right and the file is complete\n");
  add_input("e.mhd", "");
  expect_error({"mesh", "--volume", "e.mhd", "-o", "out.ply"}, {"'e.mhd'", "it is empty"});
}
#else
TEST_F(Program_errors, a_format_that_this_program_does_not_write_is_refused_before_sampling) {
  expect_error(Arguments{"sample", "--function", "x + foo", "-o", "v.nrrd"} + box, {"'v.nrrd'", "without ITK"});
}
#endif

#ifndef EQUIAFFINE_WITH_VTK
TEST_F(Program_errors, a_VTK_format_is_refused_before_sampling) {
  expect_error(Arguments{"sample", "--function", "x + foo", "-o", "v.vti"} + box, {"'v.vti'", "without VTK"});
  expect_error(mesh_of("x + foo") + box + Arguments{"--parabolic-curves", "c.vtp"}, {"'c.vtp'", "without VTK", ".obj"});
}
#endif

} // namespace errors_files_test
