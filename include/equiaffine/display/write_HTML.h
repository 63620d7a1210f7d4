// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_WRITE_HTML_H
#define EQUIAFFINE_DISPLAY_WRITE_HTML_H

#include <equiaffine/display/Html_options.h>
#include <equiaffine/display/internal/page.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/assertions.h>

#include <ostream>

namespace equiaffine {

/// Writes one self-contained web page (WebGL 2, no network) that shows the surface colored by any of its attributes.
/// Numbers are stored in single precision, positions relative to the center of the bounding box; a million vertices
/// with twenty attributes make 156 MB. A fragment such as `#color=pick_invariant&view=1,0,0` chooses what is shown
/// first; the page's help lists its keys. Where a column NAME_error has estimates of the errors of NAME, colors and
/// digits say how far to trust it.
/// \pre every column and the status, if there is one, are as long as `points`, triangles index `points`,
/// `options.color` names an attribute or is `status` (when there is one), `plain` or empty, `options.range` is
/// ascending, `options.up` is not zero
template <class Kernel>
void write_HTML(std::ostream& out, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                const Html_options& options = {}) {
  CGAL_precondition(internal::is_consistent(mesh, attributes));
  CGAL_precondition(internal::is_offered(options.color, attributes));
  CGAL_precondition(!options.range || (*options.range)[0] < (*options.range)[1]);
  CGAL_precondition(options.up[0] != 0 || options.up[1] != 0 || options.up[2] != 0);
  internal::write_page(out, internal::Page_surface(mesh, attributes), attributes, options);
}

} // namespace equiaffine

#endif
