// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/commands.h"
#include "support/run_program.h"
#include "system/process.h"
#include <equiaffine/base/Input_error.h>

#include <CGAL/version.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <vector>

namespace errors_test {

using namespace equiaffine::test;
using Arguments = std::vector<std::string>;

const Arguments box = {"--box", "-2", "2", "-2", "2", "-2", "2"};

Arguments operator+(Arguments first, const Arguments& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Arguments mesh_of(const std::string& expression) {
  return Arguments{"mesh", "--function", expression, "-o", "out.ply"};
}

/// Everything that a user can do wrong: status 2, one line that names the thing, and nothing is written.
class Program_errors : public Program_test {
protected:
  Program_errors() {
    write_file(folder_ / "out.ply", "old");
    before_ = names();
  }

  /// `words` are in the line on standard error, which `excerpt` follows.
  void expect_error(const Arguments& arguments, const Arguments& words, const std::string& excerpt = {}) {
    const Result result = run(arguments);
    const std::size_t end = result.error.find('\n');
    const std::string line = result.error.substr(0, end);
    EXPECT_EQ(result.status, 2) << line;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(line.starts_with("equiaffine: error: ")) << result.error;
    ASSERT_NE(end, std::string::npos);
    EXPECT_EQ(result.error.substr(end + 1), excerpt);
    for (const std::string& word : words) EXPECT_NE(line.find(word), std::string::npos) << word << " in " << line;
    EXPECT_EQ(file("out.ply"), "old");
    EXPECT_EQ(names(), before_);
  }

  void add_input(const std::string& name, const std::string& text) {
    write_file(folder_ / name, text);
    before_ = names();
  }

  Arguments before_;
};
using Program_errors_long = Program_errors;

TEST_F(Program_errors, no_command_is_told_in_one_line) {
  expect_error({}, {"no command is given; use mesh, evaluate, sample, view, annotate, register or symmetries",
                    "see 'equiaffine --help'"});
}

TEST_F(Program_errors, an_unknown_command_or_option_is_named_and_the_nearest_suggested) {
  expect_error({"mehs"}, {"'mehs'", "did you mean 'mesh'?", "equiaffine --help"});
  expect_error(mesh_of("x") + box + Arguments{"--resolutoin", "64"},
               {"'--resolutoin'", "did you mean '--resolution'?", "equiaffine mesh --help"});
  expect_error(mesh_of("x") + box + Arguments{"--res", "64"}, {"'--res'", "did you mean '--resolution'?"});
  expect_error(mesh_of("x") + box + Arguments{"--isovalu=1"}, {"'--isovalu=1'", "did you mean '--isovalue'?"});
  expect_error({"--isovalue", "1", "mesh"}, {"'--isovalue'", "before the command"});
  expect_error({"--", "view", "m.ply", "-o"}, {"'--'", "before the command"});
  expect_error(mesh_of("x") + box + Arguments{"stray"}, {"'stray' is not expected"});
  expect_error({"sample", "--volume", "v.nrrd"}, {"unknown option '--volume'"});
}

TEST_F(Program_errors, a_file_or_formula_without_its_option_is_told_how_to_give_it) {
  expect_error({"mesh", "bunny.off"},
               {"'bunny.off' is not expected there", "--fit bunny.off", "--distance-to bunny.off",
                "'equiaffine annotate bunny.off -o bunny-curvatures.ply'"});
  expect_error({"mesh", "p.xyz"}, {"--fit p.xyz", "points", "annotate p.xyz -o p-curvatures.csv"});
  expect_error({"mesh", "v.nrrd", "-o", "out.ply"}, {"'v.nrrd' is not expected", "write --volume v.nrrd"});
  expect_error({"mesh", "x^2+y^2=1"}, {"write --function 'x^2+y^2=1'"});
  expect_error({"evaluate", "bunny.off"}, {"--fit bunny.off", "--points FILE", "annotate bunny.off"});
  expect_error({"sample", "bunny.off"}, {"--distance-to bunny.off"});
  expect_error({"sample", "v.nrrd"}, {"a volume already", "mesh --volume v.nrrd"});
  expect_error({"mesh", "--fit", "bunny.off", "bunny.ply"}, {"'bunny.ply'", "name the output by -o bunny.ply"});
  expect_error({"mesh", "--fit", "bunny.off", "-o", "out.ply", "b.html"}, {"name the page by --html b.html"});
  expect_error({"view", "bunny.ply", "bunny.html"}, {"name the page by -o bunny.html"});
  expect_error({"annotate", "bunny.off", "-o", "out.ply", "b.png"}, {"name the picture by --png b.png"});
  expect_error({"bunny.off"}, {"unknown command 'bunny.off'", "equiaffine annotate bunny.off"});
  expect_error({"mesh", "--function", "x^2", "+", "y^2=1", "-o", "out.ply"},
               {"'+' is not expected there", "put the formula into quotes"});
  expect_error({"symmetries", "x^4+y^4=1", "-o", "m.json"}, {"'x^4+y^4=1' is no file", "write --function 'x^4+y^4=1'"});
  expect_error({"annotate", "v.nrrd", "-o", "out.ply"}, {"'v.nrrd'", "no vertices", "equiaffine mesh --volume v.nrrd"});
  expect_error({"annotate", "x^4+y^4=1", "-o", "out.ply"}, {"'x^4+y^4=1'", "equiaffine mesh --function"});
  expect_error({"mesh", "my-file"}, {"'my-file' is not expected there; see 'equiaffine mesh --help'"});
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
  expect_error({"view", "v.nrrd", "-o", "v.html"}, {"'v.nrrd'", "mesh --volume v.nrrd", "--isovalue"});
  add_input("p.csv", "x,y,z\n1,2,3\n");
  expect_error({"annotate", "p.csv", "-o", "o.csv", "--html", "o.html"},
               {"'p.csv'", "no faces", "'equiaffine mesh --fit p.csv -o OUT.ply --html PAGE.html'"});
}

TEST_F(Program_errors, options_of_fits_with_another_source_say_what_that_has) {
  expect_error(mesh_of("x") + box + Arguments{"--scale", "1"},
               {"--scale", "--fit", "a formula has no points", "leave it out"});
  expect_error({"mesh", "--volume", "v.nrrd", "--noise", "1", "-o", "out.ply"}, {"--noise", "--smoothing auto"});
  expect_error({"mesh", "--distance-to", "m.off", "--scale", "1", "-o", "out.ply"},
               {"--scale", "use --fit m.off in place of --distance-to"});
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
  expect_error({"mesh", "-o", "out.ply"}, {"no source is given"});
  expect_error(mesh_of("x") + Arguments{"--volume", "v.nrrd"}, {"--function and --volume"});
  expect_error(mesh_of("x") + Arguments{"--function", "y"}, {"--function", "more than once"});
  expect_error({"mesh", "--volume", "v.nrrd", "-o", "out.ply", "--resolution", "64"},
               {"--resolution", "--volume has its own"});
  expect_error(Arguments{"mesh", "--volume", "v.nrrd", "-o", "out.ply"} + box, {"--box", "--volume has its own"});
  expect_error({"mesh", "--volume", "v.nrrd", "-o", "out.ply", "--set", "a=1"}, {"--set"});
  expect_error({"mesh", "--volume", "v.nrrd", "-o", "out.ply", "--derivatives", "jets"}, {"--derivatives", "jets"});
  expect_error(mesh_of("--box") + box, {"--function", "a value is missing before --box"});
  expect_error({"evaluate", "--function", "x", "--derivatives", "spline", "--points", "p.csv", "-o", "o.csv"},
               {"--box is missing"});
}

TEST_F(Program_errors, constants_are_numbers_with_names) {
  expect_error(mesh_of("a*x") + box + Arguments{"--set", "a"}, {"--set", "'a'", "name=value"});
  expect_error(mesh_of("a*x") + box + Arguments{"--set", "a=b"}, {"--set a=b", "'b' is not a number"});
  expect_error(mesh_of("a*x") + box + Arguments{"--set", "a=1", "a=2"}, {"--set a=2", "has a value already"});
  expect_error(mesh_of("a*x") + box + Arguments{"--set", "a=inf"}, {"'inf' is not a finite number"});
  for (const char* bad : {"2*y", "1/0", "2*", "pi*b"})
    expect_error(mesh_of("a*x") + box + Arguments{"--set", std::string("a=").append(bad)},
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
  expect_error(mesh_of("x") + box + Arguments{"--isovalue", "high"}, {"--isovalue", "'high'"});
  expect_error(mesh_of("x") + box + Arguments{"--color", "k1"}, {"--color", "--html"});
  expect_error(mesh_of("x") + box + Arguments{"--html", "o.html", "--color", "affine_k1"}, {"--color", "'affine_k1'"});
}

TEST_F(Program_errors, an_option_of_the_other_method_is_refused) {
  for (const char* option : {"--angle", "--radius", "--distance", "--sizing", "--clip"})
    expect_error(mesh_of("x") + box + Arguments{option, "1"},
                 {option, "it is for --method delaunay; add --method delaunay or leave it out"});
  const Arguments delaunay = mesh_of("x") + box + Arguments{"--method", "delaunay"};
  expect_error(delaunay + Arguments{"--vertices", "linear"}, {"--vertices", "it is for --method marching-cubes"});
  expect_error(delaunay + Arguments{"--resolution", "64"}, {"--resolution", "needs no grid for a formula", "--radius"});
}

TEST_F(Program_errors, criteria_of_a_Delaunay_mesh_can_be_satisfied) {
  const Arguments delaunay = mesh_of("x") + box + Arguments{"--method", "delaunay"};
  for (const char* option : {"--radius", "--distance"}) {
    for (const char* bad : {"0", "-1", "nan", "wide"})
      expect_error(delaunay + Arguments{option, bad}, {option, std::string("'").append(bad).append("'")});
    expect_error(delaunay + Arguments{option, "1e-14"}, {option, "1e-14", "GB of memory", "use larger ones"});
  }
  for (const char* bad : {"30.1", "-1", "inf"}) expect_error(delaunay + Arguments{"--angle", bad}, {"--angle", bad});
  for (const char* side : {"1e50", "1e-50"}) {
    const std::string low = std::string("-") + side;
    expect_error(mesh_of("x") + Arguments{"--method", "delaunay", "--box", low, side, low, side, low, side},
                 {"diagonal", "choose another unit"});
  }
}

TEST_F(Program_errors, a_surface_without_triangles_is_told_from_none) {
  expect_error(
      mesh_of("y^2 + z^2 - 0.2") + Arguments{"--method", "delaunay", "--box", "0", "1000", "-.5", ".5", "-.5", ".5"},
      {"no part of the surface f = 0 was found in the box", "between -0.2 and 0.3; choose a smaller --radius"});
}

TEST_F(Program_errors, facets_that_coordinates_cannot_tell_apart_are_refused) {
  expect_error(mesh_of("x - 1e17") +
                   Arguments{"--method", "delaunay", "--box", "1e17", "100000000000000016", "-1", "1", "-1", "1"},
               {"a radius of 0.32", "too small beside coordinates to 1e+17", "choose a larger --radius"});
}

TEST_F(Program_errors, a_surface_outside_the_box_is_none) {
  const Arguments delaunay = {"--method", "delaunay"};
  expect_error(mesh_of("x^2 + y^2 + z^2 + 1") + box + delaunay,
               {"no surface f = 0 in the box", "between 1 and 13", "choose another --isovalue or box"});
  expect_error(mesh_of("x^2 + y^2 + z^2 - 10") + box + delaunay + Arguments{"--clip", "ball", "--stats", "o.json"},
               {"no surface f = 0 in the ball", "between -10 and 2"});
  expect_error(mesh_of("log(-1 - x^2)") + box + delaunay, {"undefined", "choose another --isovalue or box"});
  expect_error(mesh_of("x^2 + y^2 + z^2 + 1") + box, {"no surface f = 0", "between 1 and 13"});
  expect_error(mesh_of("x") + box + Arguments{"--isovalue", "3", "--html", "o.html", "--stats", "o.json"},
               {"no surface f = 3"});
  expect_error(mesh_of("log(-1 - x^2)") + box, {"undefined"});
}

TEST_F(Program_errors_long, it_is_not_said_that_there_is_no_surface_where_none_was_found) {
  const Arguments found = {"no part of the surface f = 0 was found"};
  const Arguments unseen = mesh_of("log(1e-6-(x-1.31)^2-(y-.73)^2-(z-.1)^2)+14") + box;
  expect_error(unseen, found + Arguments{"is undefined", "a finer --resolution"});
  const Arguments delaunay = {"--method", "delaunay", "--radius", "0.3"};
  for (const Arguments& method : {Arguments{}, delaunay})
    for (const char* formula : {"(x^2+y^2+z^2-1)^2", "max(0,x^2+y^2+z^2-1)", "abs(x^2+y^2+z^2-1)", "(x+y-.3)^2+z^2"})
      expect_error(mesh_of(formula) + box + method,
                   found + Arguments{"f has zeros without a change of sign", "choose another --isovalue"});
  expect_error(mesh_of("0*x") + box, found + Arguments{"f is that at all nodes of a grid"});
  expect_error(mesh_of("x^2+y^2+z^2+1e-9") + box, {"no surface f = 0 in the box"});
}

TEST_F(Program_errors, a_pole_is_no_surface) {
  const Arguments delaunay = {"--method", "delaunay", "--radius", "0.3"};
  const Arguments words = {"no part of the surface f = 0 was found in the box",
                           "at poles or jumps only; choose another --isovalue or box"};
  for (const Arguments& method : {Arguments{}, delaunay}) expect_error(mesh_of("1/x") + box + method, words);
  expect_error(mesh_of("abs(x)/x*(1+y^2)") + box + delaunay, words);
}

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
  expect_error(mesh_of("x") + box + Arguments{"--parabolic-curves", "curves.csv"}, {"'curves.csv'", "use one of .obj"});
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
  const Arguments same = {"would replace the file that is read", "give it another name"};
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
  const Arguments same = {"would replace the file that is read", "give it another name"};
  for (const char* volume : {"one.mhd", "three.nhdr"}) expect_error({"mesh", "--volume", volume, "-o", "d.ply"}, same);
  expect_error({"mesh", "--volume", "two.mhd", "-o", "out.ply", "--stats", "s1.json"}, same);
  std::filesystem::create_directory(folder_ / "series");
  write_file(folder_ / "series/slice.ply", "x");
  before_ = names();
  expect_error({"mesh", "--volume", "series", "-o", "series/slice.ply"}, same);
  EXPECT_EQ(file("d.ply"), "01234567");
}

TEST_F(Program_errors, parts_of_volumes_are_for_volumes_with_a_header) {
  for (const Arguments& option : {Arguments{"--component", "1"}, {"--time", "1"}, {"--allow-outside"}})
    expect_error(mesh_of("x") + box + option, {option[0], "for a --volume"});
  add_input("v.raw", "01234567");
  expect_error(
      {"mesh", "--volume", "v.raw", "--dims", "2", "2", "2", "--type", "uint8", "--time", "1", "-o", "out.ply"},
      {"--time", "has none"});
  expect_error({"mesh", "--volume", "v.mha", "--component", "0", "-o", "out.ply"}, {"--component", "'0'"});
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
  expect_error(mesh_of("@") + box, {"--function", "no file name after the @"});
  expect_error(mesh_of("@..") + box, {"'..'", "it is a folder"});
  expect_error(mesh_of("@blank") + box, {"'blank'", "it holds no formula"});
  expect_error(mesh_of("@large") + box, {"'large'", "a million bytes"});
  expect_error(mesh_of("@wrong") + box, {"foo"}, "x +  foo\n     ^\n");
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
  expect_error({"view", "-o", "o.html"}, {"no mesh is given"});
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
    expect_error({"mesh", "--distance-to", "tiny.off", "-o", "out.ply"}, {"'tiny.off'", "too small", "smaller unit"});
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
    expect_error(volume + Arguments{"--spacing", "1", step, "1"}, {"'grid.raw'", "length " + step, "another unit"});
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
    expect_error({"mesh", "--distance-to", "bad.obj", "-o", "out.ply"}, {"'bad.obj'", "line", "no integer"});
  }
}

TEST_F(Program_errors, a_mesh_whose_faces_cannot_be_cut_into_triangles_is_refused) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 2 1\nv 0 1 1\n";
  for (const char* faces : {"f 4 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n", // a diagonal of the first is an edge of the second
                            "f 2 3 7 6\nf 3 4 1 2 6 5\nf 3 4 8 7\nf 4 1 5 6\n"}) {
    add_input("bad.obj", points + faces);
    // CGAL 6 cuts what CGAL 5 does not, and leaves it open.
    const char* const reason = CGAL_VERSION_MAJOR < 6 ? "cut into triangles" : "the mesh is not closed";
    expect_error({"mesh", "--distance-to", "bad.obj", "-o", "out.ply"}, {"'bad.obj'", reason});
  }
}

#ifdef EQUIAFFINE_WITH_ITK
TEST_F(Program_errors, a_volume_is_complete) {
  run_well(Arguments{"sample", "--function", "x", "--resolution", "9", "-o", "v.nrrd"} + box);
  std::filesystem::resize_file(folder_ / "v.nrrd", std::filesystem::file_size(folder_ / "v.nrrd") / 2);
  before_ = names();
  expect_error({"mesh", "--volume", "v.nrrd", "-o", "out.ply"}, {"v.nrrd", "end"});
}

TEST_F(Program_errors, a_volume_in_two_files_has_both) {
  run_well(Arguments{"sample", "--function", "x", "--resolution", "9", "-o", "v.mhd"} + box);
  std::filesystem::remove(folder_ / "v.raw");
  before_ = names();
  expect_error({"mesh", "--volume", "v.mhd", "-o", "out.ply"}, {"'v.mhd'", "'v.raw', is missing"});
}

TEST_F(Program_errors, a_header_that_ends_early_is_not_explained_by_another_error) {
  add_input("h.mha", "ObjectType = Image\nNDims = 3\n");
  const Result result = run({"mesh", "--volume", "h.mha", "-o", "out.ply"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.error, "equiaffine: error: cannot read the volume 'h.mha': its header is not understood; check that "
                          "the extension is right and the file complete\n");
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

TEST_F(Program_errors, a_page_shows_what_the_mesh_has) {
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "in.ply"} + box);
  before_ = names();
  expect_error({"view", "in.ply", "-o", "o.html", "--color", "affine_k1"},
               {"--color", "'affine_k1'", "mean_curvature"});
  expect_error({"view", "in.ply", "-o", "o.html", "--up", "w"}, {"--up", "'w'", "x or y or z or auto"});
  for (const char* option : {"--color", "--up"})
    expect_error(mesh_of("x") + box + Arguments{option, "x"}, {option, "page", "--html", "--png"});
  expect_error(mesh_of("x") + box + Arguments{"--colors", "linear"}, {"--colors", "page", "--html", "--png"});
  expect_error({"view", "in.ply", "-o", "o.html", "--colors", "red"}, {"--colors", "'red'", "equalized"});
  expect_error({"view", "in.ply"}, {"no output", "-o PAGE.html", "--png"});
}

TEST_F(Program_errors, colors_come_from_a_page_or_a_mesh) {
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "in.ply"} + box);
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "few.ply", "--attributes", "k1"} + box);
  write_file(folder_ / "other.html", "<html></html>");
  before_ = names();
  const Arguments view = {"view", "in.ply", "-o", "o.html", "--color", "mean_curvature", "--range-of"};
  expect_error(view + Arguments{"other.html"}, {"--range-of", "'other.html'", "no ranges of colors", "page"});
  expect_error(view + Arguments{"none.html"}, {"--range-of", "'none.html'"});
  expect_error(view + Arguments{"in.off"}, {"--range-of", "'in.off'", ".html", ".ply"});
  expect_error(view + Arguments{"few.ply"}, {"--range-of", "'few.ply'", "'mean_curvature'", "--color"});
  expect_error(view + Arguments{"in.ply", "--range", "1", "2"}, {"--range-of", "--range", "leave one"});
  expect_error(view + Arguments{"o.html"}, {"'o.html'", "would replace"});
}

#ifdef EQUIAFFINE_WITH_VTK
TEST_F(Program_errors, too_little_memory_for_a_picture_has_an_advice_that_view_can_follow) {
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "in.ply", "--attributes", "normal"} + box);
  const Arguments view = {"view", folder_ / "in.ply", "--png", folder_ / "p.png", "--size", "10000", "10000"};
  const auto task = [&] {
    std::ostringstream out, error;
    equiaffine::run(view, {out, error});
    throw equiaffine::Input_error("", error.str());
  };
  try {
    equiaffine::run_in_child(task, {60, 1e8}); // the bytes of the picture alone are 3e8
    FAIL() << "it fits";
  } catch (const equiaffine::Input_error& error) {
    EXPECT_EQ(error.excerpt(), "equiaffine: error: the memory of this computer is not enough; use a smaller --size, or "
                               "a mesh with fewer triangles\n");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "p.png"));
}
#endif

TEST_F(Program_errors, a_picture_has_a_size_a_range_and_vectors_that_exist) {
  const Arguments picture = mesh_of("x") + box;
  for (const char* option : {"--size", "--range"})
    expect_error(picture + Arguments{option, "200", "300"}, {option, "picture", "--png"});
  expect_error(picture + Arguments{"--arrows", "normal"}, {"--arrows", "picture", "--png"});
#ifdef EQUIAFFINE_WITH_VTK
  const Arguments png = picture + Arguments{"--png", "p.png"};
  expect_error(png + Arguments{"--size", "200", "99"}, {"--size", "'99'", "such as 100"});
  expect_error(png + Arguments{"--size", "20000", "200"}, {"--size", "'20000'", "10000"});
  expect_error(png + Arguments{"--range", "2", "2"}, {"--range", "'2'", "smaller number first"});
  expect_error(png + Arguments{"--arrows", "metric"}, {"--arrows", "'metric'", "affine_normal"});
  expect_error(picture + Arguments{"--png", "p.jpg"}, {"'p.jpg'", ".png"});
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "in.ply", "--attributes", "normal"} + box);
  before_ = names();
  expect_error({"view", "in.ply", "--png", "p.png", "--arrows", "conormal"}, {"--arrows", "'conormal'", "conormal_x"});
  expect_error({"view", "in.ply", "-o", "same", "--png", "same"}, {"two outputs", "'same'"});
#else
  expect_error(picture + Arguments{"--png", "p.png"}, {"'p.png'", "without VTK", "--html"});
#endif
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
