// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_ANNOTATE_H
#define EQUIAFFINE_ATTRIBUTES_ANNOTATE_H

#include <equiaffine/attributes/attributes.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <string>

namespace equiaffine {

/// The mesh of a sampler as a CGAL::Surface_mesh with the property map `v:status` (Point_status).
template <class Kernel>
CGAL::Surface_mesh<typename Kernel::Point_3> to_surface_mesh(const Isosurface_3<Kernel>& surface) {
  CGAL::Surface_mesh<typename Kernel::Point_3> mesh;
  using Vertex_index = typename CGAL::Surface_mesh<typename Kernel::Point_3>::Vertex_index;
  using Size = typename Vertex_index::size_type;
  mesh.reserve(Size(surface.points.size()), Size(surface.triangles.size() * 3 / 2), Size(surface.triangles.size()));
  auto status = mesh.template add_property_map<Vertex_index, Point_status>("v:status", Point_status::REGULAR).first;
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    status[mesh.add_vertex(surface.points[i])] = surface.vertex_status[i];
  for (const auto& t : surface.triangles) mesh.add_face(Vertex_index(t[0]), Vertex_index(t[1]), Vertex_index(t[2]));
  return mesh;
}

namespace internal {

/// The property maps of `annotate`.
template <class Mesh>
struct Structure_maps {
  using Vertex_index = typename Mesh::Vertex_index;
  using Kernel = typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel;
  using FT = typename Kernel::FT;
  using Vector_3 = typename Kernel::Vector_3;
  template <class T>
  using Map = typename Mesh::template Property_map<Vertex_index, T>;

  explicit Structure_maps(Mesh& mesh)
      : status(add<Point_status>(mesh, "status")), normal(add<Vector_3>(mesh, "normal")), k1(add<FT>(mesh, "k1")),
        k2(add<FT>(mesh, "k2")), gaussian_curvature(add<FT>(mesh, "gaussian_curvature")),
        mean_curvature(add<FT>(mesh, "mean_curvature")), direction1(add<Vector_3>(mesh, "direction1")),
        direction2(add<Vector_3>(mesh, "direction2")), conormal(add<Vector_3>(mesh, "conormal")),
        affine_normal(add<Vector_3>(mesh, "affine_normal")),
        affine_gaussian_curvature(add<FT>(mesh, "affine_gaussian_curvature")),
        affine_mean_curvature(add<FT>(mesh, "affine_mean_curvature")), pick_invariant(add<FT>(mesh, "pick_invariant")),
        affine_k1(add<FT>(mesh, "affine_k1")),
        affine_k2(add<FT>(mesh, "affine_k2")), metric{add<FT>(mesh, "metric_xx"), add<FT>(mesh, "metric_xy"),
                                                      add<FT>(mesh, "metric_xz"), add<FT>(mesh, "metric_yy"),
                                                      add<FT>(mesh, "metric_yz"), add<FT>(mesh, "metric_zz")},
        quadric_defect(add<FT>(mesh, "quadric_defect")) {}

  void set(Vertex_index v, const Local_structure_3<FT>& s) {
    const auto vector = [](const std::array<FT, 3>& c) { return Vector_3(c[0], c[1], c[2]); };
    status[v] = s.status;
    normal[v] = vector(s.euclidean.normal);
    k1[v] = s.euclidean.k1;
    k2[v] = s.euclidean.k2;
    gaussian_curvature[v] = s.euclidean.gaussian_curvature;
    mean_curvature[v] = s.euclidean.mean_curvature;
    direction1[v] = vector(s.euclidean.direction1);
    direction2[v] = vector(s.euclidean.direction2);
    conormal[v] = vector(s.affine.conormal);
    affine_normal[v] = vector(s.affine.normal);
    affine_gaussian_curvature[v] = s.affine.gaussian_curvature;
    affine_mean_curvature[v] = s.affine.mean_curvature;
    pick_invariant[v] = s.affine.pick_invariant;
    affine_k1[v] = s.affine.k1;
    affine_k2[v] = s.affine.k2;
    for (std::size_t n = 0; n < metric.size(); ++n) metric[n][v] = s.affine.metric[n];
    quadric_defect[v] = s.affine.quadric_defect;
  }

  Map<Point_status> status;
  Map<Vector_3> normal;
  Map<FT> k1, k2, gaussian_curvature, mean_curvature;
  Map<Vector_3> direction1, direction2, conormal, affine_normal;
  Map<FT> affine_gaussian_curvature, affine_mean_curvature, pick_invariant, affine_k1, affine_k2;
  std::array<Map<FT>, 6> metric;
  Map<FT> quadric_defect;

private:
  /// The map of that name, made if the mesh has none.
  template <class T>
  static Map<T> add(Mesh& mesh, const std::string& name) {
    return mesh.template add_property_map<Vertex_index, T>("v:" + name, T()).first;
  }
};

} // namespace internal

/// Fills property maps of the vertices of `mesh` with the local structure of the level sets of f through them:
/// `v:status` (Point_status), `v:normal`, `v:conormal`, `v:affine_normal`, `v:direction1`, `v:direction2` (Vector_3),
/// and one of FT for every other attribute of a single point (see attributes.h), `v:k1` to `v:quadric_defect`. A vertex
/// whose `v:status` is UNCONVERGED before the call keeps it. The same for CGAL::Sequential_tag and CGAL::Parallel_tag.
/// Named parameter: `estimator`.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          class Parameters = internal::No_parameters>
void annotate(CGAL::Surface_mesh<typename Traits::Point_3>& mesh, const Traits& traits,
              const Parameters& parameters = {}) {
  internal::check_parameters<Parameters, internal::Estimator_tag>();
  using Mesh = CGAL::Surface_mesh<typename Traits::Point_3>;
  using Vertex_index = typename Mesh::Vertex_index;
  internal::Structure_maps<Mesh> maps(mesh);
  internal::parallel_for<ConcurrencyTag>(
      0, mesh.num_vertices() + mesh.number_of_removed_vertices(),
      [&](std::size_t i) {
        const Vertex_index v{static_cast<typename Vertex_index::size_type>(i)};
        if (!mesh.is_removed(v)) maps.set(v, local_structure_at(traits, mesh.point(v), maps.status[v], parameters));
      },
      256);
}

} // namespace equiaffine

#endif
