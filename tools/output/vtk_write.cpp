// Frames to VTK's XML files, through VTK's own writers.

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>
#include <stdexcept>

#include "tools/output/format_version.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

void check_length(const std::string& name, std::size_t length, std::size_t wanted) {
  if (length != wanted) {
    throw std::invalid_argument("array '" + name + "' has " + std::to_string(length) + " values where " +
                                std::to_string(wanted) + " are needed");
  }
}

/// Copies n tuples into a new array of VTK under `name`; `value(i, c)` gives component c of tuple i.
template <class Array, class Value>
void add_array(vtkDataSetAttributes* attributes, const std::string& name, std::size_t n, int components,
               const Value& value) {
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (int c = 0; c < components; ++c) array->SetTypedComponent(static_cast<vtkIdType>(i), c, value(i, c));
  }
  attributes->AddArray(array);
}

/// zlib at its quickest level: half the time of the usual one for a tenth more bytes.
template <class Writer, class Data>
void write_xml(const std::filesystem::path& file, Data* data) {
  vtkNew<vtkIntArray> format;
  format->SetName("puffin_format");
  format->InsertNextValue(format_version);
  data->GetFieldData()->AddArray(format);
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);
  writer->WriteToOutputStringOn();
  if (!writer->Write()) throw OutputError("cannot write " + file.string() + ": VTK refused the data");
  replace_whole(file, writer->GetOutputString());
}

}  // namespace

void write_vti(const std::filesystem::path& file, const FieldFrame& frame) {
  const auto cells = static_cast<std::size_t>(frame.cells());
  check_length("fluid", frame.fluid.size(), cells);
  vtkNew<vtkImageData> image;
  image->SetDimensions(frame.size[0] + 1, frame.size[1] + 1, frame.size[2] + 1);
  image->SetSpacing(frame.dx, frame.dx, frame.dx);
  image->SetOrigin(frame.origin[0] - 0.5 * frame.dx, frame.origin[1] - 0.5 * frame.dx,
                   frame.origin[2] - 0.5 * frame.dx);
  vtkCellData* data = image->GetCellData();
  std::vector<std::uint8_t> hidden(cells);  // not fluid, or without a finite value
  for (std::size_t i = 0; i < cells; ++i) hidden[i] = frame.fluid[i] ? 0 : 1;
  const auto add = [&](const std::string& name, const std::vector<float>& values, int components) {
    if (values.empty()) return;
    check_length(name, values.size(), cells * components);
    add_array<vtkFloatArray>(data, name, cells, components, [&](std::size_t i, int c) {
      const float value = values[i * components + c];
      if (frame.fluid[i] && std::isfinite(value)) return value;
      hidden[i] = 1;
      return 0.0f;
    });
  };
  add("velocity", frame.velocity, 3);
  add("pressure", frame.pressure, 1);
  for (const auto& scalar : frame.fines) add("fines_" + scalar.name, scalar.values, 1);
  for (const auto& array : frame.more) add(array.name, array.values, 1);
  add_array<vtkUnsignedCharArray>(data, "fluid", cells, 1, [&](std::size_t i, int) { return frame.fluid[i]; });
  add_array<vtkUnsignedCharArray>(data, vtkDataSetAttributes::GhostArrayName(), cells, 1, [&](std::size_t i, int) {
    return static_cast<unsigned char>(hidden[i] ? vtkDataSetAttributes::HIDDENCELL : 0);
  });
  if (!frame.velocity.empty()) data->SetActiveVectors("velocity");
  write_xml<vtkXMLImageDataWriter>(file, image.Get());
}

void write_vtp(const std::filesystem::path& file, const CarrierFrame& frame) {
  const std::size_t n = frame.position.size();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> verts;
  for (std::size_t i = 0; i < n; ++i) {
    const vtkIdType point = points->InsertNextPoint(frame.position[i].data());
    verts->InsertNextCell(1, &point);
  }
  vtkNew<vtkPolyData> poly;
  poly->SetPoints(points);
  poly->SetVerts(verts);
  vtkPointData* data = poly->GetPointData();
  check_length("id", frame.id.size(), n);
  check_length("diameter", frame.diameter.size(), n);
  check_length("velocity", frame.velocity.size(), n);
  add_array<vtkIntArray>(data, "id", n, 1, [&](std::size_t i, int) { return frame.id[i]; });
  add_array<vtkFloatArray>(data, "diameter", n, 1, [&](std::size_t i, int) { return frame.diameter[i]; });
  add_array<vtkFloatArray>(data, "velocity", n, 3, [&](std::size_t i, int c) { return frame.velocity[i][c]; });
  const auto wanted = [n](const char* name, std::size_t length) {
    if (length > 0) check_length(name, length, n);
    return length > 0 || n == 0;
  };
  if (wanted("spin", frame.spin.size()))
    add_array<vtkFloatArray>(data, "spin", n, 3, [&](std::size_t i, int c) { return frame.spin[i][c]; });
  if (wanted("fines", frame.fines.size()))
    add_array<vtkFloatArray>(data, "fines", n, 1, [&](std::size_t i, int) { return frame.fines[i]; });
  if (wanted("asleep", frame.asleep.size()))
    add_array<vtkUnsignedCharArray>(data, "asleep", n, 1, [&](std::size_t i, int) { return frame.asleep[i]; });
  write_xml<vtkXMLPolyDataWriter>(file, poly.Get());
}

void write_vtp(const std::filesystem::path& file, const WallFrame& frame) {
  const std::size_t n = frame.triangles.size();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& vertex : frame.vertices) points->InsertNextPoint(vertex.data());
  vtkNew<vtkCellArray> polys;
  for (const auto& triangle : frame.triangles) {
    const vtkIdType corners[3] = {triangle[0], triangle[1], triangle[2]};
    for (const vtkIdType corner : corners) {
      if (corner < 0 || corner >= points->GetNumberOfPoints())
        throw std::invalid_argument("a triangle names vertex " + std::to_string(corner) + " of " +
                                    std::to_string(points->GetNumberOfPoints()));
    }
    polys->InsertNextCell(3, corners);
  }
  vtkNew<vtkPolyData> poly;
  poly->SetPoints(points);
  poly->SetPolys(polys);
  vtkCellData* data = poly->GetCellData();
  check_length("patch", frame.patch.size(), n);
  add_array<vtkIntArray>(data, "patch", n, 1, [&](std::size_t i, int) { return frame.patch[i]; });
  const auto add = [&](const std::string& name, const std::vector<double>& values) {
    if (values.empty()) return;
    check_length(name, values.size(), n);
    add_array<vtkDoubleArray>(data, name, n, 1, [&](std::size_t i, int) { return values[i]; });
  };
  add("fines", frame.fines);
  add("hits", frame.hits);
  add("energy", frame.energy);
  for (const auto& [scalar, map] : frame.further_fines) add("fines_" + scalar, map);
  vtkNew<vtkStringArray> names;
  names->SetName("patch_names");
  vtkNew<vtkUnsignedCharArray> openings;
  openings->SetName("patch_opening");
  for (const auto& patch : frame.patches) {
    names->InsertNextValue(patch.name);
    openings->InsertNextValue(patch.opening ? 1 : 0);
  }
  poly->GetFieldData()->AddArray(names);
  poly->GetFieldData()->AddArray(openings);
  write_xml<vtkXMLPolyDataWriter>(file, poly.Get());
}

}  // namespace puffin::output
