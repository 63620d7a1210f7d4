// SPDX-License-Identifier: GPL-3.0-or-later
// Marching Cubes against VTK's Flying Edges in one process: runs alternate, figures are medians of ratios of
// neighbouring runs. Normals, gradients and scalars are off in VTK. Usage: benchmark_marching_cubes [runs]
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/marching_cubes.h>
#include <equiaffine/marching_cubes_of_array.h>

#include <CGAL/Real_timer.h>
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
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

void set_vtk_threads(int n); // vtk/threads.cpp

namespace {

using namespace equiaffine;

double seconds(const std::function<void()>& f) {
  CGAL::Real_timer timer;
  timer.start();
  f();
  return timer.time();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

void figure(const std::string& name, double value, const char* unit, const char* target) {
  std::printf("figure %s %.3f %s target %s\n", name.c_str(), value, unit, target);
  std::fflush(stdout);
}

template <class FT>
struct Field {
  std::string name;
  std::size_t n;
  std::vector<FT> values;
};

/// The mean of each node and its neighbours, three times.
template <class FT>
void smooth(Field<FT>& field) {
  for (int pass = 0; pass < 3; ++pass)
    for (const std::size_t stride : {std::size_t(1), field.n, field.n * field.n}) {
      const std::vector<FT> old = field.values;
      for (std::size_t v = stride; v + stride < old.size(); ++v)
        field.values[v] = (old[v - stride] + old[v] + old[v + stride]) / 3;
    }
}

template <class FT>
Field<FT> make_field(const std::string& kind, std::size_t n) {
  Field<FT> field{kind + "_" + std::to_string(n), n, {}};
  field.values.reserve(n * n * n);
  std::mt19937 random(1);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        const auto u = [&](std::size_t a) { return 2 * double(a) / double(n - 1) - 1; };
        const double x = u(i), y = u(j), z = u(k), w = 4 * CGAL_PI * double(n) / 64;
        if (kind == "sphere") field.values.push_back(FT(x * x + y * y + z * z - 0.64));
        else if (kind == "noise") field.values.push_back(FT(double(random()) / 2147483648.0 - 1)); // smoothed below
        else
          field.values.push_back(FT(std::sin(w * x) * std::cos(w * y) + std::sin(w * y) * std::cos(w * z) +
                                    std::sin(w * z) * std::cos(w * x)));
      }
  if (kind == "noise") smooth(field);
  return field;
}

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

/// Median of seconds(a) / seconds(b), and of each.
struct Comparison {
  double ratio, a, b;
};
Comparison compare(int runs, const std::function<void()>& a, const std::function<void()>& b) {
  a();
  b();
  std::vector<double> ratios, times_a, times_b;
  for (int n = 0; n < runs; ++n) {
    times_a.push_back(seconds(a));
    times_b.push_back(seconds(b));
    ratios.push_back(times_a.back() / times_b.back());
  }
  return {median(ratios), median(times_a), median(times_b)};
}

template <class FT>
void compare_with_flying_edges(const char* type, const std::string& kind, std::size_t n, int runs, const char* target) {
  auto field = make_field<FT>(kind, n);
  Flying_edges<FT> flying_edges(field);
  const std::string name = field.name + "_" + type;
  const auto one = [&](auto&& f) {
    set_vtk_threads(1);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    f();
  };
  std::size_t triangles = 0;
  const auto c = compare(
      runs, [&] { one([&] { flying_edges(); }); },
      [&] { one([&] { triangles = ours<CGAL::Sequential_tag>(field).triangles.size(); }); });
  std::printf("%-18s Flying Edges %8.2f ms %9lld triangles, ours %8.2f ms %9zu triangles\n", name.c_str(), 1e3 * c.a,
              static_cast<long long>(flying_edges()), 1e3 * c.b, triangles);
  figure("speedup_" + name, c.ratio, "x", target);
  if (n < 256) return;
  const auto threads = compare(
      runs, [&] { one([&] { ours<CGAL::Sequential_tag>(field); }); }, [&] { ours<CGAL::Parallel_tag>(field); });
  figure("two_threads_over_one_" + name, threads.ratio, "x", ">=1.7");
  if (!std::is_same_v<FT, float>) return;
  set_vtk_threads(2);
  const auto both = compare(
      runs, [&] { flying_edges(); }, [&] { ours<CGAL::Parallel_tag>(field); });
  figure("speedup_two_threads_" + name, both.ratio, "x", ">=2");
}

struct Sphere {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return x * x + y * y + z * z - 0.64;
  }
};

void compare_skipping() {
  using Kernel = CGAL::Simple_cartesian<double>;
  const auto traits = make_analytic_traits<Kernel>(Sphere(), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const auto nodes = parameters::number_of_nodes(512).vertex_position(Vertex_position::LINEAR);
  const auto c = compare(
      3, [&] { marching_cubes(traits, nodes); }, [&] { marching_cubes(traits, nodes.skip_empty_space()); });
  std::printf("analytic sphere 512^3: %.1f ms, skipping empty space %.1f ms\n", 1e3 * c.a, 1e3 * c.b);
  figure("skipping_empty_space_sphere_512", c.ratio, "x", ">=10");
}

/// Peak memory of a child that makes the surface, beside that of one that only has the field and the output.
void measure_memory() {
  const std::size_t n = 256;
  const auto peak_kilobytes = [](const std::function<void()>& f) {
    const pid_t child = fork();
    if (child == 0) {
      f();
      _exit(0);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    return double(usage.ru_maxrss);
  };
  std::fflush(stdout);
  auto field = make_field<float>("gyroid", n);
  std::size_t output = 0;
  {
    const auto surface = ours<CGAL::Sequential_tag>(field);
    output = 12 * (surface.points.size() + surface.triangles.size());
  }
  const double with = peak_kilobytes([&] { ours<CGAL::Sequential_tag>(field); });
  const double without = peak_kilobytes([] {});
  const double beside = (with - without) / 1024 - double(output) / 1048576;
  std::printf("gyroid_256_float: output %.1f MB, N/8 bytes %.1f MB\n", double(output) / 1048576,
              double(n * n * n) / 8 / 1048576);
  figure("memory_beside_output_gyroid_256_float", beside, "MB", "<=66");
}

} // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  measure_memory();
  for (const std::size_t n : {128U, 256U}) {
    compare_with_flying_edges<float>("float", "sphere", n, runs, ">=2");
    compare_with_flying_edges<float>("float", "gyroid", n, runs, ">=1.5");
    compare_with_flying_edges<double>("double", "sphere", n, runs, ">=1.5");
    compare_with_flying_edges<double>("double", "gyroid", n, runs, ">=1");
  }
  compare_with_flying_edges<float>("float", "noise", 128, runs, ">=1.5");
  compare_with_flying_edges<double>("double", "noise", 128, runs, ">=1");
  compare_skipping();
}
