// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes that the program wrote, read again.
#ifndef EQUIAFFINE_TEST_SUPPORT_WRITTEN_MESHES_H
#define EQUIAFFINE_TEST_SUPPORT_WRITTEN_MESHES_H

#include "support/run_program.h"
#include <equiaffine/io/read_PLY.h>

#include <CGAL/Simple_cartesian.h>

#include <sstream>
#include <string>
#include <vector>

namespace equiaffine::test {

using Arguments = std::vector<std::string>;
using Mesh = equiaffine::Annotated_mesh_3<CGAL::Simple_cartesian<double>>;

inline Arguments operator+(Arguments first, const Arguments& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

class Written_meshes_test : public Program_test {
protected:
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
