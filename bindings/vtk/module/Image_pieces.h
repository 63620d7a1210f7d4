// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_IMAGE_PIECES_H
#define EQUIAFFINE_BINDINGS_VTK_IMAGE_PIECES_H

#include "Ranks.h"
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Lattice_3.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_options.h>

#include <CGAL/Simple_cartesian.h>

#include <vtkSmartPointer.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkImageData;
class vtkInformation;
class vtkMultiProcessController;

namespace equiaffine {

using Kernel = CGAL::Simple_cartesian<double>;

/// A piece of an image. Cells are those of the lattice of the whole image.
struct Image_piece {
  vtkSmartPointer<vtkImageData> image;
  Cell_block cells;    ///< belong only to this piece
  Cell_block surveyed; ///< cells whose samples this process surveys for the spline: `cells`, or all cells
};

/// The pieces of this process, and the whole image.
struct Image_pieces {
  std::optional<Lattice_3<Kernel>> lattice; ///< nothing if the pieces of all processes are empty
  std::array<int, 3> first;                 ///< the indices in VTK's extents of the first node of the lattice
  std::vector<Image_piece> pieces;
  bool are_whole = false; ///< whether every process has the whole image
  /// Whether to make the surface of the pieces. If one process makes several pieces, the first one contains all images.
  bool are_wanted = true;
};

/// A request for a piece. Each process makes one piece, or one process makes all pieces one after the other.
struct Piece_request {
  int piece = 0, pieces = 1; ///< the part, for a source that can provide any part of an image
  int ghost_levels = 0;      ///< requested around the cells of a piece
  Volume_options volume;     ///< without smoothing if it is chosen automatically
};

/// Returns the array of an image that contains the function, or null.
using Find_array = std::function<vtkDataArray*(vtkImageData*)>;

/// The nonempty images of an input. Each contains only the array returned by `find`, as scalars, and the marks of cells
/// of other pieces.
std::vector<vtkSmartPointer<vtkImageData>> images_of(vtkDataObject* input, int component, const Find_array& find);

/// Determines, together with the other processes, which cells belong to which process, and exchanges missing ghost
/// levels.
/// \throw Failure if the images are not pieces of one image, or if the image is too small for a spline
Image_pieces image_pieces(std::vector<vtkSmartPointer<vtkImageData>> images, const std::array<int, 6>& whole_extent,
                          const Piece_request& request, const Ranks& ranks, vtkMultiProcessController* controller);

/// The cells of the lattice with samples in an image.
Cell_block cells_of(const Image_pieces& pieces, vtkImageData* image);

/// The samples of a piece in some cells of its image: a component of its scalars. Copies them if their memory is not
/// contiguous.
Volume_view_3<Kernel> view_of(const Image_pieces& pieces, const Image_piece& piece, int component,
                              const Cell_block& cells);

/// The number of ghost levels that is enough for every piece of an image.
int needed_ghost_levels(const Volume_options& options);

/// The cells whose samples are needed for the surface in a block.
Cell_block needed_cells(const Cell_block& block, const Lattice_3<Kernel>& lattice, const Volume_options& options);

} // namespace equiaffine

#endif
