#include "pipelines/write/exports/vtk_arrows.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdint>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/open_directory.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/write/exports/markup.h"

namespace pipelines {

void write_arrows_vtp(const std::filesystem::path& path, const std::string& field,
                      const std::vector<PlacedVector>& vectors,
                      const std::vector<std::vector<std::array<double, 3>>>& lines) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName(escaped(field).c_str());  // VTK writes attributes as they are
  values->SetNumberOfComponents(3);
  vtkNew<vtkTypeInt32Array> numbers;
  numbers->SetName("number");
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  vtkNew<vtkCellArray> vertices, polylines;
  const auto add = [&](const std::array<double, 3>& at_m, const std::array<double, 3>& value,
                       std::size_t number) {
    values->InsertNextTuple(value.data());
    numbers->InsertNextValue(std::int32_t(number));
    return points->InsertNextPoint(at_m.data());
  };
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    names->InsertNextValue(vectors[i].name);
    vertices->InsertNextCell(1);
    vertices->InsertCellPoint(add(vectors[i].at_m, vectors[i].value, i + 1));
  }
  for (const auto& line : lines) {
    polylines->InsertNextCell(vtkIdType(line.size()));
    for (const auto& at_m : line) polylines->InsertCellPoint(add(at_m, {}, 0));
  }
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->SetLines(polylines);
  data->GetPointData()->AddArray(values);
  data->GetPointData()->AddArray(numbers);
  data->GetFieldData()->AddArray(names);
  AtomicFile file(path);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(file.temporary().c_str());
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  if (!writer->Write() || writer->GetErrorCode() != 0)
    throw FileError(shown(path) + ": cannot be written; check the directory and the free space");
  file.commit("</VTKFile>\n");
}

}  // namespace pipelines
