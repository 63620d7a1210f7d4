// SPDX-License-Identifier: GPL-3.0-or-later
// Declarations that code on the pages assumes, for code_blocks.py, and all public headers. There are no definitions,
// since nothing is linked.
#ifndef CGAL_LINKED_WITH_TBB // pages use threads
#define CGAL_LINKED_WITH_TBB
#endif
#include "all_headers.h"

#include <CGAL/Point_set_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR >= CGAL_VERSION_NUMBER(6, 1, 0)
#include <CGAL/Isosurfacing_3/Cartesian_grid_3.h>
#include <CGAL/Isosurfacing_3/Dual_contouring_domain_3.h>
#include <CGAL/Isosurfacing_3/Gradient_function_3.h>
#include <CGAL/Isosurfacing_3/Value_function_3.h>
#include <CGAL/Isosurfacing_3/dual_contouring_3.h>
#endif

#include <cstdio>
#include <map>
#include <span>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = boost::graph_traits<Mesh>::vertex_descriptor;

// A function, and points.
extern const equiaffine::Analytic_function_traits_3<Kernel, equiaffine::analytic_functions::Torus> traits;
extern const Kernel::Point_3 p;
extern std::vector<Kernel::Point_3> points;
extern std::vector<std::vector<std::size_t>> polygons;

// Meshes.
extern Mesh mesh;
extern const Mesh part, whole;
extern Mesh::Property_map<Vertex, Kernel::Vector_3> normals;

// Samples.
extern const std::span<const float> values;
extern const std::size_t nx, ny, nz;
extern const equiaffine::Volume_3<Kernel> volume;
extern const double isovalue, level;
extern const equiaffine::Smoothing_decision decision;
extern const equiaffine::Sampled_function_traits_3<Kernel> function;
