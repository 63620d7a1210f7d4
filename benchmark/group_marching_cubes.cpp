// SPDX-License-Identifier: GPL-3.0-or-later
// Compares Marching Cubes with VTK's Flying Edges, and with variants: two threads, a table that ignores ambiguities, no
// skipping of empty space. All run in one process and alternate; figures are medians of ratios of consecutive runs.
// Times are CPU times for one thread and wall times for two. VTK computes no normals, gradients or scalars. Usage:
// benchmark_marching_cubes [runs]
#include "marching_cubes_fields.h"
#include "measure.h"
#include "support/Without_bounds.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/marching_cubes/marching_cubes_of_array.h>

#include <CGAL/Simple_cartesian.h>

#include <tbb/global_control.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <random>
#include <span>
#include <string>
#include <vector>

void set_vtk_threads(int n); // vtk/threads.cpp

namespace {

using namespace equiaffine;

template <class FT>
class Flying_edges {
public:
  explicit Flying_edges(Field<FT>& field) {
    const int n = int(field.n);
    image_->SetDimensions(n, n, n);
    array_->SetArray(field.values.data(), vtkIdType(field.values.size()), 1);
    image_->GetPointData()->SetScalars(array_);
  }
  vtkIdType operator()() {
    vtkNew<vtkFlyingEdges3D> filter;
    filter->SetInputData(image_);
    filter->SetValue(0, 0);
    filter->ComputeNormalsOff();
    filter->ComputeGradientsOff();
    filter->ComputeScalarsOff();
    filter->Update();
    return filter->GetOutput()->GetNumberOfCells();
  }

private:
  vtkNew<vtkImageData> image_;
  vtkNew<std::conditional_t<std::is_same_v<FT, float>, vtkFloatArray, vtkDoubleArray>> array_;
};

template <class ConcurrencyTag, class FT>
Array_isosurface_3<FT> ours(const Field<FT>& field) {
  return marching_cubes_of_array<ConcurrencyTag, FT>(field.values, {field.n, field.n, field.n}, FT(0));
}

/// The same algorithm with the classic table, which never joins positive corners across a face or inside.
template <class FT>
Array_isosurface_3<FT> classic(const Field<FT>& field) {
  static const internal::Case_table table = [] {
    internal::Case_table result;
    for (auto& entry : result.of_signs) entry.is_ambiguous = false;
    return result;
  }();
  const internal::Array_grid<FT> grid(field.values, {field.n, field.n, field.n}, 0, {0, 0, 0}, {1, 1, 1});
  return internal::isosurface_of_array<CGAL::Sequential_tag>(grid, table);
}

void with_one_thread(const auto& f) {
  set_vtk_threads(1);
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  f();
}
void with_two_threads(const auto& f) {
  set_vtk_threads(2);
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 2);
  f();
}

template <class FT>
void compare_field(const std::string& kind, std::size_t n, int runs, const char* target) {
  constexpr bool is_float = std::is_same_v<FT, float>;
  auto field = make_field<FT>(kind, n);
  Flying_edges<FT> flying_edges(field);
  const std::string name = field.name + (is_float ? "_float" : "_double");
  std::size_t triangles = 0;
  if (n < 256) runs *= 4;
  with_one_thread([&] {
    const auto c = compare(
        processor_clock, runs, [&] { flying_edges(); },
        [&] { triangles = ours<CGAL::Sequential_tag>(field).triangles.size(); });
    std::printf("%s: Flying Edges %.2f ms %lld triangles, ours %.2f ms %zu triangles\n", name.c_str(), 1e3 * c.a,
                static_cast<long long>(flying_edges()), 1e3 * c.b, triangles);
    figure("speedup_" + name, c.ratio, "x", target);
    if (!is_float) return;
    const auto exact = compare(
        processor_clock, runs, [&] { ours<CGAL::Sequential_tag>(field); }, [&] { classic(field); });
    figure("exact_topology_cost_" + name, 100 * (exact.ratio - 1), "percent", "<=10");
  });
  if (n < 256) return;
  with_two_threads([&] {
    const auto threads = compare_threads(
        runs, [&] { ours<CGAL::Sequential_tag>(field); }, [&] { ours<CGAL::Parallel_tag>(field); });
    figure("two_threads_over_one_" + name, threads.ratio, "x", ">=1.7");
    if (!is_float) return;
    const auto both = compare(
        wall_clock, runs, [&] { flying_edges(); }, [&] { ours<CGAL::Parallel_tag>(field); });
    std::printf("%s, two threads: Flying Edges %.2f ms, ours %.2f ms\n", name.c_str(), 1e3 * both.a, 1e3 * both.b);
    figure("speedup_two_threads_" + name, both.ratio, "x", ">=2");
  });
}

using Kernel = CGAL::Simple_cartesian<double>;
const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);

struct Sphere {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return x * x + y * y + z * z - 0.64;
  }
};

/// The signs at n^3 nodes.
template <class Traits>
void sample_signs(const Traits& traits, std::size_t n) {
  internal::sample_signs<CGAL::Sequential_tag>(internal::on_lattice(traits, {.resolution = n}));
}

/// An analytic sphere with n^3 nodes: the total time, and the time for the signs, which skipping reduces.
template <class Function>
void compare_skipping(const std::string& name, const Function& function, std::size_t n, int runs, const char* target) {
  const auto traits = make_analytic_traits<Kernel>(function, box);
  const Without_bounds everywhere(traits);
  const auto signs = compare(
      processor_clock, runs, [&] { sample_signs(everywhere, n); }, [&] { sample_signs(traits, n); });
  std::printf("%s, signs: %.1f ms, skipping empty space %.1f ms\n", name.c_str(), 1e3 * signs.a, 1e3 * signs.b);
  figure("skipping_empty_space_signs_of_" + name, signs.ratio, "x", ">=10");
  const Marching_cubes_options options{.resolution = n, .vertices = Vertex_position::LINEAR};
  const auto c = compare(
      processor_clock, runs, [&] { marching_cubes(everywhere, options); }, [&] { marching_cubes(traits, options); });
  std::printf("%s: %.1f ms, skipping empty space %.1f ms\n", name.c_str(), 1e3 * c.a, 1e3 * c.b);
  figure("skipping_empty_space_" + name, c.ratio, "x", target);
}

/// An expression that is not simplified for boxes.
struct Whole_expression {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return f(x, y, z);
  }
  template <class T>
  void operator()(std::span<const T> x, std::span<const T> y, std::span<const T> z, std::span<T> out) const {
    f(x, y, z, out);
  }
  Expression_3 f;
};

/// A union of spheres, whose expression Marching Cubes reduces to the nearby spheres.
void compare_shortening(std::size_t spheres, std::size_t n, int runs) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-0.8, 0.8);
  std::string text;
  for (std::size_t s = 0; s < spheres; ++s) {
    text += s == 0 ? "min(" : ", ";
    for (const char* coordinate : {"(x", " + (y", " + (z"})
      text += coordinate + (" + (" + std::to_string(unit(random)) + "))^2");
    text += " - " + std::to_string(0.01 * double(1 + s % 4));
  }
  const Expression_3 f(text + ")");
  const auto mesh_of = [&](const auto& function) {
    marching_cubes(make_analytic_traits<Kernel>(function, box), {.resolution = n});
  };
  const auto c = compare(
      processor_clock, runs, [&] { mesh_of(Whole_expression{f}); }, [&] { mesh_of(f); });
  const std::string name = std::to_string(spheres) + "_spheres_" + std::to_string(n);
  std::printf("%s, %zu instructions: %.1f ms, shortened %.1f ms\n", name.c_str(), f.number_of_instructions(), 1e3 * c.a,
              1e3 * c.b);
  figure("shortening_" + name, c.ratio, "x", ">1");
}

/// Peak memory in addition to the output and the input.
void measure_memory() {
  constexpr double megabyte = 1048576;
  const auto measure = [&](const std::string& name, std::size_t n, std::size_t output, const auto& f) {
    const double beside = peak_megabytes(f) - peak_megabytes([] {}) - double(output) / megabyte;
    const auto target = std::to_string(n * n * n / 8 / std::size_t(megabyte) + 64);
    figure("memory_beside_output_" + name, beside, "MB", "<=" + target);
  };
  {
    const auto field = make_field<float>("gyroid", 256);
    const auto surface = ours<CGAL::Sequential_tag>(field);
    const std::size_t output = 12 * (surface.points.size() + surface.triangles.size());
    measure("gyroid_256_float", field.n, output, [&] { ours<CGAL::Sequential_tag>(field); });
  }
  const auto traits = make_analytic_traits<Kernel>(Sphere(), box);
  const auto run = [&] { return marching_cubes(traits, {.resolution = 512}); };
  std::size_t output = 0;
  {
    const auto surface = run();
    output = (sizeof(Kernel::Point_3) + sizeof(Point_status)) * surface.points.size() + 12 * surface.triangles.size();
  }
  measure("projected_sphere_512", 512, output, [&] { run(); });
}

} // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  measure_memory();
  for (const std::size_t n : {128U, 256U}) {
    compare_field<float>("sphere", n, runs, ">=2");
    compare_field<float>("gyroid", n, runs, ">=1.5");
    compare_field<double>("sphere", n, runs, ">=1.5");
    compare_field<double>("gyroid", n, runs, ">=1");
  }
  for (const char* kind : {"noise", "white_noise"}) {
    compare_field<float>(kind, 128, runs, ">=1.5");
    compare_field<double>(kind, 128, runs, ">=1");
  }
  compare_skipping("sphere_512", Sphere(), 512, runs, ">=8");
  compare_shortening(10, 256, runs);
  compare_shortening(100, 128, runs);
  compare_skipping("expression_sphere_512", Expression_3("x^2+y^2+z^2-0.64"), 512, runs, ">=6");
}
