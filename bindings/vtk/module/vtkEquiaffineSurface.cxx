// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkEquiaffineSurface.h"

#include "Doubt.h"
#include "Image_pieces.h"
#include "Measured_samples.h"
#include "Ranks.h"
#include "Surface_arrays.h"
#include "is_aborted.h"
#include <equiaffine/attributes/Curvature_error_3.h>
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/engine/vectorized.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/internal/point_blocks.h>
#include <equiaffine/marching_cubes/marching_cubes_in_slabs.h>
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Spline_function_3.h>

#include <CGAL/tags.h>

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace equiaffine;
using Tag = CGAL::Parallel_if_available_tag;
using Traits = Sampled_function_traits_3<equiaffine::Kernel>;

/// The properties of the filter that determine the result.
struct Task {
  Piece_request request;
  Volume_options volume; ///< with a smoothing once it is chosen
  Orientation_of_level_set orientation;
  Vertex_position position;
  Attribute_selection selection;
  Doubtful doubtful;
  Error_rows errors; ///< of those selected attributes that have errors
};

/// Errors of a function; only available for splines through whole images.
using Errors = std::optional<Curvature_error_3<equiaffine::Kernel>>;

/// The cells of a piece's image whose samples are used. If a scale of smoothing was chosen below the maximum, some
/// ghost levels are not used.
Cell_block used_cells(const Image_piece& piece, const Image_pieces& pieces, const Task& task) {
  if (pieces.are_whole) return cells_of(pieces, piece.image);
  const Cell_block all = cells_of(pieces.lattice->size()),
                   block = widened(piece.cells, std::size_t(task.request.ghost_levels), all);
  return clamped(needed_cells(block, *pieces.lattice, task.volume), cells_of(pieces, piece.image));
}

/// The functions of the pieces of this process. All processes combine their surveys of the whole image.
std::vector<Traits> functions_of(const Views& views, const Image_pieces& pieces, const Task& task, const Ranks& ranks) {
  std::optional<Volume_survey> survey; // of all pieces
  const auto reduce = [&](Volume_survey own) {
    ranks.check("");
    ranks.add(own);
    survey = own;
  };
  std::vector<Traits> functions;
  together(ranks, [&] {
    if (views.size() > 1) { // survey the pieces of this process first
      Volume_survey own;
      for (std::size_t n = 0; n < views.size(); ++n)
        Traits(views[n], task.volume, Volume_part{pieces.pieces[n].surveyed, [&](Volume_survey& s) { own.add(s); }},
               Tag());
      reduce(own);
    } else if (views.empty()) {
      reduce({});
    }
    for (std::size_t n = 0; n < views.size(); ++n)
      functions.emplace_back(views[n], task.volume,
                             Volume_part{pieces.pieces[n].surveyed,
                                         [&](Volume_survey& s) {
                                           if (!survey) reduce(s);
                                           s = *survey;
                                         }},
                             Tag());
  });
  return functions;
}

/// Throws if an option is invalid, with the name of the filter's property in the message.
void check(const Volume_options& options) {
  try {
    options.check();
  } catch (const Input_error& error) {
    std::string name;
    for (const char c : "_" + error.field()) {
      if (!name.empty() && name.back() == '_') name.back() = char(std::toupper(c));
      else name.push_back(c);
    }
    throw std::invalid_argument(name + ": " + error.sentence());
  }
}

/// Throws unless the properties of the filter are the same in all processes.
void check_that_properties_agree(const Task& task, int component, const Ranks& ranks) {
  std::string names;
  for (const Attribute& attribute : task.selection.columns) names.append(attribute.name).append(",");
  std::array<double, 11> least = {double(task.request.volume.spline_degree),
                                  double(task.request.volume.spline_scheme),
                                  task.request.volume.smoothing.value_or(-1),
                                  *task.request.volume.level,
                                  double(task.orientation),
                                  double(task.position),
                                  double(component),
                                  double(task.doubtful),
                                  double(task.errors.size()),
                                  double(task.request.ghost_levels),
                                  double(std::hash<std::string>()(names))},
                         greatest = least;
  ranks.least(least);
  ranks.greatest(greatest);
  ranks.check(least == greatest ? ""
                                : "the properties of the filter differ between processes; set the same in all of them");
}

/// Throws if all samples are NaN or infinite, so that the surface is empty for every level.
void check_that_there_are_numbers(const Views& views, const Ranks& ranks) {
  std::array<std::int64_t, 2> rows = {0, std::int64_t(views.size())}; // rows with a finite number, and pieces
  for (const auto& view : views) {
    const auto& [first, end] = view.cells();
    std::vector<double> row(end[0] + 1 - first[0]);
    for (std::size_t k = first[2]; k <= end[2]; ++k)
      for (std::size_t j = first[1]; j <= end[1]; ++j) {
        view.copy_line({first[0], j, k}, 0, row);
        rows[0] += std::any_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
      }
  }
  ranks.sum(rows);
  ranks.check(rows[0] == 0 && rows[1] > 0 ? "the array has no finite values; choose another array" : "");
}

/// Cells around a block in which the function is known, given samples at the nodes of the cells `have`. Not necessarily
/// all such cells.
Cell_block known_cells(const Cell_block& block, const Cell_block& have, const Image_pieces& pieces,
                       const Volume_options& options) {
  const Cell_block all = cells_of(pieces.lattice->size());
  if (have == all) return all;
  Cell_block known = widened(block, cells_around_block, all);
  for (std::size_t margin = 2 * cells_around_block;; margin *= 2) {
    const Cell_block more = widened(block, margin, all);
    const Cell_block needed = cells_to_know(more, pieces.lattice->size(), options);
    if (more == known || clamped(needed, have) != needed) return known;
    known = more;
  }
}

/// Layers per slab: a quarter of the block, so at most a quarter of its surface is in memory twice. Thinner slabs
/// recompute more layers at their boundaries.
std::size_t layers_of_slab(const Cell_block& block) {
  constexpr std::size_t least = 32;
  return std::max(least, (block.end[2] - block.first[2] + 3) / 4);
}

/// Adds the columns of errors to the attributes.
void add_errors(const Errors& errors, std::span<const equiaffine::Kernel::Point_3> points, const Error_rows& rows,
                Vertex_attributes& attributes) {
  if (!errors) return;
  std::vector<Local_structure_error_3<double>> at_points(points.size());
  for_each_point_block<Tag>(*errors, points, 64, 0, [&](const auto& local, std::span<const std::size_t> numbers) {
    for (const std::size_t n : numbers) at_points[n] = {local(points[n]), 0, 0, 0, 0, 0, 0, 0, 0};
  });
  for (const auto& row : rows) {
    auto& column = attributes.columns.emplace_back(Vertex_attributes::Column{row.name, {}});
    for (const auto& error : at_points) column.values.push_back(row.row->error.get(error));
  }
}

/// Meshes the pieces, and calls advance(part) with the finished fraction of the work, from 0 to 1.
template <class Advance>
void mesh_pieces(const std::vector<Traits>& functions, const Views& views, const Image_pieces& pieces, const Task& task,
                 const std::optional<Sample_noise>& noise, Surface_arrays& arrays, const Advance& advance) {
  const Lattice_3<equiaffine::Kernel>& lattice = *pieces.lattice;
  for (std::size_t n = 0; n < functions.size(); ++n) {
    const Level_set_traits_3<Traits> function(functions[n], *task.volume.level, task.orientation);
    const Level_set_traits_3 vectorized_function(vectorized::Spline(functions[n]), *task.volume.level,
                                                 task.orientation);
    const Cell_block all = cells_of(lattice.size()), own = pieces.pieces[n].cells,
                     block = widened(own, std::size_t(task.request.ghost_levels), all);
    const Cell_block known = known_cells(block, views[n].cells(), pieces, task.volume);
    Errors errors;
    if (noise) errors.emplace(functions[n], views[n], *task.volume.smoothing, noise->deviation, Tag());
    arrays.begin_piece();
    marching_cubes_of_block<Tag>(
        function, block,
        [&](const Isosurface_slab_3<equiaffine::Kernel>& slab) {
          arrays.add(
              slab, [&](std::span<const equiaffine::Kernel::Point_3> points, std::span<const Point_status> status) {
                auto attributes = vectorized::compute_attributes(vectorized_function, points, task.selection, status);
                add_errors(errors, points, task.errors, attributes);
                return attributes;
              });
          const double of_piece = double(slab.end_plane - block.first[2]) / double(block.end[2] - block.first[2]);
          advance((double(n) + of_piece) / double(functions.size()));
        },
        {.sampling = {.vertices = task.position}, .planes_per_slab = layers_of_slab(block)}, known);
  }
}

} // namespace

vtkStandardNewMacro(vtkEquiaffineSurface);
vtkCxxSetObjectMacro(vtkEquiaffineSurface, Controller, vtkMultiProcessController);

vtkEquiaffineSurface::vtkEquiaffineSurface() {
  this->SetAttributes("all");
  this->SetController(vtkMultiProcessController::GetGlobalController());
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkEquiaffineSurface::~vtkEquiaffineSurface() {
  this->SetAttributes(nullptr);
  this->SetController(nullptr);
}

void vtkEquiaffineSurface::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Level: " << this->Level << '\n'
     << indent << "SplineDegree: " << this->SplineDegree << '\n'
     << indent << "SplineScheme: " << this->SplineScheme << '\n'
     << indent << "Smoothing: " << this->Smoothing << '\n'
     << indent << "AutomaticSmoothing: " << this->AutomaticSmoothing << '\n'
     << indent << "EstimateErrors: " << this->EstimateErrors << '\n'
     << indent << "HideUnknown: " << this->HideUnknown << '\n'
     << indent << "Attributes: " << (this->Attributes ? this->Attributes : "(none)") << '\n'
     << indent << "Orientation: " << this->Orientation << '\n'
     << indent << "Vertices: " << this->Vertices << '\n'
     << indent << "ArrayComponent: " << this->ArrayComponent << '\n'
     << indent << "Controller: " << this->Controller << '\n';
}

int vtkEquiaffineSurface::FillInputPortInformation(int, vtkInformation* info) {
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  // Otherwise the pipeline would call the filter separately for each block.
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkEquiaffineSurface::GetNumberOfGhostLevels() {
  try {
    return needed_ghost_levels(this->GetOptions());
  } catch (const std::exception& error) {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

equiaffine::Volume_options vtkEquiaffineSurface::GetOptions() const {
  constexpr std::array schemes = {Spline_scheme::QUASI_INTERPOLATION, Spline_scheme::CONVOLUTION,
                                  Spline_scheme::INTERPOLATION};
  return {.smoothing = this->AutomaticSmoothing ? std::nullopt : std::optional(this->Smoothing),
          .spline_scheme = schemes[std::size_t(this->SplineScheme)],
          .spline_degree = this->SplineDegree,
          .level = this->Level};
}

// Requests a piece of the image with ghost levels if every process has one piece, otherwise the whole image.
int vtkEquiaffineSurface::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
                                              vtkInformationVector* outputs) {
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* const input = inputs[0]->GetInformationObject(0);
  vtkInformation* const output = outputs->GetInformationObject(0);
  const int ghosts = output->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS());
  const Ranks ranks(this->Controller);
  const int pieces = std::max(1, output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()));
  if (pieces == 1 && ranks.count() > 1) { // no piece was requested
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), ranks.number());
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), ranks.count());
  }
  if (ranks.count() == 1 && pieces == 1) {
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  } else if (pieces == 1 || pieces == ranks.count()) {
    int levels = 0;
    try {
      levels = needed_ghost_levels(this->GetOptions());
    } catch (const Input_error&) { // RequestData() reports the error
    }
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), ghosts + levels);
  } else {
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    if (input->Has(Pipeline::WHOLE_EXTENT()))
      input->Set(Pipeline::UPDATE_EXTENT(), input->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  return 1;
}

int vtkEquiaffineSurface::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) {
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* const info = outputs->GetInformationObject(0);
  vtkPolyData* const output = vtkPolyData::GetData(info);
  const Ranks ranks(this->Controller);
  try {
    const int pieces_wanted = std::max(1, info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()));
    const bool is_of_process = pieces_wanted == 1; // each process makes its piece if no piece was requested
    Task task = {{.piece = is_of_process ? ranks.number() : info->Get(Pipeline::UPDATE_PIECE_NUMBER()),
                  .pieces = is_of_process ? ranks.count() : pieces_wanted,
                  .ghost_levels = info->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()),
                  .volume = this->GetOptions()},
                 this->GetOptions(),
                 this->Orientation == AGAINST ? Orientation_of_level_set::AGAINST_GRADIENT
                                              : Orientation_of_level_set::ALONG_GRADIENT,
                 this->Vertices == PROJECTED ? Vertex_position::PROJECTED : Vertex_position::LINEAR,
                 {},
                 this->HideUnknown ? Doubtful::HIDDEN : Doubtful::COUNTED,
                 {}};
    vtkInformation* const input = inputs[0]->GetInformationObject(0);
    vtkDataObject* const data = input->Get(vtkDataObject::DATA_OBJECT());
    std::vector<vtkSmartPointer<vtkImageData>> images;
    std::array<int, 6> whole_extent = {0, -1, 0, -1, 0, -1};
    together(ranks, [&] {
      check(task.volume);
      const bool has_attributes = this->Attributes && *this->Attributes != '\0';
      task.selection = select_attributes(has_attributes ? this->Attributes : "none");
      refuse_attributes_of_mesh(task.selection); // slabs and pieces are not whole meshes
      task.errors = this->EstimateErrors ? selected_errors(task.selection, true) : Error_rows();
      require(task.volume.spline_scheme != Spline_scheme::INTERPOLATION || ranks.count() == 1,
              "spline interpolation needs the whole image in one process; use one process, or choose "
              "quasi-interpolation");
      images = images_of(data, this->ArrayComponent, [this](vtkImageData* image) -> vtkDataArray* {
        const char* const name = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
        if (name && *name == '\0') return image->GetPointData()->GetScalars(); // a script can leave the name empty
        int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
        vtkDataArray* const array = this->GetInputArrayToProcess(0, image, association);
        return association == vtkDataObject::FIELD_ASSOCIATION_POINTS ? array : nullptr;
      });
      if (vtkImageData::SafeDownCast(data) && input->Has(Pipeline::WHOLE_EXTENT()))
        input->Get(Pipeline::WHOLE_EXTENT(), whole_extent.data());
    });
    check_that_properties_agree(task, this->ArrayComponent, ranks);
    Image_pieces pieces = image_pieces(images, whole_extent, task.request, ranks, this->Controller);
    if (!pieces.lattice) return 1;
    if (pieces.pieces.size() > 1) task.request.ghost_levels = 0;
    const auto advance = [this](double part) {
      this->UpdateProgress(part);
      if (is_aborted(*this)) throw Stopped();
    };
    const Progress_observer observer([&](const Progress_observer::Stage&) { advance(this->GetProgress()); });
    Views views;
    const auto view_pieces = [&](const auto& cells_of_piece) {
      together(ranks, [&] {
        views.clear();
        for (const Image_piece& piece : pieces.pieces)
          views.push_back(view_of(pieces, piece, this->ArrayComponent, cells_of_piece(piece)));
      });
    };
    std::optional<Sample_noise> noise;
    if (this->AutomaticSmoothing) {
      view_pieces([&](const Image_piece& piece) { return cells_of(pieces, piece.image); });
      noise = measured_noise(views, pieces, this->Level, ranks);
      task.volume.smoothing = chosen_smoothing(views, pieces, *noise, task.volume, ranks);
    }
    if (!pieces.are_wanted) pieces.pieces.clear();
    view_pieces([&](const Image_piece& piece) { return used_cells(piece, pieces, task); });
    const bool has_errors = !task.errors.empty() && are_whole(views, ranks);
    if (!has_errors) task.doubtful = Doubtful::UNTESTED;
    else if (!noise) noise = measured_noise(views, pieces, this->Level, ranks);
    const std::vector<Traits> functions = functions_of(views, pieces, task, ranks);
    std::vector<Cell_block> own;
    for (const Image_piece& piece : pieces.pieces) own.push_back(piece.cells);
    Surface_arrays surface(task.selection, task.errors, task.doubtful, own, pieces.lattice->size(),
                           task.request.pieces > 1 || ranks.count() > 1, task.request.ghost_levels > 0);
    together(ranks,
             [&] { mesh_pieces(functions, views, pieces, task, has_errors ? noise : std::nullopt, surface, advance); });
    const auto add_number = [&](const char* name, double number) {
      const vtkNew<vtkDoubleArray> array;
      array->SetName(name);
      array->InsertNextValue(number);
      output->GetFieldData()->AddArray(array);
    };
    add_number("smoothing", *task.volume.smoothing);
    if (noise) add_number("noise", noise->deviation);
    const auto [vertices, verdict] = surface.add_statistics(ranks, *output->GetFieldData());
    if (vertices == 0) check_that_there_are_numbers(views, ranks);
    together(ranks, [&] { surface.move_to(*output); });
    output->GetPointData()->SetActiveScalars(verdict.first_shown.c_str());
    const bool is_of_steps = vertices > 0 && !task.selection.columns.empty() && task.volume.smoothing == 0;
    const auto values = is_of_steps ? counted_values(views, pieces, ranks) : std::nullopt;
    if (vertices == 0 || ranks.number() > 0) return 1;
    if (values)
      vtkWarningMacro("the samples have only " << *values << " distinct values, and the curvatures show the steps "
                                                             "between them; set Smoothing or AutomaticSmoothing");
    for (const std::string& sentence : verdict.sentences) vtkWarningMacro(<< sentence);
    if (!has_errors && !task.errors.empty())
      vtkWarningMacro(
          "the errors of affine curvatures are not estimated, since that needs the whole image in each process; "
          "provide it, or turn EstimateErrors off");
  } catch (const Stopped&) {
    output->Initialize();
  } catch (const Failure& error) {
    output->Initialize();
    vtkErrorMacro(<< error.what());
  } catch (const std::exception& error) { // not in all processes
    output->Initialize();
    vtkErrorMacro(<< error.what());
  }
  return 1; // also after an error, since 0 would make the pipeline print a second error
}
