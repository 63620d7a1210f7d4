// SPDX-License-Identifier: GPL-3.0-or-later
#include "Image_pieces.h"

#include "exchange_ghost_levels.h"
#include <equiaffine/marching_cubes/marching_cubes_in_slabs.h>
#include <equiaffine/volume/Spline_function_3.h>

#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkExtentTranslator.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace equiaffine {

namespace {

using Extent = std::array<int, 6>;

bool contains_extent(const Extent& e, const Extent& other) {
  for (std::size_t a = 0; a < 3; ++a)
    if (other[2 * a] < e[2 * a] || e[2 * a + 1] < other[2 * a + 1]) return false;
  return true;
}

bool is_empty(const Extent& e) { return e[0] >= e[1] || e[2] >= e[3] || e[4] >= e[5]; }

Extent extent_of(vtkImageData* image) {
  Extent extent;
  image->GetExtent(extent.data());
  return extent;
}

/// The extent of the cells of an image that are not marked as belonging to another piece.
Extent own_extent(vtkImageData* image) {
  const Extent extent = extent_of(image);
  vtkUnsignedCharArray* const ghosts = image->GetCellGhostArray();
  if (!ghosts || is_empty(extent)) return extent;
  constexpr int most = std::numeric_limits<int>::max();
  Extent own = {most, -most, most, -most, most, -most};
  vtkIdType cell = 0;
  for (int k = extent[4]; k < extent[5]; ++k)
    for (int j = extent[2]; j < extent[3]; ++j)
      for (int i = extent[0]; i < extent[1]; ++i)
        if (!(ghosts->GetValue(cell++) & vtkDataSetAttributes::DUPLICATECELL))
          own = {std::min(own[0], i),     std::max(own[1], i + 1), std::min(own[2], j),
                 std::max(own[3], j + 1), std::min(own[4], k),     std::max(own[5], k + 1)};
  return own;
}

/// The properties that must agree in the images of all processes, as numbers.
std::vector<double> frame_of(vtkImageData* image) {
  std::vector<double> frame(image->GetOrigin(), image->GetOrigin() + 3);
  frame.insert(frame.end(), image->GetSpacing(), image->GetSpacing() + 3);
  frame.insert(frame.end(), image->GetDirectionMatrix()->GetData(), image->GetDirectionMatrix()->GetData() + 9);
  vtkDataArray* const samples = image->GetPointData()->GetScalars();
  frame.insert(frame.end(), {double(samples->GetDataType()), double(samples->GetNumberOfComponents())});
  return frame;
}

/// Minima and maxima of numbers over all processes, some of which can have none.
struct Range {
  std::vector<double> least, greatest;
  explicit Range(std::size_t size)
      : least(size, std::numeric_limits<double>::infinity()), greatest(size, -std::numeric_limits<double>::infinity()) {
  }
  void add(const std::vector<double>& numbers) {
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      least[n] = std::min(least[n], numbers[n]);
      greatest[n] = std::max(greatest[n], numbers[n]);
    }
  }
  void reduce(const Ranks& ranks) {
    ranks.least(least);
    ranks.greatest(greatest);
  }
};

/// The extent of a piece as a source would choose it; empty if there are more pieces than cells.
Extent extent_of_piece(Extent whole, const Piece_request& request) {
  Extent extent;
  const vtkNew<vtkExtentTranslator> translator;
  if (!translator->PieceToExtentThreadSafe(request.piece, request.pieces, 0, whole.data(), extent.data(),
                                           vtkExtentTranslator::BLOCK_MODE, 0))
    return {0, -1, 0, -1, 0, -1};
  return extent;
}

Cell_block cells_between(const Extent& extent, const std::array<int, 3>& first) {
  Cell_block cells;
  for (std::size_t a = 0; a < 3; ++a) {
    cells.first[a] = std::size_t(extent[2 * a] - first[a]);
    cells.end[a] = std::size_t(extent[2 * a + 1] - first[a]);
  }
  return cells;
}

std::int64_t number_of(const Cell_block& cells) {
  std::int64_t count = 1;
  for (std::size_t a = 0; a < 3; ++a) count *= std::int64_t(cells.end[a] - cells.first[a]);
  return count;
}

/// The lattice of an image with this frame.
Lattice_3<Kernel> lattice_of(const std::vector<double>& frame, const Extent& whole, const Volume_options& options) {
  std::array<std::size_t, 3> size;
  for (std::size_t a = 0; a < 3; ++a) {
    size[a] = std::size_t(whole[2 * a + 1] - whole[2 * a]) + 1;
    require(size[a] > std::size_t(options.spline_degree),
            "too few points of the image along axis " + std::string(1, "ijk"[a]) + ": " + std::to_string(size[a]) +
                ", but a spline of degree " + std::to_string(options.spline_degree) + " needs at least " +
                std::to_string(options.spline_degree + 1) + "; choose a smaller degree or a larger image");
  }
  std::array<double, 3> origin = {frame[0], frame[1], frame[2]};
  std::array<Kernel::Vector_3, 3> steps;
  for (std::size_t a = 0; a < 3; ++a) { // column a of the direction matrix, times the spacing
    const std::array<double, 3> step = {frame[6 + a] * frame[3 + a], frame[9 + a] * frame[3 + a],
                                        frame[12 + a] * frame[3 + a]};
    steps[a] = Kernel::Vector_3(step[0], step[1], step[2]);
    for (std::size_t c = 0; c < 3; ++c) origin[c] += whole[2 * a] * step[c];
  }
  return Lattice_3<Kernel>(size, Kernel::Point_3(origin[0], origin[1], origin[2]), steps);
}

bool contains(const Cell_block& cells, const Cell_block& others) {
  for (std::size_t a = 0; a < 3; ++a)
    if (others.first[a] < cells.first[a] || cells.end[a] < others.end[a]) return false;
  return true;
}

/// Whether a piece of this process needs samples that its image does not contain.
bool lacks_samples(const Image_pieces& pieces, const Piece_request& request) {
  const auto& lattice = *pieces.lattice;
  return std::any_of(pieces.pieces.begin(), pieces.pieces.end(), [&](const Image_piece& piece) {
    const Cell_block wanted =
        widened(piece.cells, std::size_t(request.ghost_levels), equiaffine::cells_of(lattice.size()));
    return !contains(cells_of(pieces, piece.image), needed_cells(wanted, lattice, request.volume));
  });
}

/// The minimum number of cells of an image along an axis that is divided: the maximum number of ghost levels that
/// images can provide to their neighbors.
double least_thickness(const Image_pieces& pieces) {
  double least = std::numeric_limits<double>::infinity();
  for (const Image_piece& piece : pieces.pieces) {
    const Cell_block cells = cells_between(own_extent(piece.image), pieces.first);
    for (std::size_t a = 0; a < 3; ++a)
      if (const std::size_t n = cells.end[a] - cells.first[a]; n + 1 < pieces.lattice->size()[a])
        least = std::min(least, double(n));
  }
  return least;
}

/// The image with only the array of samples and the marks of cells of other pieces.
vtkSmartPointer<vtkImageData> with_samples_only(vtkImageData* image, int component, const Find_array& find) {
  vtkDataArray* const array = find(image);
  require(array, "the selected point array does not exist or is not numeric; choose another point array of the image");
  const std::string name = array->GetName() ? " '" + std::string(array->GetName()) + "'" : "";
  require(array->GetNumberOfTuples() == image->GetNumberOfPoints(),
          "the array" + name + " does not have one tuple per point of the image: " +
              std::to_string(array->GetNumberOfTuples()) + ", not " + std::to_string(image->GetNumberOfPoints()) +
              "; choose a point array, or convert cell data to point data");
  const int components = array->GetNumberOfComponents();
  require(component < components, "the array" + name + " has " + std::to_string(components) +
                                      (components == 1 ? " component" : " components") + ", so there is no component " +
                                      std::to_string(component) + "; count components from 0");
  const auto samples = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  samples->ShallowCopy(array);
  samples->SetName("samples");
  vtkNew<vtkImageData> result;
  result->CopyStructure(image);
  result->GetPointData()->SetScalars(samples);
  if (vtkUnsignedCharArray* const ghosts = image->GetCellGhostArray()) {
    require(ghosts->GetNumberOfTuples() == image->GetNumberOfCells(),
            "the array vtkGhostType does not have one value per cell of the image; remove or correct it");
    result->GetCellData()->AddArray(ghosts);
  }
  return result;
}

} // namespace

std::vector<vtkSmartPointer<vtkImageData>> images_of(vtkDataObject* input, int component, const Find_array& find) {
  std::vector<vtkSmartPointer<vtkImageData>> images;
  const auto add = [&](vtkDataObject* object) {
    auto* const image = vtkImageData::SafeDownCast(object);
    require(image || !object, "a block of the input is not an image; resample it to an image");
    if (image && image->GetNumberOfPoints() > 0) images.push_back(with_samples_only(image, component, find));
  };
  if (auto* const parts = vtkCompositeDataSet::SafeDownCast(input)) {
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(parts->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
      add(iterator->GetCurrentDataObject());
  } else {
    add(input);
  }
  return images;
}

Image_pieces image_pieces(std::vector<vtkSmartPointer<vtkImageData>> images, const std::array<int, 6>& whole_extent,
                          const Piece_request& request, const Ranks& ranks, vtkMultiProcessController* controller) {
  Range frames(17), extents(6), reported(6);
  std::int64_t other_parts = 0; // not 0 if the part of this process differs from that of a source
  together(ranks, [&] {
    const Extent of_piece =
        is_empty(whole_extent) ? Extent{0, -1, 0, -1, 0, -1} : extent_of_piece(whole_extent, request);
    for (const auto& image : images) {
      const std::vector<double> frame = frame_of(image);
      for (const double x : frame)
        require(std::isfinite(x), "the origin, spacing or direction of the image is not finite; correct it");
      frames.add(frame);
      const Extent own = own_extent(image);
      extents.add({own.begin(), own.end()});
      other_parts += !is_empty(of_piece) && !contains_extent(extent_of(image), of_piece);
    }
    other_parts += images.empty() && !is_empty(of_piece);
    reported.add({whole_extent.begin(), whole_extent.end()});
  });
  for (Range* const range : {&frames, &extents, &reported}) range->reduce(ranks);
  ranks.sum(std::span(&other_parts, 1));
  Image_pieces result;
  if (extents.least[0] > extents.greatest[1]) return result;

  // A source that can provide any part of an image reports the same whole extent in all processes. Otherwise the whole
  // extent is the union of the images.
  const bool is_reported = reported.least == reported.greatest && !is_empty(whole_extent);
  const bool is_given_by_source = is_reported && other_parts == 0;
  Extent whole = whole_extent;
  for (std::size_t a = 0; a < 3 && !is_reported; ++a) {
    whole[2 * a] = int(extents.least[2 * a]);
    whole[2 * a + 1] = int(extents.greatest[2 * a + 1]);
  }
  std::int64_t missing = 0, lacks = 0;
  together(ranks, [&] {
    require(frames.least == frames.greatest, "the pieces of the image differ in origin, spacing, direction, data type "
                                             "or number of components; use pieces of one image");
    result.lattice = lattice_of(frames.least, whole, request.volume);
    result.first = {whole[0], whole[2], whole[4]};
    const std::int64_t cells = number_of(equiaffine::cells_of(result.lattice->size()));
    // A process that makes all pieces one after the other has the whole image.
    result.are_whole = is_given_by_source && request.pieces != ranks.count();
    require(
        is_given_by_source || ranks.count() == 1 || request.pieces == ranks.count(),
        "images in memory are one piece per process; request " + std::to_string(ranks.count()) + " pieces, not " +
            std::to_string(request.pieces));
    for (const auto& image : images) {
      const Extent own = is_given_by_source ? extent_of_piece(whole, request) : own_extent(image);
      if (is_empty(own)) continue;
      const Cell_block block = cells_between(own, result.first);
      result.pieces.push_back({image, block, result.are_whole ? cells_of(result, image) : block});
      if (!result.are_whole) missing -= number_of(block);
    }
    if (!result.are_whole && ranks.number() == 0) missing += cells;
    lacks = lacks_samples(result, request);
  });
  std::array<std::int64_t, 2> sums = {missing, lacks};
  ranks.sum(sums);
  together(ranks, [&] {
    require(sums[0] == 0, "the pieces of the image overlap or leave gaps; assign each cell to exactly one piece");
  });
  if (sums[1] > 0) {
    const int levels = needed_ghost_levels(request.volume) + request.ghost_levels;
    std::array<double, 1> thickness = {least_thickness(result)};
    ranks.least(thickness);
    std::vector<vtkSmartPointer<vtkImageData>> exchanged;
    for (const Image_piece& piece : result.pieces) exchanged.push_back(piece.image);
    exchange_ghost_levels(exchanged, int(std::min(double(levels), thickness[0])), controller);
    for (std::size_t n = 0; n < exchanged.size(); ++n) result.pieces[n].image = exchanged[n];
    together(ranks, [&] {
      require(!lacks_samples(result, request),
              "the pieces of the image are too thin: a piece needs " + std::to_string(levels) +
                  " ghost levels from its neighbors; use fewer pieces" +
                  (!request.volume.smoothing ? ", or set the smoothing" : ", less smoothing, or a smaller degree"));
    });
  }
  result.are_wanted = is_given_by_source || request.pieces == ranks.count() || request.piece == 0;
  return result;
}

Cell_block cells_of(const Image_pieces& pieces, vtkImageData* image) {
  return cells_between(extent_of(image), pieces.first);
}

Volume_view_3<Kernel> view_of(const Image_pieces& pieces, const Image_piece& piece, int component,
                              const Cell_block& cells) {
  vtkDataArray* const array = piece.image->GetPointData()->GetScalars();
  vtkSmartPointer<vtkDataArray> samples = array;
  if (!array->HasStandardMemoryLayout()) {
    samples.TakeReference(vtkDataArray::CreateDataArray(array->GetDataType()));
    samples->DeepCopy(array);
  }
  const auto owner = std::make_shared<const vtkSmartPointer<vtkDataArray>>(samples);
  const Extent extent = extent_of(piece.image);
  const auto step = std::ptrdiff_t(samples->GetDataTypeSize()) * samples->GetNumberOfComponents(),
             row = step * (extent[1] - extent[0] + 1), slab = row * (extent[3] - extent[2] + 1);
  const Cell_block have = cells_of(pieces, piece.image);
  vtkIdType first = component; // index of the first number
  for (std::size_t a = 0; a < 3; ++a)
    first += vtkIdType(cells.first[a] - have.first[a]) *
             vtkIdType(std::array{step, row, slab}[a] / samples->GetDataTypeSize());
  const auto view = [&](const auto* numbers) {
    return Volume_view_3<Kernel>::part(*pieces.lattice, cells, numbers + first, {step, row, slab}, owner);
  };
  void* const memory = samples->GetVoidPointer(0);
  switch (samples->GetDataType()) { vtkTemplateMacro(return view(static_cast<const VTK_TT*>(memory))); }
  throw std::invalid_argument("the array of the image is not numeric; choose another one");
}

Cell_block needed_cells(const Cell_block& block, const Lattice_3<Kernel>& lattice, const Volume_options& options) {
  const Cell_block all = equiaffine::cells_of(lattice.size());
  if (options.spline_scheme == Spline_scheme::INTERPOLATION) return all;
  return cells_to_know(widened(block, cells_around_block, all), lattice.size(), options);
}

int needed_ghost_levels(const Volume_options& options) {
  if (options.spline_scheme == Spline_scheme::INTERPOLATION) return 0;
  const double smoothing = options.smoothing.value_or(greatest_scale_to_choose);
  const std::size_t n = 64 + 16 * std::size_t(smoothing + 1); // large enough for both borders and the interior
  const Lattice_3<Kernel> lattice({n, n, n}, CGAL::Bbox_3(0, 0, 0, 1, 1, 1));
  std::size_t levels = 0;
  for (const std::size_t c : {std::size_t(0), n / 2}) { // a cell at the border needs samples farthest inward
    const Cell_block needed = needed_cells({{c, c, c}, {c + 1, c + 1, c + 1}}, lattice, options);
    levels = std::max({levels, c - needed.first[0], needed.end[0] - c - 1});
  }
  return int(levels);
}

} // namespace equiaffine
