// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/warnings.h"

#include "source/source_function.h"
#include "system/front_end.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace equiaffine {

void warn_of_outside(const Source_options& options, const Source& source, std::size_t outside, std::size_t all,
                     const std::string& points, Progress& progress) {
  if (outside > 0 && source.fit)
    progress.warn(std::to_string(outside) + " of " + std::to_string(all) + ' ' + points +
                  " are outside and have no attributes: a fit is defined only within about two spacings of the data");
  if (outside == 0 || !source.spline) return;
  constexpr int least_degree = 5;
  const int degree = source.spline->degree;
  const std::size_t nodes = source.spline->least_nodes;
  std::ostringstream text;
  text << outside << " of " << all << ' ' << points << " are outside and have no attributes: ";
  if (nodes <= std::size_t(degree))
    text << "a spline of degree " << degree << " needs " << degree + 1 << " nodes along each axis, and one axis has "
         << nodes << "; " << (nodes > least_degree ? by_front_end("use --spline-degree 5 or", "give") : "give")
         << " more nodes";
  else if (options.narrow_band)
    text << "distances are computed only within " << option_text("narrow_band") << ' ' << *options.narrow_band
         << "; give a larger band or leave it out";
  else if (options.kind == Source_kind::VOLUME)
    text << "the spline is undefined outside the volume and within " << degree << " voxels of a node without a value"
         << (source.spline->smoothing > 0 ? ", or more because samples are smoothed" : "");
  else return;
  progress.warn(text.str());
}

void warn_of_steps(const Spline_statistics& spline, Progress& progress) {
  if (spline.smoothing > 0 || !spline.distinct_values) return;
  progress.warn("the samples have only " + std::to_string(*spline.distinct_values) +
                " distinct values, so that curvatures are those of the steps between them; smooth the samples, " +
                option_text("smoothing", "auto"));
}

bool has_affine_curvatures(const Attribute_selection& attributes, const std::vector<std::string>& estimates) {
  return !estimates.empty() ||
         std::any_of(attributes.columns.begin(), attributes.columns.end(), [](const Attribute& column) {
           return column.name.starts_with("affine_") || column.name.starts_with("pick_invariant") ||
                  column.name == "quadric_defect";
         });
}

namespace {

/// The words after "20 % of the vertices".
std::string sentence_of_doubt(Fit_doubt reason, const Fit_statistics& fit, const Fit_options& options, bool are_data) {
  const std::string larger_scale = options.scale ? ", or a larger " + option_text("scale") : "";
  const std::string without_none = options.scale == 0. ? "leave out " + option_text("scale", "none") + ", or " : "";
  const std::string error = "have an estimated error of the affine Gaussian curvature above 50 %, mostly ";
  if (reason == Fit_doubt::WITHOUT_FIT)
    return are_data ? "have no fit, which needs at least 15 connected points nearby; give more points" + larger_scale
                    : "have no curvatures: they are on creases, or the fit does not follow the data there";
  if (reason == Fit_doubt::NOISE)
    return error + (fit.scale
                        ? "from noise and spacing that are too large for fourth derivatives at that scale; give a "
                          "larger " +
                              option_text("scale") +
                              " or more points, or use the affine area density or the affine normal, "
                              "which need only derivatives of order 2 and 3"
                        : "from noise that is too large for fourth derivatives; " + without_none +
                              "give points with less noise");
  return fit.scale
             ? "have no curvature at that scale, which contains fewer points than a polynomial needs; give a "
               "larger " +
                   option_text("scale") + " or more points"
             : error +
                   "because fits disagree: the points are too few for the detail, creases or inconsistencies of the "
                   "surface; " +
                   without_none + "give more points";
}

} // namespace

void warn_of_doubt(const Fit_statistics& fit, const Fit_options& options, bool has_affine_curvatures, bool are_data,
                   Progress& progress) {
  for (const auto& [reason, part] : doubts_of(fit, has_affine_curvatures))
    progress.warn(std::to_string(std::lround(100 * part)) + " % of the vertices " +
                  sentence_of_doubt(reason, fit, options, are_data));
}

void warn_of_close_sheets(const Close_sheets& sheets, Progress& progress) {
  if (sheets.points == 0) return;
  constexpr std::size_t finest = 4096;
  std::ostringstream text;
  text << sheets.points << (sheets.points == 1 ? " point is" : " points are")
       << " nearer to another sheet of the surface than a step of the grid, which may cause holes and fragments: "
       << "sheets are " << sheets.distance << " apart; ";
  if (sheets.resolution <= finest) text << "give " << option_text("resolution", std::to_string(sheets.resolution));
  else text << "no grid is fine enough, so remove duplicate sheets";
  progress.warn(text.str());
}

void warn_of_opposed_normals(const Annotated_mesh_3<Kernel>& points, Progress& progress) {
  constexpr double tolerated = 0.05;
  const double part = part_with_opposed_normals(points);
  if (!(part > tolerated)) return;
  progress.warn(std::to_string(std::lround(100 * part)) +
                " % of the points have a normal opposite to that of the nearest point; orient the normals "
                "consistently, or leave out nx, ny and nz");
}

} // namespace equiaffine
