// SPDX-License-Identifier: GPL-3.0-or-later
// Overhead of the VTK filter compared with the library on a gyroid of 256^3 floats: with a mesh that is made at once
// and has no ids, and with slabs with ids as used by the filter.
#include "measure.h"
#include "vtkEquiaffineSurface.h"
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/marching_cubes/marching_cubes_in_slabs.h>

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
#include <vector>

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
  using Tag = CGAL::Parallel_if_available_tag;
  for (const char* list : {"none", "all"}) {
    const Attribute_selection selection = select_attributes(list);
    std::size_t of_filter = 0, of_library = 0; // vertices
    const auto run_filter = [&] {
      const vtkNew<vtkEquiaffineSurface> filter;
      filter->SetInputData(image);
      filter->SetAttributes(list);
      filter->Update();
      of_filter = std::size_t(filter->GetOutput()->GetNumberOfPoints());
    };
    const auto print = [&](const char* name, const Comparison& times) {
      std::printf("attributes %s: filter %.2f s, library, %s, %.2f s, %zu and %zu vertices\n", list, times.a, name,
                  times.b, of_filter, of_library);
    };
    const Comparison to_whole = compare(wall_clock, 5, run_filter, [&] {
      const Sampled_function_traits_3<Kernel> function(view);
      const auto mesh = marching_cubes<Tag>(function);
      const auto attributes = compute_attributes<Tag>(function, std::span<const Kernel::Point_3>(mesh.points),
                                                      selection, mesh.vertex_status);
      of_library = mesh.points.size();
    });
    print("whole mesh", to_whole);
    std::printf("figure time_of_filter_over_library_%s %.3f ratio target <=1.10\n", list, to_whole.ratio);
    const Comparison to_slabs = compare(wall_clock, 5, run_filter, [&] {
      const Sampled_function_traits_3<Kernel> function(view);
      std::vector<Isosurface_slab_3<Kernel>> slabs;
      std::vector<Vertex_attributes> attributes;
      const Isosurface_totals totals = marching_cubes_of_block<Tag>(
          function, view.cells(),
          [&](const Isosurface_slab_3<Kernel>& slab) {
            slabs.push_back(slab);
            attributes.push_back(compute_attributes<Tag>(function, std::span<const Kernel::Point_3>(slab.points),
                                                         selection, slab.vertex_status));
          },
          {.planes_per_slab = std::size_t(nodes / 4)});
      of_library = totals.vertices;
    });
    print("slabs with ids", to_slabs);
    std::printf("figure time_of_filter_over_slabs_of_library_%s %.3f ratio target <=1.10\n", list, to_slabs.ratio);
  }
}
