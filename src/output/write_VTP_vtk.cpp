// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/write_VTP.h"
#include "system/write_vtk_xml.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstddef>
#include <string>

namespace equiaffine {

namespace {

template <class Array, class Values>
void add_array(vtkPolyData& data, const std::string& name, const Values& values) {
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfValues(vtkIdType(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    array->SetValue(vtkIdType(i), static_cast<typename Array::ValueType>(values[i]));
  data.GetPointData()->AddArray(array);
}

} // namespace

void write_VTP(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Kernel::Point_3& p : mesh.points) points->InsertNextPoint(p.x(), p.y(), p.z());
  data->SetPoints(points);
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : mesh.triangles) triangles->InsertNextCell({vtkIdType(a), vtkIdType(b), vtkIdType(c)});
  data->SetPolys(triangles);
  for (const auto& column : attributes.columns) add_array<vtkDoubleArray>(*data, column.name, column.values);
  if (attributes.status) add_array<vtkUnsignedCharArray>(*data, "status", *attributes.status);

  write_vtk_xml<vtkXMLPolyDataWriter>(stream, *data);
}

void write_VTP(std::ostream& stream, const Parabolic_curves_3<Kernel>& curves) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  for (const auto& line : curves.polylines) {
    const vtkIdType first = points->GetNumberOfPoints();
    lines->InsertNextCell(int(line.points.size() + (line.is_closed ? 1 : 0)));
    for (const Kernel::Point_3& p : line.points) lines->InsertCellPoint(points->InsertNextPoint(p.x(), p.y(), p.z()));
    if (line.is_closed) lines->InsertCellPoint(first);
  }
  data->SetPoints(points);
  data->SetLines(lines);

  write_vtk_xml<vtkXMLPolyDataWriter>(stream, *data);
}

} // namespace equiaffine
