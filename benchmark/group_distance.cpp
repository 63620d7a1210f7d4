// SPDX-License-Identifier: GPL-3.0-or-later
// Compares signed distances to the bunny at the nodes of a lattice with CGAL's AABB tree, OpenVDB and VTK, in one
// process with one thread. CPU times include preparation and checks. Runs alternate; figures are medians. Usage:
// benchmark_distance [folder of data] [runs]
#include "measure.h"
#ifdef EQUIAFFINE_HAS_OPENVDB
#include "peers/distance_openvdb.h"
#endif
#include <equiaffine/volume/signed_distance_volume.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/OFF.h>

#include <tbb/global_control.h>
#include <vtkCellArray.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point_3>;
using Lattice_3 = equiaffine::Lattice_3<Kernel>;
using Values = std::vector<double>;

std::array<std::size_t, 3> corners(const Mesh& mesh, Mesh::Face_index f) {
  const auto h = mesh.halfedge(f);
  return {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
}

/// The box of the mesh, widened on all sides by a tenth of its longest side, as in the program.
CGAL::Bbox_3 widened_box(const Mesh& mesh) {
  CGAL::Bbox_3 box;
  for (const Point_3& p : mesh.points()) box += p.bbox();
  const double margin = std::max({box.x_span(), box.y_span(), box.z_span()}) / 10;
  return {box.xmin() - margin, box.ymin() - margin, box.zmin() - margin,
          box.xmax() + margin, box.ymax() + margin, box.zmax() + margin};
}

/// A lattice with 129 nodes along the longest axis and equal steps along all axes, as required by OpenVDB.
Lattice_3 cubic_lattice(const Mesh& mesh) {
  const CGAL::Bbox_3 box = widened_box(mesh);
  const double h = std::max({box.x_span(), box.y_span(), box.z_span()}) / 128;
  const auto nodes = [h](double span) { return std::size_t(std::lround(span / h)) + 1; };
  return Lattice_3({nodes(box.x_span()), nodes(box.y_span()), nodes(box.z_span())},
                   Point_3(box.xmin(), box.ymin(), box.zmin()),
                   {Kernel::Vector_3(h, 0, 0), Kernel::Vector_3(0, h, 0), Kernel::Vector_3(0, 0, h)});
}

double step(const Lattice_3& lattice) { return lattice.steps()[0].x(); }

/// Every fourth node along each axis, for slow methods.
std::vector<Point_3> few_nodes(const Lattice_3& lattice) {
  std::vector<Point_3> points;
  const auto [nx, ny, nz] = lattice.size();
  for (std::size_t k = 0; k < nz; k += 4)
    for (std::size_t j = 0; j < ny; j += 4)
      for (std::size_t i = 0; i < nx; i += 4) points.push_back(lattice.point(double(i), double(j), double(k)));
  return points;
}

Values few_of(const Values& values, const Lattice_3& lattice) {
  Values few;
  const auto [nx, ny, nz] = lattice.size();
  for (std::size_t k = 0; k < nz; k += 4)
    for (std::size_t j = 0; j < ny; j += 4)
      for (std::size_t i = 0; i < nx; i += 4) few.push_back(values[lattice.index(i, j, k)]);
  return few;
}

Values ours(const Mesh& mesh, const Lattice_3& lattice, double band = std::numeric_limits<double>::infinity()) {
  return equiaffine::signed_distance_volume<CGAL::Sequential_tag>(
             mesh, lattice, [](std::size_t) {}, band)
      .values;
}

/// A straightforward implementation with CGAL.
Values by_tree(const Mesh& mesh, const std::vector<Point_3>& points) {
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
#if CGAL_VERSION_NR >= 1060000000
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
#else
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
#endif
  Tree tree(faces(mesh).first, faces(mesh).second, mesh);
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(tree);
  Values values;
  for (const Point_3& p : points) values.push_back(-int(side(p)) * std::sqrt(tree.squared_distance(p)));
  return values;
}

Values by_vtk(const Mesh& mesh, const std::vector<Point_3>& points) {
  vtkNew<vtkPoints> vertices;
  vertices->SetDataTypeToDouble();
  for (const Point_3& p : mesh.points()) vertices->InsertNextPoint(p.x(), p.y(), p.z());
  vtkNew<vtkCellArray> triangles;
  for (const auto f : mesh.faces()) {
    const auto [a, b, c] = corners(mesh, f);
    triangles->InsertNextCell({vtkIdType(a), vtkIdType(b), vtkIdType(c)});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(vertices);
  data->SetPolys(triangles);
  vtkNew<vtkImplicitPolyDataDistance> distance;
  distance->SetInput(data);
  Values values;
  for (const Point_3& p : points) values.push_back(distance->EvaluateFunction(p.x(), p.y(), p.z()));
  return values;
}

#ifdef EQUIAFFINE_HAS_OPENVDB
Values by_openvdb(const Mesh& mesh, const Lattice_3& lattice, double band_in_steps) {
  Mesh_on_lattice scaled;
  for (const Point_3& p : mesh.points()) {
    const auto v = (p - lattice.origin()) / step(lattice);
    scaled.points.push_back({v.x(), v.y(), v.z()});
  }
  for (const auto f : mesh.faces()) scaled.triangles.push_back(corners(mesh, f));
  const auto distances = openvdb_distances(scaled, lattice.size(), float(band_in_steps));
  Values values;
  for (const float d : distances) values.push_back(double(d) * step(lattice));
  return values;
}
#endif

/// Unsigned distances at 300 random elements of the list, by brute force in long double; NaN at the other elements.
Values reference(const Mesh& mesh, const std::vector<Point_3>& points) {
  using Long = CGAL::Simple_cartesian<long double>;
  const auto convert = [](const Point_3& p) { return Long::Point_3(p.x(), p.y(), p.z()); };
  std::vector<Long::Triangle_3> triangles;
  for (const auto f : mesh.faces()) {
    const auto [a, b, c] = corners(mesh, f);
    const auto point = [&](std::size_t n) { return convert(mesh.point(Mesh::Vertex_index(unsigned(n)))); };
    triangles.emplace_back(point(a), point(b), point(c));
  }
  Values distances(points.size(), std::numeric_limits<double>::quiet_NaN());
  std::mt19937 random(1);
  for (int n = 0; n < 300; ++n) {
    const std::size_t place = random() % points.size();
    long double least = std::numeric_limits<long double>::infinity();
    for (const auto& t : triangles) least = std::min(least, CGAL::squared_distance(convert(points[place]), t));
    distances[place] = double(std::sqrt(least));
  }
  return distances;
}

/// Prints the maximum error of distances within a band, in steps, and the fraction of nodes with a wrong sign.
void print_accuracy(const std::string& name, const Values& values, const Values& exact, const Values& signs, double h,
                    double band) {
  double largest = 0, wrong = 0, count = 0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!(std::abs(signs[n]) < band)) continue;
    ++count;
    wrong += (values[n] < 0) != (signs[n] < 0);
    if (!std::isnan(exact[n])) largest = std::max(largest, std::abs(std::abs(values[n]) - exact[n]) / h);
  }
  std::printf("  %-32s largest error %.2g steps, %.3g %% of the signs wrong\n", name.c_str(), largest,
              100 * wrong / count);
  figure("distance_error_" + name, largest, "steps", name == "ours" ? "<=1e-12" : "none");
}

} // namespace

int main(int argc, char** argv) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const std::string folder = argc > 1 ? argv[1] : "build/data";
  const int runs = argc > 2 ? std::atoi(argv[2]) : 3;
  Mesh bunny;
  if (!CGAL::IO::read_OFF(folder + "/meshes/bunny00.off", bunny)) return EXIT_FAILURE;
  const Lattice_3 usual({129, 129, 129}, widened_box(bunny)), cubic = cubic_lattice(bunny);
  const std::vector<Point_3> few = few_nodes(cubic);
  const double nodes = double(cubic.number_of_nodes()), h = step(cubic), everything = 1e300;
  const Values exact = reference(bunny, few), all = ours(bunny, cubic), signs = few_of(all, cubic);

  const Comparison tree = compare(
      processor_clock, runs, [&] { ours(bunny, usual); }, [&] { by_tree(bunny, few); });
  figure("distance_bunny_129", 1e6 * tree.a / double(usual.number_of_nodes()), "us_per_node", "<=1.5");
  const double per_node = double(few.size()) / double(usual.number_of_nodes());
  figure("distance_tree_per_node_over_ours", 1 / (tree.ratio * per_node), "1", ">=5");
  const Comparison vtk = compare(
      processor_clock, runs, [&] { ours(bunny, cubic); }, [&] { by_vtk(bunny, few); });
  figure("distance_vtk_per_node_over_ours", nodes / (vtk.ratio * double(few.size())), "1", ">=5");
  print_accuracy("ours", signs, exact, signs, h, everything);
  print_accuracy("cgal_tree", by_tree(bunny, few), exact, signs, h, everything);
  print_accuracy("vtk", by_vtk(bunny, few), exact, signs, h, everything);
#ifdef EQUIAFFINE_HAS_OPENVDB
  double farthest = 0;
  for (const double d : all) farthest = std::max(farthest, std::abs(d) / h);
  for (const double band : {3.0, std::ceil(farthest) + 1}) {
    const std::string name = band == 3 ? "openvdb_band_3" : "openvdb_everywhere";
    const Comparison openvdb = compare(
        processor_clock, runs, [&] { ours(bunny, cubic, band * h); }, [&] { by_openvdb(bunny, cubic, band); });
    std::printf("  band of %g steps: ours %.3g s, OpenVDB %.3g s\n", band, openvdb.a, openvdb.b);
    figure("distance_" + name + "_over_ours", 1 / openvdb.ratio, "1", "none");
    print_accuracy(name, few_of(by_openvdb(bunny, cubic, band), cubic), exact, signs, h, band * h);
  }
#else
  std::printf("OpenVDB is skipped; install Debian's libopenvdb-dev\n");
#endif
}
