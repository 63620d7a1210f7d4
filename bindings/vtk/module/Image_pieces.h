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
  Cell_block cells;    ///< belong to this piece and to no other one
  Cell_block surveyed; ///< the cells that this process knows of all that a spline asks about: these, or all
};

/// The pieces that this process has, and the whole image.
struct Image_pieces {
  std::optional<Lattice_3<Kernel>> lattice; ///< nothing if all pieces of all processes are empty
  std::array<int, 3> first;                 ///< the indices in VTK's extents of the first node of the lattice
  std::vector<Image_piece> pieces;
  bool are_whole = false; ///< whether every process has the whole image, and not some of its cells
  /// Whether the surface of the pieces is wanted: one process that makes several pieces has all images in the first
  /// one.
  bool are_wanted = true;
};

/// What is wanted of the image. Pieces are those of the processes, or all are made by one, one after the other.
struct Piece_request {
  int piece = 0, pieces = 1; ///< which part of a source that gives any part of an image
  int ghost_levels = 0;      ///< wanted beside the cells of a piece
  Volume_options volume;     ///< without a smoothing if that is chosen
};

/// Finds the array of an image that is the function, and null if there is none.
using Find_array = std::function<vtkDataArray*(vtkImageData*)>;

/// The images of an input that are not empty, each with the array that is found, as its scalars, and with nothing else
/// but marks of the cells of other pieces.
std::vector<vtkSmartPointer<vtkImageData>> images_of(vtkDataObject* input, int component, const Find_array& find);

/// Finds out, with the other processes, which cells are whose, and has them exchange the ghost levels that are missing.
/// \throw Failure if the images are no pieces of one image on which there is a spline
Image_pieces image_pieces(std::vector<vtkSmartPointer<vtkImageData>> images, const std::array<int, 6>& whole_extent,
                          const Piece_request& request, const Ranks& ranks, vtkMultiProcessController* controller);

/// The cells of the lattice with samples in an image.
Cell_block cells_of(const Image_pieces& pieces, vtkImageData* image);

/// The samples of a piece in some cells that its image has: a component of its scalars, which are copied if their
/// numbers do not lie one after the other.
Volume_view_3<Kernel> view_of(const Image_pieces& pieces, const Image_piece& piece, int component,
                              const Cell_block& cells);

/// So many ghost levels a piece of an image needs, wherever it is.
int needed_ghost_levels(const Volume_options& options);

/// The cells at whose nodes samples must be known for the surface in a block.
Cell_block needed_cells(const Cell_block& block, const Lattice_3<Kernel>& lattice, const Volume_options& options);

} // namespace equiaffine

#endif
