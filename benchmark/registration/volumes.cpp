// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of sampled volumes: matching uses the smoothed spline, refinement the spline through the samples.
#include "runs.h"
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/sample_on_lattice.h>
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/smooth_volume.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace registration_runs {
namespace {

using Sampled = Sampled_function_traits_3<Kernel>;
using Volume = Volume_3<Kernel>;

constexpr std::size_t nodes = 128;

/// The box of points, widened by an eighth of each side.
CGAL::Bbox_3 box_around(const Points& points) {
  CGAL::Bbox_3 box;
  for (const Point_3& p : points) box += p.bbox();
  const double x = box.x_span() / 8, y = box.y_span() / 8, z = box.z_span() / 8;
  return {box.xmin() - x, box.ymin() - y, box.zmin() - z, box.xmax() + x, box.ymax() + y, box.zmax() + z};
}

/// Samples in single precision, with white noise that moves the surface by `noise` voxels along its normal.
template <class Traits>
Volume samples(const Traits& traits, const Points& points, double noise, unsigned seed) {
  const Lattice_3<Kernel> lattice({nodes, nodes, nodes}, box_around(points));
  Volume volume = sample_on_lattice<CGAL::Parallel_tag>(traits, lattice);
  std::vector<double> changes; // over a voxel along the normal
  const auto& steps = lattice.steps();
  const Eigen::Vector3d h(steps[0].x(), steps[1].y(), steps[2].z());
  for (const Point_3& p : points) {
    const auto c = first_order(traits, p).coefficients();
    changes.push_back(Eigen::Vector3d(c[1], c[2], c[3]).cwiseProduct(h).norm());
  }
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, noise * median(changes));
  for (double& x : volume.values) x = double(float(noise > 0 ? x + normal(random) : x));
  return volume;
}

/// The spline through the samples, and the smoothed one with points on it.
struct Sampled_surface {
  Sampled exact, smoothed;
  Points points;

  Sampled_surface(const Volume& volume, double scale)
      : exact(volume), smoothed(smooth_volume(volume, scale)), points(points_on_surface(smoothed, 32)) {}
};

struct Noise {
  const char* name;
  double voxels, scale;
  Targets targets;
};

bool is_closed(const Surface& s) {
  for (const char* name : {"quartic", "blobs5", "blobs8", "ellipsoid+", "torus+", "tangle+", "heart+", "sextic"})
    if (s.name == name) return true;
  return false;
}

} // namespace

void register_volumes(int repeats) {
  const std::vector<Noise> noises = {{"float", 0, 0, {.median_error = "<=1e-8", .greatest_error = "none"}},
                                     {"noise_1e-3_voxel", 1e-3, 4, {.greatest_error = "<=1e-4"}},
                                     {"noise_1e-2_voxel", 1e-2, 6, {.right = ">=0.95", .greatest_error = "<=2e-3"}},
                                     {"noise_3e-2_voxel", 3e-2, 8, {.right = "none", .greatest_error = "none"}},
                                     {"noise_1e-1_voxel", 1e-1, 8, {.right = "none", .greatest_error = "none"}}};
  for (const Noise& noise : noises) {
    Row row(std::string("volumes_") + noise.name, 1e-2);
    Random random(900);
    unsigned seed = 0;
    for (int r = 0; r < repeats; ++r)
      for (const Surface& s : generic_surfaces()) {
        if (!is_closed(s)) continue;
        const Formula function = s.traits();
        const Map map = random_map(random, 4, random_determinant(random));
        const Image image(function, map);
        const Points points = points_on_surface(function, 32);
        Points image_points = points;
        for (Point_3& p : image_points) p = map(p);
        const Sampled_surface source(samples(function, points, noise.voxels, ++seed), noise.scale);
        const Sampled_surface target(samples(image, image_points, noise.voxels, ++seed), noise.scale);
        row.run(source.smoothed, source.exact, source.points, target.smoothed, target.exact, target.points, map);
      }
    row.report(noise.targets);
  }
}

} // namespace registration_runs
