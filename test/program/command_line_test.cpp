// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/command_line_fixture.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

namespace command_line_test {

using namespace equiaffine::test;
using namespace command_line_fixture;

TEST_F(Program_command_line, help_and_version_go_to_standard_output) {
  EXPECT_NE(run_well({"--help"}).find("Usage: equiaffine COMMAND"), std::string::npos);
  for (const char* command : {"mesh", "evaluate", "sample", "view", "annotate", "register", "symmetries"})
    EXPECT_NE(run_well({command, "--help"}).find("Usage: equiaffine " + std::string(command)), std::string::npos);
  EXPECT_TRUE(run_well({"--version"}).starts_with("equiaffine "));
}

TEST_F(Program_command_line, old_names_are_accepted_and_not_shown) {
  const Arguments named = {"mesh", "--function", "c*x", "--box",        "-1", "1",  "-1",
                           "1",    "-1",         "1",   "--resolution", "5",  "-o", "-"};
  EXPECT_EQ(run_well(named + Arguments{"--set", "c=2", "--isovalue", ".5"}),
            run_well(named + Arguments{"--constants", "c=2", "--level", ".5"}));
  for (const char* command : {"mesh", "register", "symmetries"}) {
    const std::string help = run_well({command, "--help"});
    for (const char* name : {"--isovalue", "--set", "--all ", "--no-reflection "})
      EXPECT_EQ(help.find(name), std::string::npos) << command << ' ' << name;
  }
}

TEST_F(Program_command_line, numbers_and_formulas_may_begin_with_a_minus_sign) {
  const Json plain =
      stats_of({"--function", "x^2 + y^2 + z^2 - 0.5", "--box", "-1", "1", "-1", "1", "-1", "1", "--level", "-0.25"});
  for (const char* isovalue : {"-.25", "-2.5e-1"}) {
    const Json stats = stats_of({"--function",
                                 "x^2 + y^2 + z^2 + c",
                                 "--constants",
                                 "c=-.5",
                                 "--level",
                                 isovalue,
                                 "--transform",
                                 "-1",
                                 "0",
                                 "0",
                                 "0",
                                 "-1.0",
                                 "-.0",
                                 "-0",
                                 "0",
                                 "-1e0",
                                 "--box",
                                 "-1",
                                 "1",
                                 "-1.0",
                                 "1",
                                 "-.1e1",
                                 "1"});
    EXPECT_EQ(stats["vertices"], plain["vertices"]);
    EXPECT_EQ(stats["components"], 1);
  }
  EXPECT_EQ(
      stats_of({"--function", "-x^2 - y^2 - z^2 + 1", "--box=-1.5", "1.5", "-1.5", "1.5", "-1.5", "1.5"})["components"],
      1);
}

TEST_F(Program_command_line, the_number_of_threads_changes_no_bit) {
  for (const std::string threads : {"1", "2"}) { // a page is named after the mesh
    std::filesystem::create_directory(folder_ / threads);
    run_well(Arguments{"mesh", "-o", threads + "/s.ply", "--html", threads + "/s.html", "--threads", threads} + sphere);
    run_well(Arguments{"mesh", "--derivatives", "spline", "--resolution", "24", "-o", threads + "/s.csv", "--threads",
                       threads} +
             sphere);
  }
  for (const std::string name : {"s.ply", "s.html", "s.csv"}) EXPECT_EQ(file("1/" + name), file("2/" + name)) << name;
}

TEST_F(Program_command_line, standard_output_carries_one_file_and_nothing_else) {
  run_well(Arguments{"mesh", "-o", "s.off", "--resolution", "8"} + sphere);
  EXPECT_EQ(run_well(Arguments{"mesh", "-o", "-", "--resolution", "8"} + sphere), file("s.off"));
  run_well(Arguments{"mesh", "-o", "s.off", "--resolution", "8", "--stats", "-"} + sphere);
  EXPECT_EQ(Json::parse(
                run_well(Arguments{"mesh", "-o", "s.off", "--resolution", "8", "--stats", "-"} + sphere))["components"],
            1);
}

TEST_F(Program_command_line, standard_input_may_be_a_mesh) {
  const std::string cube = "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                           "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  write_file(folder_ / "cube.off", cube);
  const Arguments options = {"--resolution", "17", "--attributes", "none", "-o", "-", "--distance-to"};
  EXPECT_EQ(run_well(Arguments{"mesh"} + options + Arguments{"-"}, cube),
            run_well(Arguments{"mesh"} + options + Arguments{"cube.off"}));
  const Arguments evaluate = {"evaluate", "--function", "x + y", "--attributes", "nx", "-o", "-", "--points"};
  run_well({"evaluate", "--function", "x", "--attributes", "none", "--points", "cube.off", "-o", "cube.ply"});
  const std::string expected = run_well(evaluate + Arguments{"cube.off"});
  EXPECT_EQ(rows(expected).size(), 8U);
  EXPECT_EQ(run_well(evaluate + Arguments{"-"}, cube), expected);
  EXPECT_EQ(run_well(evaluate + Arguments{"-"}, file("cube.ply")), expected);
}

TEST_F(Program_command_line, a_run_that_is_interrupted_leaves_nothing_behind) {
  using namespace std::chrono_literals;
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child =
        start(Arguments{"mesh", "-o", "s.ply", "--html", "s.html", "--resolution", "400", "--threads", "1"} + sphere);
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    while (names().size() < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(5ms);
    EXPECT_EQ(names().size(), 2U) << "a temporary folder for each output";
    ::kill(child, signal);
    EXPECT_EQ(wait_for(child).status, 128 + signal);
    EXPECT_EQ(names(), Arguments());
  }
}

#ifdef EQUIAFFINE_WITH_ITK
TEST_F(Program_command_line, constants_are_arithmetic_and_formulas_may_come_from_a_file) {
  write_file(folder_ / "formula", "\xef\xbb\xbfx^2 + y^2\r\n  + z^2 = r^2\r\n");
  const auto mesh = [&](const std::string& function, const std::string& radius) {
    return run_well({"mesh", "--function", function, "--constants", "r=" + radius, "--box", "-2", "2", "-2", "2", "-2",
                     "2", "--resolution", "9", "-o", "-"});
  };
  const std::string typed = mesh("x^2 + y^2 + z^2 = r^2", "1.5");
  EXPECT_EQ(typed, mesh("@formula", "1.5"));
  EXPECT_EQ(typed, mesh("@formula", "3*cos(0*pi)/2"));
}

TEST_F(Program_command_line, names_of_files_that_could_upset_a_terminal_are_shown_as_codes) {
  const std::string sampled = run_well(
      {"sample", "--function", "x", "--box", "0", "1", "0", "1", "0", "1", "--resolution", "2", "-o", "a\x1b[31m.vti"});
  EXPECT_EQ(sampled, "2 x 2 x 2 nodes\nwrote a\\x1b[31m.vti\n");
}

TEST_F(Program_command_line, files_are_named_without_the_folders_above_them) {
  std::filesystem::create_directory(folder_ / "private");
  run_well({"mesh", "--function", "x^2+y^2+z^2-1", "--box", "-2", "2", "-2", "2", "-2", "2", "--resolution", "9", "-o",
            "private/s.ply"});
  const std::string path = (folder_ / "private/s.ply").string();
  EXPECT_EQ(stats_of({"--distance-to", path, "--resolution", "12", "--html", "page.html"})["source"],
            "the distance to 's.ply'");
  run_well({"view", path, "-o", "view.html"});
  for (const char* page : {"page.html", "view.html"}) {
    EXPECT_EQ(file(page).find("private"), std::string::npos) << page;
    EXPECT_NE(file(page).find("s.ply"), std::string::npos) << page;
  }
}
#endif

} // namespace command_line_test
