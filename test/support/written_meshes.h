// SPDX-License-Identifier: GPL-3.0-or-later
// Reads meshes that the program has written.
#ifndef EQUIAFFINE_TEST_SUPPORT_WRITTEN_MESHES_H
#define EQUIAFFINE_TEST_SUPPORT_WRITTEN_MESHES_H

#include "support/run_program.h"
#include <equiaffine/io/read_points.h>

#include <CGAL/Simple_cartesian.h>

#include <sstream>
#include <string>
#include <vector>

namespace equiaffine::test {

using Mesh = equiaffine::Annotated_mesh_3<CGAL::Simple_cartesian<double>>;

class Written_meshes_test : public Program_test {
protected:
  /// Expects an error message of one line that contains these words, and no output file.
  void expect_error(const Arguments& arguments, const Arguments& words) const {
    const auto before = names();
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 2) << result.error;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.error.find('\n'), result.error.size() - 1) << result.error;
    for (const std::string& word : words)
      EXPECT_NE(result.error.find(word), std::string::npos) << word << " in " << result.error;
    EXPECT_EQ(names(), before);
  }

  Mesh mesh(const std::string& name) const {
    std::istringstream stream(file(name));
    return equiaffine::read_PLY<CGAL::Simple_cartesian<double>>(stream, name);
  }

  std::vector<double> column(const Mesh& mesh, const std::string& name) const {
    for (const auto& column : mesh.attributes.columns)
      if (column.name == name) return column.values;
    ADD_FAILURE() << "no column " << name;
    return std::vector<double>(mesh.mesh.points.size());
  }
};

} // namespace equiaffine::test

#endif
