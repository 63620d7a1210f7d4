// SPDX-License-Identifier: GPL-3.0-or-later
#include "distance_openvdb.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/MeshToVolume.h>

std::vector<float> openvdb_distances(const Mesh_on_lattice& mesh, const std::array<std::size_t, 3>& size, float band) {
  openvdb::initialize();
  std::vector<openvdb::Vec3s> points;
  for (const auto& [x, y, z] : mesh.points) points.emplace_back(float(x), float(y), float(z));
  std::vector<openvdb::Vec3I> triangles;
  for (const auto& [a, b, c] : mesh.triangles)
    triangles.emplace_back(openvdb::Index32(a), openvdb::Index32(b), openvdb::Index32(c));
  const auto unit = openvdb::math::Transform::createLinearTransform(1);
  const auto grid =
      openvdb::tools::meshToSignedDistanceField<openvdb::FloatGrid>(*unit, points, triangles, {}, band, band);
  std::vector<float> values(size[0] * size[1] * size[2]);
  const openvdb::CoordBBox box(0, 0, 0, int(size[0]) - 1, int(size[1]) - 1, int(size[2]) - 1);
  openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, values.data());
  openvdb::tools::copyToDense(*grid, dense);
  return values;
}
