// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/Part_writer.h"
#include "system/write_vtk_xml.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstddef>

namespace equiaffine {

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
