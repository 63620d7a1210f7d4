// SPDX-License-Identifier: GPL-3.0-or-later
#include "source.h"

#include "read_triangle_mesh.h"
#include "resources.h"
#include "volume_io.h"
#include <equiaffine/Distance_function_3.h>
#include <equiaffine/Input_error.h>
#include <equiaffine/sample_on_lattice.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <utility>

namespace equiaffine {

namespace {

using Size = Lattice_3<Kernel>::Size;

Formula_traits make_formula(const Source_options& options) {
  // Without a box nothing will be sampled: points are given, and the box is not looked at.
  return {Expression_3(options.text, options.constants), options.box.value_or(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1))};
}

/// The box of the mesh, widened on all sides by a tenth of its longest side.
CGAL::Bbox_3 widened_box(const CGAL::Surface_mesh<Kernel::Point_3>& mesh) {
  CGAL::Bbox_3 box;
  for (const Kernel::Point_3& p : mesh.points()) box += p.bbox();
  const double margin = std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()}) / 10;
  return {box.xmin() - margin, box.ymin() - margin, box.zmin() - margin,
          box.xmax() + margin, box.ymax() + margin, box.zmax() + margin};
}

Volume_3<Kernel> sample_distance(const Source_options& options, const Size& size, Progress& progress) {
  progress.begin("reading the mesh");
  const CGAL::Surface_mesh<Kernel::Point_3> mesh = read_triangle_mesh(options.text);
  const Lattice_3<Kernel> lattice(size, options.box ? *options.box : widened_box(mesh));
  progress.begin("measuring distances", lattice.number_of_nodes());
  try {
    return signed_distance_volume<CGAL::Parallel_if_available_tag>(mesh, lattice,
                                                                   [&](std::size_t nodes) { progress.advance(nodes); });
  } catch (const Input_error& error) {
    throw Input_error("cannot measure " + describe(options) + ": " + error.what());
  }
}

Spline_traits make_spline(const Source_options& options, Progress& progress, std::size_t& function_evaluations) {
  Volume_3<Kernel> volume = [&] {
    if (options.kind != Source_kind::VOLUME) return sample_source(options, progress);
    progress.begin("reading the volume");
    return read_volume(options.text);
  }();
  if (options.kind != Source_kind::VOLUME) function_evaluations += volume.values.size();
  progress.begin("fitting a spline");
  return Spline_traits(std::move(volume));
}

} // namespace

Volume_3<Kernel> sample_source(const Source_options& options, Progress& progress) {
  const Size size = options.resolution.value_or(default_resolution(options.kind));
  check_memory_of_volume(size);
  if (options.kind == Source_kind::DISTANCE) return sample_distance(options, size, progress);
  const Formula_traits formula = make_formula(options);
  const Lattice_3<Kernel> lattice(size, formula.bbox());
  progress.begin("sampling the formula", lattice.number_of_nodes());
  return sample_on_lattice<CGAL::Parallel_if_available_tag>(formula, lattice,
                                                            [&](std::size_t nodes) { progress.advance(nodes); });
}

Source make_source(const Source_options& options, Progress& progress) {
  std::size_t evaluations = 0;
  const auto transformed = [&](auto traits) -> Source_function {
    if (!options.transformation) return traits;
    return Transformed_function_traits_3(std::move(traits), *options.transformation);
  };
  Source_function function = options.derivatives == Derivatives::JETS
                                 ? transformed(make_formula(options))
                                 : transformed(make_spline(options, progress, evaluations));
  return {std::move(function), evaluations};
}

std::string describe(const Source_options& options) {
  switch (options.kind) {
  case Source_kind::FUNCTION: return "the formula " + options.text;
  case Source_kind::VOLUME: return "the volume '" + options.text + "'";
  default: return "the distance to " + (options.text == "-" ? "standard input" : "'" + options.text + "'");
  }
}

} // namespace equiaffine
