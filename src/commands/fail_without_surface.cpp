// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/fail_without_surface.h"

#include "source/any_level_set.h"
#include "source/source.h"
#include <equiaffine/Input_error.h>
#include <equiaffine/Level_set_traits_3.h>
#include <equiaffine/capabilities.h>
#include <equiaffine/function/sample_on_lattice.h>
#include <equiaffine/marching_cubes.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace equiaffine {

namespace {

/// The least and the greatest value of f at the nodes of a grid. If all values are NaN, they are infinity and
/// -infinity.
template <class Traits>
std::pair<double, double> range_on_grid(const Traits& function) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  const auto add = [&](const std::vector<double>& values) {
    for (const double value : values) {
      if (value < least) least = value; // std::min would keep a NaN
      if (value > greatest) greatest = value;
    }
  };
  if constexpr (LatticeImplicitFunctionTraits_3<Traits>) {
    const auto [nx, ny, nz] = function.lattice().size();
    std::vector<double> row(nx);
    for (std::size_t k = 0; k < nz; ++k)
      for (std::size_t j = 0; j < ny; ++j) {
        samples(function, {0, j, k}, {nx, 1, 1}, row);
        add(row);
      }
  } else {
    add(sample_on_lattice<CGAL::Parallel_if_available_tag>(function, sampling_lattice(function, {33, 33, 33})).values);
  }
  return {least, greatest};
}

/// Throws the error that says why a fit has no surface, and what to choose instead: it has one beside the data only.
[[noreturn]] void fail_without_surface_of_fit(const Fit_traits& fit, const Source_options& source, double isovalue,
                                              const Vain_search& search) {
  const CGAL::Bbox_3 box = fit.bbox(), band = fit.band_box();
  const std::string fitted = describe(source);
  std::ostringstream text;
  if (!CGAL::do_overlap(box, band)) {
    text << "no part of " << fitted << " is in the " << search.place << ": it lies in " << band.xmin() << ' '
         << band.xmax() << ' ' << band.ymin() << ' ' << band.ymax() << ' ' << band.zmin() << ' ' << band.zmax()
         << "; choose a --box that meets that, or leave it out";
  } else if (isovalue != 0) {
    text << "no surface f = " << isovalue << ": " << fitted
         << " is about the distance from the data, and known within some two spacings of them only; choose an "
            "--isovalue nearer to 0, or leave it out";
  } else {
    text << "no part of the surface of " << fitted << " was found in the " << search.place
         << "; choose a --box that has more of the data, or "
         << (search.refinement.empty() ? "leave it out" : search.refinement);
  }
  throw Input_error(text.str());
}

template <class Traits>
bool changes_sign_at_poles_only(const Traits& function) {
  const auto surface =
      marching_cubes<CGAL::Parallel_if_available_tag>(function, parameters::number_of_nodes({32, 32, 32}));
  const auto& status = surface.vertex_status;
  return surface.repairs.vertices_at_poles + status.size() > 0 &&
         std::count(status.begin(), status.end(), Point_status::UNCONVERGED) == std::ptrdiff_t(status.size());
}

} // namespace

bool changes_sign_at_poles_only(const Source_function& function, double isovalue) {
  // Splines have the grid of their samples, which a function of any type does not know.
  if (const auto* const spline = std::get_if<Spline_function>(&function))
    return changes_sign_at_poles_only(Level_set_traits_3(*spline, isovalue));
  return changes_sign_at_poles_only(any_level_set(function, isovalue));
}

void fail_without_surface(const Source_function& function, const Source_options& source, double isovalue,
                          const Vain_search& search) {
  if (const auto* const fit = std::get_if<Fit_function>(&function))
    fail_without_surface_of_fit(fit->base(), source, isovalue, search);
  const auto [least, greatest] = std::visit([](const auto& f) { return range_on_grid(f); }, function);
  const bool is_defined = least <= greatest;
  std::ostringstream surface, reason;
  surface << "surface f = " << isovalue;
  reason << " in the " << search.place << ": at the nodes of a grid f ";
  if (is_defined) reason << "lies between " << least << " and " << greatest;
  else reason << "is undefined";
  if (source.narrow_band) reason << " in the band of --narrow-band " << *source.narrow_band;
  if (search.met_poles) reason << ", and changes its sign at poles or jumps only";
  reason << "; choose ";
  const bool may_help = !search.refinement.empty() && !search.met_poles;
  if (may_help && least < isovalue && greatest > isovalue)
    throw Input_error("no part of the " + surface.str() + " was found" + reason.str() + search.refinement);
  if (source.narrow_band) reason << "a wider band, another --isovalue or box";
  else if (is_defined && may_help) reason << "another --isovalue or box, or " << search.refinement;
  else reason << "another --isovalue or box";
  throw Input_error("no " + surface.str() + reason.str());
}

} // namespace equiaffine
