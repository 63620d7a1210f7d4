// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_WRITE_VTK_XML_H
#define EQUIAFFINE_PROGRAM_SYSTEM_WRITE_VTK_XML_H

#include <vtkNew.h>

#include <ostream>
#include <string>

namespace equiaffine {

/// Writes a VTK data set with one of VTK's XML writers, first into memory, since VTK crashes when the disk fills up.
/// Arrays are inline base64: readers with a recent expat lose appended arrays.
template <class Writer, class Data>
void write_vtk_xml(std::ostream& stream, Data& data) {
  vtkNew<Writer> writer;
  writer->SetWriteToOutputString(true);
  writer->SetDataModeToBinary();
  writer->SetInputData(&data);
  writer->Write();
  const std::string text = writer->GetOutputString();
  stream.write(text.data(), std::streamsize(text.size()));
}

} // namespace equiaffine

#endif
