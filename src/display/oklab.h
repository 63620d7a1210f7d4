// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion from Oklab to sRGB, and the diverging and the sequential color map in Oklab.
#ifndef EQUIAFFINE_SRC_DISPLAY_OKLAB_H
#define EQUIAFFINE_SRC_DISPLAY_OKLAB_H

#include <CGAL/IO/Color.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace equiaffine::internal {

/// The linear sRGB components of an Oklab color given by lightness, chroma, and hue in degrees, by Ottosson's
/// matrices. They are outside [0, 1] if the color is out of gamut.
inline std::array<double, 3> linear_rgb_from_oklch(double lightness, double chroma, double hue) {
  constexpr double degree = 0.017453292519943295;
  const double a = chroma * std::cos(hue * degree), b = chroma * std::sin(hue * degree);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

/// The sRGB color of linear components, which are clamped to the gamut, with the transfer function of IEC 61966-2-1.
inline CGAL::IO::Color color_from_linear_rgb(const std::array<double, 3>& linear) {
  const auto byte = [](double x) {
    x = std::clamp(x, 0., 1.);
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<unsigned char>(std::lround(255 * encoded));
  };
  return CGAL::IO::Color(byte(linear[0]), byte(linear[1]), byte(linear[2]));
}

/// The diverging map: near-white at 0, equally dark blue at -1 and red at +1, with a lightness linear in |t|.
inline std::array<double, 3> diverging_linear_rgb(double t) {
  const double u = std::abs(t);
  return linear_rgb_from_oklch(0.94 - 0.50 * u, 0.175 * u * (2 - u), t < 0 ? 262 : 27);
}

/// The sequential map: pale yellow at 0 via orange and magenta to dark violet at 1, with a lightness linear in t.
inline std::array<double, 3> sequential_linear_rgb(double t) {
  constexpr double pi = 3.141592653589793;
  return linear_rgb_from_oklch(0.95 - 0.65 * t, 0.06 + 0.08 * std::sin(pi * t) + 0.06 * t, 95 - 155 * t);
}

} // namespace equiaffine::internal

#endif
