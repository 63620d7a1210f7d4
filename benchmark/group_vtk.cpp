// SPDX-License-Identifier: GPL-3.0-or-later
// What the filter for VTK takes beyond the library that it calls, on a gyroid of 256^3 floats.
#include "measure.h"
#include "vtkEquiaffineSurface.h"
#include <equiaffine/Sampled_function_traits_3.h>
#include <equiaffine/attributes.h>
#include <equiaffine/marching_cubes.h>

#include <CGAL/Simple_cartesian.h>

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <span>

namespace {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;

constexpr int nodes = 256;

void set_gyroid(vtkImageData& image) {
  image.SetDimensions(nodes, nodes, nodes);
  const vtkNew<vtkFloatArray> samples;
  samples->SetNumberOfTuples(vtkIdType(nodes) * nodes * nodes);
  const auto at = [](int i) { return 8 * std::numbers::pi * i / (nodes - 1); };
  vtkIdType n = 0;
  for (int k = 0; k < nodes; ++k)
    for (int j = 0; j < nodes; ++j)
      for (int i = 0; i < nodes; ++i)
        samples->SetValue(n++, float(std::sin(at(i)) * std::cos(at(j)) + std::sin(at(j)) * std::cos(at(k)) +
                                     std::sin(at(k)) * std::cos(at(i))));
  image.GetPointData()->SetScalars(samples);
}

} // namespace

int main() {
  const vtkNew<vtkImageData> image;
  set_gyroid(*image);
  const auto size = std::size_t(nodes);
  const Volume_view_3<Kernel> view(Lattice_3<Kernel>({size, size, size}, CGAL::Bbox_3(0, 0, 0, 255, 255, 255)),
                                   static_cast<const float*>(image->GetScalarPointer()));
  for (const char* list : {"none", "all"}) {
    std::size_t of_filter = 0, of_library = 0; // vertices
    const Comparison times = compare(
        wall_clock, 5,
        [&] {
          const vtkNew<vtkEquiaffineSurface> filter;
          filter->SetInputData(image);
          filter->SetAttributes(list);
          filter->Update();
          of_filter = std::size_t(filter->GetOutput()->GetNumberOfPoints());
        },
        [&] {
          const Sampled_function_traits_3<Kernel> function(view);
          const auto mesh = marching_cubes<CGAL::Parallel_if_available_tag>(function);
          const auto attributes = compute_attributes<CGAL::Parallel_if_available_tag>(
              function, std::span<const Kernel::Point_3>(mesh.points), select_attributes(list), mesh.vertex_status);
          of_library = mesh.points.size();
        });
    std::printf("attributes %s: filter %.2f s, library %.2f s, %zu and %zu vertices\n", list, times.a, times.b,
                of_filter, of_library);
    std::printf("figure time_of_filter_over_library_%s %.3f ratio target <=1.10\n", list, times.ratio);
  }
}
