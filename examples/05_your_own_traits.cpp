// SPDX-License-Identifier: GPL-3.0-or-later
// Implements a model of ImplicitFunctionTraits_3, which needs three members, for a function whose derivatives you
// compute yourself. Here it is a quadric, given by its coefficients. The affine curvatures of a quadric are constant.
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cstddef>
#include <cstdio>

using Kernel = CGAL::Simple_cartesian<double>;

//! [traits]
class Quadric_traits_3 {
public:
  using FT = double;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;

  /// Coefficients of 1, x, y, z, xx, xy, xz, yy, yz, zz, the first ten of a Jet_3.
  Quadric_traits_3(const std::array<double, 10>& coefficients, const CGAL::Bbox_3& box) : c_(coefficients), box_(box) {}

  FT value(const Point_3& p) const {
    const double x = p.x(), y = p.y(), z = p.z();
    return c_[0] + (c_[1] + c_[4] * x + c_[5] * y) * x + (c_[2] + c_[7] * y + c_[8] * z) * y +
           (c_[3] + c_[6] * x + c_[9] * z) * z;
  }

  equiaffine::Jet_3<FT> taylor(const Point_3& p) const {
    const double x = p.x(), y = p.y(), z = p.z();
    equiaffine::Jet_3<FT> jet(value(p)); // all other coefficients are zero
    auto& t = jet.coefficients();
    t[1] = c_[1] + 2 * c_[4] * x + c_[5] * y + c_[6] * z;
    t[2] = c_[2] + c_[5] * x + 2 * c_[7] * y + c_[8] * z;
    t[3] = c_[3] + c_[6] * x + c_[8] * y + 2 * c_[9] * z;
    for (std::size_t n = 4; n < 10; ++n) t[n] = c_[n];
    return jet;
  }

  CGAL::Bbox_3 bbox() const { return box_; }

private:
  std::array<double, 10> c_;
  CGAL::Bbox_3 box_;
};

static_assert(equiaffine::ImplicitFunctionTraits_3<Quadric_traits_3>);
//! [traits]

int main() {
  const Quadric_traits_3 traits({-6, 1, 0, 0, 1, 1, 0, 2, 0, 3}, CGAL::Bbox_3(-4, -3, -2, 3, 3, 2));
  const auto surface = equiaffine::marching_cubes(traits, {.resolution = 6});
  for (std::size_t v = 0; v < surface.points.size(); v += 10) {
    const auto s = equiaffine::local_structure_at(traits, surface.points[v]);
    std::printf("x = %7.4f: K = %.4g, H = %.4g\n", surface.points[v].x(), s.affine.gaussian_curvature,
                s.affine.mean_curvature);
  }
}
