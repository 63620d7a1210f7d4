// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of the browser module, compiled for this machine with its baseline instruction set. The program reads
// lines `NODES FORMULA`, computes the surface of each in the box [-1.2, 1.2]^3, and prints the time in milliseconds.
#include "../../bindings/browser/module.cpp"

#include <chrono>
#include <iostream>

int main() {
  const double box[] = {-1.2, 1.2, -1.2, 1.2, -1.2, 1.2};
  int nodes = 0;
  for (std::string formula; std::cin >> nodes && std::getline(std::cin, formula);) {
    const auto begin = std::chrono::steady_clock::now();
    if (eq_mesh(formula.c_str(), "", nullptr, 0, box, nodes, 0, "affine_gaussian_curvature,status") != DONE) return 1;
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    std::cout << time.count() << std::endl;
  }
}
