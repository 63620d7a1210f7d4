// SPDX-License-Identifier: GPL-3.0-or-later
// Programs with one mistake each, chosen by the macro CASE; wrong_programs.py compiles them. The comment of a case has
// words of the first error that the compiler is to print.
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/attributes/annotate_by_fit.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/io/polygon_mesh_files.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <map>
#include <utility>

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct No_taylor {
  using FT = double;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;
  FT value(const Point_3& p) const { return p.x(); }
  CGAL::Bbox_3 bbox() const { return {}; }
};

void use([[maybe_unused]] Mesh& mesh, const CGAL::Bbox_3& box) {
  [[maybe_unused]] const auto sphere = make_analytic_traits<Kernel>(analytic_functions::Sphere{0.5}, box);
#if CASE == 1 // the points have exact coordinates, like those of Epeck
  CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3> exact;
  annotate(exact, sphere);
#elif CASE == 2  // annotate() has nothing to write to: give it property maps
  CGAL::Polyhedron_3<Kernel> polyhedron;
  annotate(polyhedron, sphere);
#elif CASE == 3  // annotate_by_fit() has nothing to write to: give it property maps
  CGAL::Polyhedron_3<Kernel> polyhedron;
  annotate_by_fit(polyhedron, {.scale = 0.1});
#elif CASE == 4  // this function does not support one of the given named parameters
  annotate(mesh, sphere, parameters::feature_curves(0.1));
#elif CASE == 5  // equiaffine does not support one of the given named parameters of CGAL
  annotate(mesh, sphere, CGAL::parameters::face_index_map(1));
#elif CASE == 6  // an argument is not a named parameter: write equiaffine::parameters::NAME(value)
  annotate(mesh, sphere, 0.1);
#elif CASE == 7  // it has no types FT, Point_3 and Vector_3; call make_analytic_traits() with f(x, y, z)
  marching_cubes([](double x, double y, double z) { return x + y + z; });
#elif CASE == 8  // it has no member taylor(p) const that returns a Jet_3<FT>
  annotate(mesh, No_taylor());
#elif CASE == 9  // the function does not accept jets: write it as a template of the type of its arguments
  marching_cubes(make_analytic_traits<Kernel>([](double x, double y, double z) { return x + y + z; }, box));
#elif CASE == 10 // this function does not support one of the given named parameters
  marching_cubes(sphere, {}, parameters::normal_map(1));
#elif CASE == 11 // this is not a property map: make one with boost::make_assoc_property_map() from a std::map
  std::map<Mesh::Vertex_index, double> values;
  annotate(mesh, sphere, parameters::vertex_affine_mean_curvature_map(values));
#elif CASE == 12 // annotate() has nothing to write to: give it property maps
  annotate(std::as_const(mesh), sphere);
#elif CASE == 13 // the arguments after the function must be a mesh of CGAL, or an isovalue with a container of points
  marching_cubes(sphere, 64);
#elif CASE == 14 // an argument is not a named parameter: write equiaffine::parameters::NAME(value)
  annotate(Mesh::Vertex_index(0), mesh, sphere, 0.1);
#elif CASE == 15 // this function takes a struct of options before its named parameters: write {} for the defaults
  fitted_structures(mesh, parameters::vertex_point_map(mesh.points()));
#elif CASE == 16 // the mesh to read into is const: give one that can be modified
  IO::read_polygon_mesh("mesh.ply", std::as_const(mesh));
#elif CASE == 17 // CGAL::Parallel_tag needs TBB, but CGAL_LINKED_WITH_TBB is not defined
  marching_cubes<CGAL::Parallel_tag>(sphere);
#elif CASE == 18 // this kernel has exact numbers, like Epeck
  make_analytic_traits<CGAL::Exact_predicates_exact_constructions_kernel>(analytic_functions::Sphere{0.5}, box);
#elif CASE == 19 // a resolution is a number of nodes: give integers
  marching_cubes(sphere, {.resolution = 64.7});
#elif CASE == 20 // or neither; then options, such as {.resolution = 64} or {}; then named parameters
  marching_cubes(sphere, mesh, parameters::vertex_status_map(1));
#endif
}
