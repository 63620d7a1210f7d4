// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/Volume_3.h>

#include <CGAL/Simple_cartesian.h>

#include <cstdlib>

int main() {
  using Kernel = CGAL::Simple_cartesian<double>;
  const equiaffine::Lattice_3<Kernel> lattice({2, 3, 4}, CGAL::Bbox_3(0, 0, 0, 1, 2, 3));
  const equiaffine::Volume_3<Kernel> volume{lattice, std::vector<double>(lattice.number_of_nodes(), 1.0)};
  return volume(1, 2, 3) == 1.0 && lattice.determinant() == 1.0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
