// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/write_vtk_xml.h"
#include "volume/Shared_volume.h"
#include "volume/data_files.h"
#include "volume/volume_formats.h"

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace equiaffine {

namespace {

/// Whether a VTK object has reported an error event.
class Error_flag {
public:
  explicit Error_flag(vtkObject& object) {
    callback_->SetClientData(&is_raised_);
    callback_->SetCallback([](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
    object.AddObserver(vtkCommand::ErrorEvent, callback_);
    object.AddObserver(vtkCommand::WarningEvent, callback_);
  }
  Error_flag(const Error_flag&) = delete;
  Error_flag& operator=(const Error_flag&) = delete;

  bool is_raised() const { return is_raised_; }

private:
  bool is_raised_ = false;
  vtkNew<vtkCallbackCommand> callback_;
};

/// The data at the points, or those of cells if there are none.
vtkDataSetAttributes& data_of(const std::string& path, vtkImageData& image) {
  if (image.GetPointData()->GetNumberOfArrays() > 0) return *image.GetPointData();
  if (image.GetCellData()->GetNumberOfArrays() > 0) return *image.GetCellData();
  fail_to_read_volume(path, "it has no data at its points or cells", "write it with an array of numbers");
}

vtkDataArray& scalars_of(const std::string& path, vtkDataSetAttributes& data) {
  if (!data.GetScalars() && data.GetNumberOfArrays() > 1)
    fail_to_read_volume(path, "it has several arrays, none of them marked as scalars", "write it with one array");
  vtkDataArray* const array = data.GetScalars() ? data.GetScalars() : data.GetArray(0);
  if (!array) fail_to_read_volume_type(path);
  return *array;
}

std::size_t sample_type_of(const std::string& path, vtkDataArray& array) {
  const auto bytes = std::size_t(array.GetDataTypeSize());
  switch (array.GetDataType()) {
  case VTK_FLOAT:
  case VTK_DOUBLE: return floating_sample_type(bytes);
  case VTK_UNSIGNED_CHAR:
  case VTK_UNSIGNED_SHORT:
  case VTK_UNSIGNED_INT:
  case VTK_UNSIGNED_LONG:
  case VTK_UNSIGNED_LONG_LONG: return integer_sample_type(bytes, false);
  case VTK_CHAR: return integer_sample_type(bytes, std::is_signed_v<char>);
  case VTK_SIGNED_CHAR:
  case VTK_SHORT:
  case VTK_INT:
  case VTK_LONG:
  case VTK_LONG_LONG:
  case VTK_ID_TYPE: return integer_sample_type(bytes, true);
  default: fail_to_read_volume_type(path);
  }
}

/// The lattice of the points, or of the centers of cells.
Lattice_3<Kernel> lattice_of(const std::string& path, vtkImageData& image, bool has_cells = false) {
  Lattice_3<Kernel>::Size size;
  std::array<Kernel::Vector_3, 3> steps;
  const int* const extent = image.GetExtent();
  const vtkMatrix3x3* const m = image.GetDirectionMatrix();
  Kernel::Point_3 origin(image.GetOrigin()[0], image.GetOrigin()[1], image.GetOrigin()[2]);
  for (int axis = 0; axis < 3; ++axis) {
    size[std::size_t(axis)] = std::size_t(image.GetDimensions()[axis] - int(has_cells));
    const Kernel::Vector_3 direction(m->GetElement(0, axis), m->GetElement(1, axis), m->GetElement(2, axis));
    const Kernel::Vector_3 step = image.GetSpacing()[axis] * direction;
    steps[std::size_t(axis)] = step;
    origin = origin + (extent[2 * axis] + (has_cells ? 0.5 : 0)) * step;
  }
  return make_lattice(path, size, origin, steps);
}

/// Makes the volume refer to the samples in the file, if they have the layout of memory. Returns whether they do.
bool refer_to_samples(const std::string& path, vtkXMLImageDataReader& reader, Shared_volume& volume) {
  vtkNew<vtkImageData> image;
  {
    const Captured_standard_error standard_error;
    reader.UpdateInformation();
  }
  vtkInformation& information = *reader.GetOutputInformation(0);
  image->CopyInformationFromPipeline(&information);
  image->SetExtent(information.Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()));
  const Lattice_3<Kernel> lattice = lattice_of(path, *image);
  for (std::size_t type = 0; type < raw_types.size(); ++type)
    if (const auto data = find_raw_data(path, Volume_format::VTI, type, lattice.number_of_nodes())) {
      volume.refer_to(lattice, type, *data);
      return true;
    }
  return false;
}

template <class Array>
void set_scalars(vtkImageData& image, const std::vector<double>& values) {
  vtkNew<Array> array;
  array->SetName("f");
  array->SetNumberOfValues(vtkIdType(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  image.GetPointData()->SetScalars(array);
}

} // namespace

void read_vti_volume(const std::string& path, Samples_in where, const Volume_selection& selection,
                     Shared_volume& volume) {
  check_vti_header(path);
  chosen_time(path, selection, 1);
  vtkNew<vtkXMLImageDataReader> reader;
  const Error_flag errors(*reader);
  reader->SetFileName(path.c_str());
  if (where == Samples_in::FILE && selection.component.value_or(1) == 1 && refer_to_samples(path, *reader, volume))
    return;
  {
    const Captured_standard_error standard_error;
    reader->Update();
  }
  vtkImageData& image = *reader->GetOutput();
  if (errors.is_raised() || reader->GetErrorCode() != vtkErrorCode::NoError) fail_to_read_volume_data(path);
  vtkDataSetAttributes& data = data_of(path, image);
  const Lattice_3<Kernel> lattice = lattice_of(path, image, &data == image.GetCellData());
  vtkDataArray& array = scalars_of(path, data);
  if (std::size_t(array.GetNumberOfTuples()) != lattice.number_of_nodes()) fail_to_read_volume_data(path);
  const auto components = std::size_t(array.GetNumberOfComponents());
  const std::size_t type = sample_type_of(path, array);
  copy_samples(type, array.GetVoidPointer(0), chosen_component(path, selection, components), components,
               lattice.number_of_nodes(), volume.allocate(lattice, type));
}

void write_vti_volume(std::ostream& stream, const Volume_3<Kernel>& volume, bool as_float) {
  const Lattice_3<Kernel>& lattice = volume.lattice;
  vtkNew<vtkImageData> image;
  image->SetDimensions(int(lattice.size()[0]), int(lattice.size()[1]), int(lattice.size()[2]));
  image->SetOrigin(lattice.origin().x(), lattice.origin().y(), lattice.origin().z());
  vtkNew<vtkMatrix3x3> direction;
  std::array<double, 3> spacing;
  for (int axis = 0; axis < 3; ++axis) {
    const Kernel::Vector_3& step = lattice.steps()[std::size_t(axis)];
    const double length = std::hypot(step.x(), step.y(), step.z());
    for (int row = 0; row < 3; ++row) direction->SetElement(row, axis, step[row] / length);
    spacing[std::size_t(axis)] = length;
  }
  image->SetDirectionMatrix(direction);
  image->SetSpacing(spacing.data());
  if (as_float) set_scalars<vtkFloatArray>(*image, volume.values);
  else set_scalars<vtkDoubleArray>(*image, volume.values);

  write_vtk_xml<vtkXMLImageDataWriter>(stream, *image);
}

} // namespace equiaffine
