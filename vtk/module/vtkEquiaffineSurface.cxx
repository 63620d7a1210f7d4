// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkEquiaffineSurface.h"

#include "Image_pieces.h"
#include "Ranks.h"
#include "Surface_arrays.h"
#include <equiaffine/Level_set_traits_3.h>
#include <equiaffine/Progress_observer.h>
#include <equiaffine/Sampled_function_traits_3.h>
#include <equiaffine/attributes.h>
#include <equiaffine/marching_cubes_in_slabs.h>

#include <CGAL/tags.h>

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkVersionMacros.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace equiaffine;
using Tag = CGAL::Parallel_if_available_tag;
using Traits = Sampled_function_traits_3<equiaffine::Kernel>;

/// Is thrown where the user ends the work.
struct Aborted {};

/// The properties of the filter that say what is computed.
struct Task {
  Piece_request request;
  double isovalue;
  Orientation_of_level_set orientation;
  Vertex_position position;
  Attribute_selection selection;
};

/// The functions of the pieces of this process. All processes add up what they know of the whole image.
std::vector<Traits> functions_of(const std::vector<Volume_view_3<equiaffine::Kernel>>& views,
                                 const Image_pieces& pieces, const Task& task, const Ranks& ranks) {
  const auto cells_of_survey = [&](const Image_piece& piece) {
    return task.request.pieces == ranks.count() ? piece.cells : cells_of(pieces, piece.image); // else it has the image
  };
  std::optional<Volume_survey> survey; // of all pieces
  const auto reduce = [&](Volume_survey own) {
    ranks.check("");
    ranks.add(own);
    survey = own;
  };
  std::vector<Traits> functions;
  together(ranks, [&] {
    try {
      if (views.size() > 1) { // the pieces of this process are surveyed first
        Volume_survey own;
        for (std::size_t n = 0; n < views.size(); ++n)
          Traits(views[n], task.request.spline,
                 Volume_part{cells_of_survey(pieces.pieces[n]), [&](Volume_survey& s) { own.add(s); }}, Tag());
        reduce(own);
      } else if (views.empty()) {
        reduce({});
      }
      for (std::size_t n = 0; n < views.size(); ++n)
        functions.emplace_back(views[n], task.request.spline,
                               Volume_part{cells_of_survey(pieces.pieces[n]),
                                           [&](Volume_survey& s) {
                                             if (!survey) reduce(s);
                                             s = *survey;
                                           }},
                               Tag());
    } catch (const Failure&) {
      throw;
    } catch (const std::exception& error) {
      if (!survey) ranks.check(error.what()); // the others are waiting for the survey
      throw;
    }
  });
  return functions;
}

/// The arrays of the pieces of an image, as find(image, association) finds them.
template <class Find>
std::vector<vtkDataArray*> arrays_of(const Image_pieces& pieces, int component, const Find& find) {
  std::vector<vtkDataArray*> arrays;
  for (const Image_piece& piece : pieces.pieces) {
    int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
    vtkDataArray* const array = find(piece.image, association);
    const std::string name = array && array->GetName() ? " '" + std::string(array->GetName()) + "'" : "";
    require(array, "the image has no such point array of numbers; choose one of its point arrays");
    require(association == vtkDataObject::FIELD_ASSOCIATION_POINTS &&
                array->GetNumberOfTuples() == piece.image->GetNumberOfPoints(),
            "the array" + name +
                " has no number for each point of the image; choose a point array, or convert "
                "cell data to point data");
    require(component < array->GetNumberOfComponents(),
            "the array" + name + " has " + std::to_string(array->GetNumberOfComponents()) +
                (array->GetNumberOfComponents() == 1 ? " component" : " components") + ", of which number " +
                std::to_string(component) + " is none; they count from 0");
    arrays.push_back(array);
  }
  return arrays;
}

/// Throws if there is no number at all, so that the surface is empty whatever the isovalue is.
void check_that_there_are_numbers(const std::vector<Volume_view_3<equiaffine::Kernel>>& views, const Ranks& ranks) {
  std::array<std::int64_t, 1> rows = {0}; // those with a number
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
  ranks.check(rows[0] == 0 ? "no point of the image has a finite number; choose another array" : "");
}

/// Meshes the pieces, and calls advance(part) with the part of the work that is done, from 0 to 1.
template <class Advance>
void mesh_pieces(const std::vector<Traits>& functions, const Image_pieces& pieces, const Task& task,
                 Surface_arrays& arrays, const Advance& advance) {
  const Lattice_3<equiaffine::Kernel>& lattice = *pieces.lattice;
  double done = 0;
  for (std::size_t n = 0; n < functions.size(); ++n) {
    const Level_set_traits_3<Traits> function(functions[n], task.isovalue, task.orientation);
    const Cell_block all = cells_of(lattice.size()), own = pieces.pieces[n].cells,
                     block = widened(own, std::size_t(task.request.ghost_levels), all);
    arrays.begin_piece();
    marching_cubes_in_slabs<Tag>(
        function,
        [&](const Isosurface_slab_3<equiaffine::Kernel>& slab) {
          arrays.add(slab,
                     [&](std::span<const equiaffine::Kernel::Point_3> points, std::span<const Point_status> status) {
                       return compute_attributes<Tag>(function, points, task.selection, status);
                     });
          done = (double(n) + double(slab.end_plane - block.first[2]) / double(block.end[2] - block.first[2])) /
                 double(functions.size());
          advance(done);
        },
        parameters::cell_block(block)
            .planes_per_slab(32)
            .known_cells(widened(block, cells_around_block, all))
            .vertex_position(task.position));
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
  os << indent << "Isovalue: " << this->Isovalue << '\n'
     << indent << "Degree: " << this->Degree << '\n'
     << indent << "Scheme: " << this->Scheme << '\n'
     << indent << "Smoothing: " << this->Smoothing << '\n'
     << indent << "Attributes: " << (this->Attributes ? this->Attributes : "(none)") << '\n'
     << indent << "FlipNormals: " << this->FlipNormals << '\n'
     << indent << "ProjectVertices: " << this->ProjectVertices << '\n'
     << indent << "ArrayComponent: " << this->ArrayComponent << '\n'
     << indent << "Controller: " << this->Controller << '\n';
}

int vtkEquiaffineSurface::FillInputPortInformation(int, vtkInformation* info) {
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSet");
  return 1;
}

int vtkEquiaffineSurface::GetNumberOfGhostLevels() {
  try {
    return needed_ghost_levels(this->GetSpline());
  } catch (const std::exception& error) {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

equiaffine::Spline_parameters vtkEquiaffineSurface::GetSpline() const {
  constexpr std::array schemes = {Spline_scheme::QUASI_INTERPOLATION, Spline_scheme::CONVOLUTION,
                                  Spline_scheme::INTERPOLATION};
  return {.degree = this->Degree, .scheme = schemes[std::size_t(this->Scheme)], .smoothing = this->Smoothing};
}

// A piece of an image is asked for with its ghost levels where every process has its piece, else the whole image.
int vtkEquiaffineSurface::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
                                              vtkInformationVector* outputs) {
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* const input = inputs[0]->GetInformationObject(0);
  vtkInformation* const output = outputs->GetInformationObject(0);
  const int ghosts = output->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS());
  if (output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) == Ranks(this->Controller).count()) {
    const bool is_degree = this->Degree == 5 || this->Degree == 7 || this->Degree == 9; // else RequestData() says so
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), ghosts + (is_degree ? this->GetNumberOfGhostLevels() : 0));
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
    Task task = {{.piece = info->Get(Pipeline::UPDATE_PIECE_NUMBER()),
                  .pieces = std::max(1, info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES())),
                  .ghost_levels = info->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()),
                  .spline = this->GetSpline()},
                 this->Isovalue,
                 this->FlipNormals ? Orientation_of_level_set::AGAINST_GRADIENT
                                   : Orientation_of_level_set::ALONG_GRADIENT,
                 this->ProjectVertices ? Vertex_position::PROJECTED : Vertex_position::LINEAR,
                 {}};
    vtkInformation* const input = inputs[0]->GetInformationObject(0);
    vtkDataObject* const data = input->Get(vtkDataObject::DATA_OBJECT());
    std::vector<vtkSmartPointer<vtkImageData>> images;
    std::array<int, 6> whole_extent = {0, -1, 0, -1, 0, -1};
    together(ranks, [&] {
      require(std::isfinite(this->Isovalue), "the isovalue is not finite; choose a number");
      task.selection = select_attributes(this->Attributes ? this->Attributes : "none");
      static_cast<void>(needed_ghost_levels(task.request.spline)); // checks the degree
      require(task.request.spline.scheme != Spline_scheme::INTERPOLATION || ranks.count() == 1,
              "spline interpolation needs the whole image in one process; choose quasi-interpolation");
      images = images_of(data);
      if (vtkImageData::SafeDownCast(data) && input->Has(Pipeline::WHOLE_EXTENT()))
        input->Get(Pipeline::WHOLE_EXTENT(), whole_extent.data());
    });
    const Image_pieces pieces = image_pieces(images, whole_extent, task.request, ranks, this->Controller);
    if (!pieces.lattice) return 1;
    if (pieces.pieces.size() > 1) task.request.ghost_levels = 0;
    std::vector<Volume_view_3<equiaffine::Kernel>> views;
    std::vector<Cell_block> own;
    together(ranks, [&] {
      const std::vector<vtkDataArray*> arrays =
          arrays_of(pieces, this->ArrayComponent, [this](vtkImageData* image, int& association) {
            const char* const name = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
            if (name && *name == '\0') return image->GetPointData()->GetScalars(); // as a script that names none
            return this->GetInputArrayToProcess(0, image, association);
          });
      for (std::size_t n = 0; n < arrays.size(); ++n) {
        views.push_back(view_of(pieces, pieces.pieces[n], arrays[n], this->ArrayComponent));
        own.push_back(pieces.pieces[n].cells);
      }
    });
    const std::vector<Traits> functions = functions_of(views, pieces, task, ranks);
    Surface_arrays surface(task.selection, own, pieces.lattice->size(), task.request.pieces > 1 || ranks.count() > 1,
                           task.request.ghost_levels > 0);
    bool is_aborted = false;
    together(ranks, [&] {
      const auto stop_if_wanted = [&] {
        if (this->IsAborted()) throw Aborted();
      };
      const Progress_observer observer([&](const Progress_observer::Stage&) { stop_if_wanted(); });
      try {
        mesh_pieces(functions, pieces, task, surface, [&](double part) {
          this->UpdateProgress(part);
          stop_if_wanted();
        });
      } catch (const Aborted&) {
        is_aborted = true;
      }
    });
    std::array<std::int64_t, 1> aborted = {is_aborted};
    ranks.sum(aborted);
    if (aborted[0] > 0) return 1;
    if (surface.add_statistics(ranks, *output->GetFieldData()) == 0) check_that_there_are_numbers(views, ranks);
    together(ranks, [&] { surface.move_to(*output); });
  } catch (const Failure& error) {
    output->Initialize();
    vtkErrorMacro(<< error.what());
  }
  return 1; // after an error, too: 0 would make the pipeline print more than the sentence
}

bool vtkEquiaffineSurface::IsAborted() {
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  return this->CheckAbort();
#else
  return this->GetAbortExecute() != 0;
#endif
}
