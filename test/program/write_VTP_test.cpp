// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef EQUIAFFINE_WITH_VTK

#include "output/Part_writer.h"
#include "support/Scratch_file.h"

#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace write_VTP_test {

using equiaffine::Kernel;
using equiaffine::Point_status;
using Point_3 = Kernel::Point_3;

TEST(Program_write_VTP, vtk_reads_the_same_mesh_and_attributes) {
  const equiaffine::Indexed_triangle_mesh_3<Kernel> mesh = {
      {Point_3(0.1, -1. / 3, 0), Point_3(1e-300, 2. / 3, 1e22), Point_3(1, 0, 0.7)}, {{0, 1, 2}, {2, 1, 0}}};
  const std::string name = "k1 <&\">"; // is escaped in XML
  const equiaffine::Vertex_attributes attributes = {
      {{name, {0.1, std::numeric_limits<double>::quiet_NaN(), -1. / 3}}},
      {{Point_status::REGULAR, Point_status::SINGULAR, Point_status::UNCONVERGED}}};
  const equiaffine::test::Scratch_file file("mesh.vtp");
  const std::string path = file.write("");
  std::ofstream stream(path, std::ios::binary);
  equiaffine::Vtp_writer writer(stream, 3, 2, attributes);
  const auto write_one = [&](std::size_t v) {
    writer.write_vertices({&mesh.points[v], 1},
                          {{{name, {attributes.columns[0].values[v]}}}, {{attributes.status->at(v)}}});
  };
  write_one(0);
  write_one(1);
  write_one(2);
  writer.write_faces(mesh.triangles);
  stream.close();

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData& data = *reader->GetOutput();
  ASSERT_EQ(data.GetNumberOfPoints(), 3);
  ASSERT_EQ(data.GetNumberOfCells(), 2);
  vtkDataArray* const k1 = data.GetPointData()->GetArray(name.c_str());
  vtkDataArray* const status = data.GetPointData()->GetArray("status");
  ASSERT_TRUE(k1 && status);
  EXPECT_EQ(status->GetDataType(), VTK_UNSIGNED_CHAR);
  EXPECT_EQ(k1->GetDataType(), VTK_DOUBLE);
  for (vtkIdType v = 0; v < 3; ++v) {
    const double* const p = data.GetPoint(v);
    EXPECT_EQ(Point_3(p[0], p[1], p[2]), mesh.points[std::size_t(v)]);
    EXPECT_EQ(status->GetTuple1(v), double(attributes.status->at(std::size_t(v))));
  }
  EXPECT_EQ(k1->GetTuple1(0), 0.1);
  EXPECT_TRUE(std::isnan(k1->GetTuple1(1)));
  vtkNew<vtkIdList> corners;
  data.GetCellPoints(1, corners);
  EXPECT_EQ(corners->GetId(0), 2);
  EXPECT_EQ(corners->GetId(2), 0);
}

TEST(Program_write_VTP, closed_curves_end_with_their_first_point_and_open_ones_do_not) {
  const equiaffine::Parabolic_curves_3<Kernel> curves{
      {{{{0, 0, 0}, {1, 0, 0}, {0.1, 1, 0}}, true}, {{{0, 0, 1}, {1, 0, 1}}, false}}};
  std::ostringstream stream;
  equiaffine::write_VTP(stream, curves);

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(stream.str());
  reader->Update();
  vtkPolyData& data = *reader->GetOutput();
  ASSERT_EQ(data.GetNumberOfPoints(), 5);
  ASSERT_EQ(data.GetNumberOfLines(), 2);
  EXPECT_EQ(data.GetPoint(2)[0], 0.1);
  const std::vector<std::vector<vtkIdType>> expected = {{0, 1, 2, 0}, {3, 4}};
  for (vtkIdType line = 0; line < 2; ++line) {
    vtkNew<vtkIdList> points;
    data.GetCellPoints(line, points);
    const std::vector<vtkIdType> indices(points->begin(), points->end());
    EXPECT_EQ(indices, expected[std::size_t(line)]);
  }
}

} // namespace write_VTP_test

#endif
