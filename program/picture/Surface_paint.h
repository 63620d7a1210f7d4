// SPDX-License-Identifier: GPL-3.0-or-later
// The colors of a surface in a picture, their legend, and notes.
#ifndef EQUIAFFINE_PROGRAM_PICTURE_SURFACE_PAINT_H
#define EQUIAFFINE_PROGRAM_PICTURE_SURFACE_PAINT_H

#include "picture/Canvas.h"
#include "system/kernel.h"
#include <equiaffine/display/Display_options.h>
#include <equiaffine/display/internal/Column_numbers.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace equiaffine {

/// A line of text below a picture, optionally beside the color of a number.
struct Surface_note {
  std::optional<double> number;
  std::string text;
};

/// The meaning of the color bar.
struct Color_legend {
  std::string label; ///< the name of the quantity, with its unit if known
  Color_mapping mapping;
};

/// The meaning of a color that is not on the color bar, or a text without a color.
struct Color_note {
  std::optional<CGAL::IO::Color> color;
  std::string text;
};

Light light_of(const CGAL::IO::Color& color);

/// The color of a surface at its vertices and between them.
class Surface_paint {
public:
  /// Adds notes on uncertain values unless `has_notes`: the notes of a fit cover every quantity.
  Surface_paint(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                const Display_options& options, bool has_notes = false);

  /// Set if the color of a vertex shows a number.
  const std::optional<Color_legend>& legend() const { return legend_; }

  /// One note for each other color of the surface, the most important one first.
  const std::vector<Color_note>& notes() const { return notes_; }

  /// The color at barycentric weights, as on the page. Vertices with a number compete by their total weight with those
  /// of each status without a number; the number is interpolated between the vertices that have one. A number that is
  /// undefined on parabolic curves is interpolated on each side only from the vertices of that side. Colors are grayer
  /// where the estimated error is larger.
  Light operator()(const std::array<std::uint32_t, 3>& triangle, const std::array<double, 3>& weights) const;

  /// The sides of the vertices (`Parabolic_parts::sides`), if the number is undefined where the Gaussian curvature
  /// changes its sign; otherwise empty.
  const std::vector<double>& sides() const { return sides_; }

private:
  /// Weighted sums over some of the corners of a triangle, and the sum of their weights.
  struct Weighted_level {
    double level = 0, doubt = 0, weight = 0;
    void add(double its_level, double its_doubt, double its_weight) {
      level += its_weight * its_level;
      doubt += its_weight * its_doubt;
      weight += its_weight;
    }
  };

  using Triangle = std::array<std::uint32_t, 3>;

  static constexpr std::uint8_t no_number = number_of_point_statuses;

  void use(const Vertex_attributes::Column& column, const Numbers_of_mesh& numbers_of, const Display_options& options);
  void find_codes(const Vertex_attributes& attributes);
  void find_notes(std::span<const Triangle> triangles);
  bool can_have_line(const Triangle& triangle) const;
  bool is_convex(std::uint32_t vertex) const { return sides_.empty() || !(sides_[vertex] < 0); }
  Light color_of(double level, double doubt) const;
  CGAL::IO::Color color_of_code(std::size_t code) const;

  std::vector<double> numbers_;     // per vertex, interpolated in spots
  std::vector<std::uint8_t> codes_; // per vertex: 0 if it has a number, else its status or no_number; empty: all 0
  std::vector<double> levels_;      // per vertex: the position of its number on the color bar, in [0, 1]
  std::vector<double> sides_;
  std::vector<double> doubts_; // per vertex: color_doubt, if errors are known
  std::vector<Light> table_;
  bool shows_status_ = false; // instead of a number
  std::optional<Color_legend> legend_;
  std::vector<Color_note> notes_;
};

} // namespace equiaffine

#endif
