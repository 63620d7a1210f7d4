// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/commands.h"
#include "program/errors_fixture.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <string>

namespace errors_test {

using namespace equiaffine::test;
using namespace errors_fixture;

TEST_F(Program_errors, no_command_is_told_in_one_line) {
  expect_error({}, {"the command is missing; use mesh, evaluate, sample, view, annotate, register or symmetries",
                    "see 'equiaffine --help'"});
}

TEST_F(Program_errors, an_unknown_command_or_option_is_named_and_the_nearest_suggested) {
  expect_error({"mehs"}, {"'mehs'", "did you mean 'mesh'?", "equiaffine --help"});
  expect_error(mesh_of("x") + box + Arguments{"--resolutoin", "64"},
               {"'--resolutoin'", "did you mean '--resolution'?", "equiaffine mesh --help"});
  expect_error(mesh_of("x") + box + Arguments{"--res", "64"}, {"'--res'", "did you mean '--resolution'?"});
  expect_error(mesh_of("x") + box + Arguments{"--leve=1"}, {"'--leve=1'", "did you mean '--level'?"});
  expect_error({"--level", "1", "mesh"}, {"'--level'", "before the command"});
  expect_error({"--", "view", "m.ply", "-o"}, {"'--'", "before the command"});
  expect_error(mesh_of("x") + box + Arguments{"stray"}, {"unexpected word 'stray'"});
  expect_error({"sample", "--volume", "v.nrrd"}, {"unknown option '--volume'"});
}

TEST_F(Program_errors, a_file_or_formula_without_its_option_is_told_how_to_give_it) {
  expect_error({"mesh", "bunny.off"}, {"unexpected word 'bunny.off'", "--fit bunny.off", "--distance-to bunny.off",
                                       "'equiaffine annotate bunny.off -o bunny-curvatures.ply'"});
  expect_error({"mesh", "p.xyz"}, {"--fit p.xyz", "points", "annotate p.xyz -o p-curvatures.csv"});
  expect_error({"mesh", "v.nrrd", "-o", "out.ply"}, {"unexpected word 'v.nrrd'", "write --volume v.nrrd"});
  expect_error({"mesh", "x^2+y^2=1"}, {"write --function 'x^2+y^2=1'"});
  expect_error({"evaluate", "bunny.off"}, {"--fit bunny.off", "--points FILE", "annotate bunny.off"});
  expect_error({"sample", "bunny.off"}, {"--distance-to bunny.off"});
  expect_error({"sample", "v.nrrd"}, {"to mesh this volume", "mesh --volume v.nrrd"});
  expect_error({"mesh", "--fit", "bunny.off", "bunny.ply"}, {"'bunny.ply'", "name the output with -o bunny.ply"});
  expect_error({"mesh", "--fit", "bunny.off", "-o", "out.ply", "b.html"}, {"name the page with --html b.html"});
  expect_error({"view", "bunny.ply", "bunny.html"}, {"name the page with -o bunny.html"});
  expect_error({"annotate", "bunny.off", "-o", "out.ply", "b.png"}, {"name the picture with --png b.png"});
  expect_error({"bunny.off"}, {"unknown command 'bunny.off'", "equiaffine annotate bunny.off"});
  expect_error({"mesh", "--function", "x^2", "+", "y^2=1", "-o", "out.ply"},
               {"unexpected word '+'", "quote a formula with spaces"});
  expect_error({"symmetries", "x^4+y^4=1", "-o", "m.json"},
               {"'x^4+y^4=1' is not a file", "write --function 'x^4+y^4=1'"});
  expect_error({"annotate", "v.nrrd", "-o", "out.ply"}, {"'v.nrrd'", "no vertices", "equiaffine mesh --volume v.nrrd"});
  expect_error({"annotate", "x^4+y^4=1", "-o", "out.ply"}, {"'x^4+y^4=1'", "equiaffine mesh --function"});
  expect_error({"mesh", "my-file"}, {"unexpected word 'my-file'; see 'equiaffine mesh --help'"});
  expect_error({"v.nrrd"}, {"unknown command 'v.nrrd'", "equiaffine mesh --volume v.nrrd -o v.ply"});
}

TEST_F(Program_errors, an_option_of_another_command_names_that_command) {
  expect_error({"annotate", "--function", "x*y"},
               {"unknown option '--function'", "equiaffine mesh --function", "evaluate"});
  expect_error({"annotate", "--fit", "bunny.off"}, {"'--fit'", "'equiaffine annotate FILE -o OUT.ply'"});
  expect_error({"view", "a.ply", "--html", "a.html"}, {"'--html'", "-o PAGE.html"});
  expect_error({"view", "--volume", "v.nrrd"},
               {"'--volume'", "equiaffine mesh --volume FILE -o OUT.ply --html PAGE.html"});
  expect_error({"evaluate", "--function", "x", "--html=a.html"}, {"'--html=a.html'", "annotate"});
  expect_error({"sample", "--volume", "v.nrrd"}, {"unknown option '--volume'", "mesh --volume"});
}

TEST_F(Program_errors, a_file_that_has_nothing_to_show_is_told_which_command_makes_a_page) {
  expect_error({"view", "bunny.off"},
               {"'bunny.off'", "no attributes", "'equiaffine annotate bunny.off -o bunny.ply --html bunny.html'"});
  expect_error({"view", "p.xyz", "-o", "p.html"},
               {"'p.xyz'", "no faces", "'equiaffine mesh --fit p.xyz -o p.ply --html p.html'"});
  expect_error({"view", "v.nrrd", "-o", "v.html"}, {"'v.nrrd'", "mesh --volume v.nrrd", "--level"});
  add_input("p.csv", "x,y,z\n1,2,3\n");
  expect_error({"annotate", "p.csv", "-o", "o.csv", "--html", "o.html"},
               {"'p.csv'", "no faces", "'equiaffine mesh --fit p.csv -o OUT.ply --html PAGE.html'"});
}

TEST_F(Program_errors, options_of_fits_with_another_source_say_what_that_has) {
  expect_error(mesh_of("x") + box + Arguments{"--scale", "1"},
               {"--scale", "only to fits", "a formula has no points", "leave it out"});
  expect_error({"mesh", "--volume", "v.nrrd", "--noise", "1", "-o", "out.ply"}, {"--noise", "--smoothing auto"});
  expect_error({"mesh", "--distance-to", "m.off", "--scale", "1", "-o", "out.ply"},
               {"--scale", "use --fit m.off instead of --distance-to"});
}

TEST_F(Program_errors, an_unknown_name_in_a_formula_is_shown_with_a_caret) {
  expect_error(mesh_of("x + foo") + box, {"foo"}, "x + foo\n    ^\n");
}

TEST_F(Program_errors, an_unbalanced_parenthesis_is_shown_with_a_caret) {
  const Result result = run(mesh_of("sin(x") + box);
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.error.find("sin(x\n"), std::string::npos) << result.error;
  EXPECT_NE(result.error.find('^'), std::string::npos);
  EXPECT_EQ(file("out.ply"), "old");
}

TEST_F(Program_errors, a_box_is_finite_and_not_empty) {
  expect_error(mesh_of("x") + Arguments{"--box", "2", "-2", "-2", "2", "-2", "2"},
               {"--box", "empty", "XMIN 2", "XMAX -2"});
  expect_error(mesh_of("x") + Arguments{"--box", "-2", "2", "1", "1", "-2", "2"}, {"--box", "empty", "YMIN 1"});
  expect_error(mesh_of("x") + Arguments{"--box", "nan", "2", "-2", "2", "-2", "2"},
               {"--box", "'nan'", "not a finite number"});
  expect_error(mesh_of("x") + Arguments{"--box", "-inf", "2", "-2", "2", "-2", "2"},
               {"--box", "'-inf'", "not a finite number"});
  expect_error(mesh_of("x") + Arguments{"--box", "-1e308", "1e308", "-2", "2", "-2", "2"}, {"--box", "too large"});
  expect_error(mesh_of("x") + Arguments{"--box", "-2", "two", "-2", "2", "-2", "2"},
               {"--box", "'two' is not a number", "2*pi/3"});
  expect_error(mesh_of("x") + Arguments{"--box", "-pi", "2*pi", "0", "x", "-2", "2"}, {"--box", "'x' is not a number"});
  run_well({"mesh", "--function", "x-2+y+z", "-o", "box.ply", "--box", "-pi/2", "2*pi", "0", "pi", "-2", "2",
            "--resolution", "6"});
  std::filesystem::remove(folder_ / "box.ply");
  expect_error({"mesh", "--function", "x", "--box", "-2", "2", "-2", "2", "-2", "-o", "out.ply"},
               {"--box", "a value is missing before -o"});
  expect_error(mesh_of("x") + Arguments{"--box", "-2", "2", "-2"},
               {"--box", "it needs XMIN XMAX", "equiaffine mesh --help"});
  expect_error({"mesh", "--function"}, {"--function", "it needs EXPR"});
  expect_error(mesh_of("x") + box + box, {"--box", "more than once"});
  expect_error(mesh_of("x"), {"--box is missing"});
}

TEST_F(Program_errors, a_resolution_is_between_two_and_what_fits_into_memory) {
  for (const char* bad : {"1", "0", "-5", "2.5", "1e3", "many", "99999999999999999999"})
    expect_error(mesh_of("x") + box + Arguments{"--resolution", bad},
                 {"--resolution", std::string("'").append(bad).append("'")});
  expect_error(mesh_of("x") + box + Arguments{"--resolution", "1000000"},
               {"--resolution", "1000000 x", "GB of memory"});
  expect_error(mesh_of("x") + box + Arguments{"--resolution", "1000000", "--derivatives", "spline"}, {"GB of memory"});
  expect_error({"sample", "--function", "x", "--resolution", "1000000", "-o", "v.vti"}, {"--box is missing"});
  expect_error(Arguments{"sample", "--function", "x", "--resolution", "1000000", "-o", "v.vti"} + box,
               {"GB of memory"});
  expect_error(mesh_of("x") + box + Arguments{"--resolution", "64", "64"}, {"--resolution", "2 numbers"});
}

TEST_F(Program_errors, a_source_is_given_once_with_what_belongs_to_it) {
  expect_error({"mesh", "-o", "out.ply"}, {"the source is missing"});
  expect_error(mesh_of("x") + Arguments{"--volume", "v.nrrd"}, {"--function and --volume"});
  expect_error(mesh_of("x") + Arguments{"--function", "y"}, {"--function", "more than once"});
  expect_error({"mesh", "--volume", "v.nrrd", "-o", "out.ply", "--resolution", "64"},
               {"--resolution", "a volume has its own"});
  expect_error(Arguments{"mesh", "--volume", "v.nrrd", "-o", "out.ply"} + box, {"--box", "a volume has its own"});
  expect_error({"mesh", "--volume", "v.nrrd", "-o", "out.ply", "--constants", "a=1"}, {"--constants"});
  expect_error({"mesh", "--volume", "v.nrrd", "-o", "out.ply", "--derivatives", "jets"}, {"--derivatives", "jets"});
  expect_error(mesh_of("--box") + box, {"--function", "a value is missing before --box"});
  expect_error({"evaluate", "--function", "x", "--derivatives", "spline", "--points", "p.csv", "-o", "o.csv"},
               {"--box is missing"});
}

TEST_F(Program_errors, constants_are_numbers_with_names) {
  expect_error(mesh_of("a*x") + box + Arguments{"--constants", "a"}, {"--constants", "'a'", "NAME=VALUE"});
  expect_error(mesh_of("a*x") + box + Arguments{"--constants", "a=b"}, {"--constants a=b", "'b' is not a number"});
  expect_error(mesh_of("a*x") + box + Arguments{"--constants", "a=1", "a=2"},
               {"--constants a=2", "already has a value"});
  expect_error(mesh_of("a*x") + box + Arguments{"--constants", "a=inf"}, {"'inf' is not a finite number"});
  for (const char* bad : {"2*y", "1/0", "2*", "pi*b"})
    expect_error(mesh_of("a*x") + box + Arguments{"--constants", std::string("a=").append(bad)},
                 {std::string("'").append(bad).append("' is not a number"), "2*pi/3"});
}

TEST_F(Program_errors, a_transform_has_an_inverse) {
  expect_error(mesh_of("x") + box + Arguments{"--transform", "1", "2", "3", "4", "5", "6", "7", "8", "9"},
               {"--transform", "singular"});
  expect_error(mesh_of("x") + box + Arguments{"--transform", ".1", ".2", ".3", ".3", ".6", ".9", "0", "0", "1"},
               {"singular"});
  expect_error(mesh_of("x") + box + Arguments{"--transform", "0", "0", "0", "0", "1", "0", "0", "0", "1"},
               {"singular"});
  for (const char* scale : {"1e200", "1e-200"})
    expect_error(mesh_of("x") + box + Arguments{"--transform", scale, "0", "0", "0", scale, "0", "0", "0", scale},
                 {"--transform", "determinant", "choose another unit"});
  expect_error(mesh_of("x") + box + Arguments{"--transform", "1", "2"}, {"--transform", "it needs A11"});
  Arguments numbers = {"--transform", "1", "0", "0", "0", "1", "0", "0", "0", "1"};
  for (const std::string count : {"10", "11", "12", "13"}) {
    numbers.push_back("-.5");
    if (count == "12") continue;
    expect_error(mesh_of("x") + box + numbers, {"--transform: " + count + " numbers are given", "give 9", "or 12"});
  }
}

TEST_F(Program_errors, words_to_choose_from_are_listed) {
  expect_error(mesh_of("x") + box + Arguments{"--method", "cubes"}, {"--method", "'cubes'", "marching-cubes"});
  const Arguments delaunay = mesh_of("x") + box + Arguments{"--method", "delaunay"};
  expect_error(mesh_of("x") + box + Arguments{"--method", "delauney"}, {"--method", "marching-cubes or delaunay"});
  expect_error(delaunay + Arguments{"--sizing", "small"}, {"--sizing", "'small'", "uniform or euclidean or affine"});
  expect_error(delaunay + Arguments{"--clip", "cube"}, {"--clip", "'cube'", "box or ball"});
  expect_error(mesh_of("x") + box + Arguments{"--vertices", "linar"}, {"--vertices", "'linar'", "projected or linear"});
  expect_error(mesh_of("x") + box + Arguments{"--orientation", "up"}, {"--orientation", "gradient or against"});
  expect_error(mesh_of("x") + box + Arguments{"--derivatives", "exact"}, {"--derivatives", "jets or spline"});
  expect_error(mesh_of("x") + box + Arguments{"--estimator", "best"},
               {"--estimator", "compact or transformation or direct or direct-z"});
  expect_error(mesh_of("x") + box + Arguments{"--attributes", "k1,kk"}, {"--attributes", "'kk'"});
  expect_error(mesh_of("x") + box + Arguments{"--threads", "0"}, {"--threads", "'0'"});
  expect_error(mesh_of("x") + box + Arguments{"--threads", "1000000000"}, {"--threads", "'1000000000'", "1024"});
  expect_error(mesh_of("x") + box + Arguments{"--level", "high"}, {"--level", "'high'"});
  expect_error(mesh_of("x") + box + Arguments{"--color", "k1"}, {"--color", "--html"});
  expect_error(mesh_of("x") + box + Arguments{"--html", "o.html", "--color", "affine_k1"}, {"--color", "'affine_k1'"});
}

TEST_F(Program_errors, an_option_of_the_other_method_is_refused) {
  for (const char* option : {"--angle", "--radius", "--distance", "--sizing", "--clip"})
    expect_error(mesh_of("x") + box + Arguments{option, "1"},
                 {option, "it applies only to --method delaunay; add that or leave it out"});
  const Arguments delaunay = mesh_of("x") + box + Arguments{"--method", "delaunay"};
  expect_error(delaunay + Arguments{"--vertices", "linear"},
               {"--vertices", "it applies only to --method marching-cubes"});
  expect_error(delaunay + Arguments{"--resolution", "64"}, {"--resolution", "uses no grid for a formula", "--radius"});
}

TEST_F(Program_errors, parts_of_volumes_are_for_volumes_with_a_header) {
  for (const Arguments& option : {Arguments{"--component", "1"}, {"--time", "1"}, {"--allow-outside"}})
    expect_error(mesh_of("x") + box + option, {option[0], "only to --volume"});
  add_input("v.raw", "01234567");
  expect_error(
      {"mesh", "--volume", "v.raw", "--dims", "2", "2", "2", "--type", "uint8", "--time", "1", "-o", "out.ply"},
      {"--time", "no header"});
  expect_error({"mesh", "--volume", "v.mha", "--component", "0", "-o", "out.ply"}, {"--component", "'0'"});
}

TEST_F(Program_errors, bytes_that_could_upset_a_terminal_are_shown_as_codes) {
  const auto method = [&](const std::string& word) { return mesh_of("x") + box + Arguments{"--method", word}; };
  expect_error(method("\x1b[31m\a"), {"'\\x1b[31m\\x07'"});
  expect_error(method("\xff\xc3"), {"'\\xff\\xc3'"});
  expect_error(method("\xc0\xaf\xed\xa0\x80"), {"'\\xc0\\xaf\\xed\\xa0\\x80'"}); // overlong, surrogate
  expect_error(method("\xc2\x9b\xe2\x80\xae"), {"'\\xc2\\x9b\\xe2\\x80\\xae'"}); // control, direction
  expect_error(method("w\u00fcrfel \u4e16\U0001f600"), {"'w\u00fcrfel \u4e16\U0001f600'"});
  expect_error(method("two\nlines"), {"'two lines'"});
}

TEST(Program_defects, give_status_one_and_one_line) {
  struct Defect : std::streambuf {
    int_type overflow(int_type) override { throw std::logic_error("first\nsecond"); }
  } defect;
  std::ostream out(&defect);
  out.exceptions(std::ios::badbit); // lets what the buffer throws pass
  std::ostringstream error;
  EXPECT_EQ(equiaffine::run({"--version"}, {out, error}), 1);
  EXPECT_EQ(error.str(), "equiaffine: internal error: first second\n");
}

} // namespace errors_test
