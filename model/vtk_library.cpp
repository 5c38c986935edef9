#include "model/vtk_data.hpp"

#include <algorithm>
#include <new>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace flowslide {
namespace {

vtkNew<vtkDoubleArray> array_for(double) { return {}; }
vtkNew<vtkTypeInt32Array> array_for(std::int32_t) { return {}; }
vtkNew<vtkTypeInt64Array> array_for(std::int64_t) { return {}; }

void add(vtkFieldData* to, const std::vector<VtkArray>& arrays) {
  for (const VtkArray& a : arrays)
    std::visit(
        [&]<class T>(const std::vector<T>& values) {
          auto array = array_for(T{});
          array->SetName(a.name.c_str());
          array->SetNumberOfComponents(a.components);
          array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / a.components);
          std::copy(values.begin(), values.end(), array->GetPointer(0));
          for (int c = 0; c < a.components; ++c)
            if (const char* name = vtk_component_name(a.components, c))
              array->SetComponentName(c, name);
          to->AddArray(array);
        },
        a.values);
}

void fill(vtkPointSet* to, const VtkData& data) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(data.points.size() / 3));
  for (std::size_t i = 0; i < data.points.size() / 3; ++i)
    points->SetPoint(static_cast<vtkIdType>(i), &data.points[3 * i]);
  to->SetPoints(points);
  add(to->GetPointData(), data.at_points);
  add(to->GetCellData(), data.at_cells);
  for (const auto& [name, texts] : data.texts) {
    vtkNew<vtkStringArray> array;
    array->SetName(name.c_str());
    for (const std::string& text : texts) array->InsertNextValue(text);
    to->GetFieldData()->AddArray(array);
  }
}

vtkNew<vtkCellArray> cells(const VtkData& data, std::size_t each) {
  vtkNew<vtkCellArray> result;
  for (std::size_t i = 0; i + each <= data.cells.size(); i += each) {
    std::vector<vtkIdType> cell(data.cells.begin() + static_cast<std::ptrdiff_t>(i),
                                data.cells.begin() + static_cast<std::ptrdiff_t>(i + each));
    result->InsertNextCell(static_cast<vtkIdType>(each), cell.data());
  }
  return result;
}

/// Through memory: VTK does not look at the result of closing its files.
template <class Writer, class Data>
std::string written(Data* data) {
  // VTK would print its own account of a failure besides the exception's.
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<Writer> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0) throw std::bad_alloc();
  return writer->GetOutputString();
}

}  // namespace

std::string vtk_xml_of_library(const VtkData& data) {
  if (data.kind == VtkData::Kind::vertices) {
    vtkNew<vtkPolyData> particles;
    fill(particles, data);
    particles->SetVerts(cells(data, 1));
    return written<vtkXMLPolyDataWriter>(particles.Get());
  }
  vtkNew<vtkUnstructuredGrid> mesh;
  fill(mesh, data);
  mesh->SetCells(VTK_QUAD, cells(data, 4));
  return written<vtkXMLUnstructuredGridWriter>(mesh.Get());
}

}  // namespace flowslide
