// VTK's XML files back to frames, through VTK's own readers.

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkStringOutputWindow.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include "tools/output/format_version.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

/// Within its scope VTK collects its complaints instead of printing them.
class VtkQuiet {
 public:
  VtkQuiet() : window_(vtkOutputWindow::GetInstance()), verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::SetInstance(collected_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~VtkQuiet() {
    vtkOutputWindow::SetInstance(window_);
    vtkLogger::SetStderrVerbosity(verbosity_);
  }
  VtkQuiet(const VtkQuiet&) = delete;
  VtkQuiet& operator=(const VtkQuiet&) = delete;
  bool complained() { return !collected_->GetOutput().empty(); }

 private:
  vtkNew<vtkStringOutputWindow> collected_;
  vtkSmartPointer<vtkOutputWindow> window_;
  vtkLogger::Verbosity verbosity_;
};

/// Reads one file; VTK's own complaints become an OutputError.
template <class Reader>
vtkSmartPointer<Reader> read_xml(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw OutputError("cannot read " + file.string() + ": there is no such file");
  demand_regular(file);
  VtkQuiet quiet;
  auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(file.c_str());
  const bool readable = reader->CanReadFile(file.c_str());
  if (readable) reader->Update();
  if (!readable || quiet.complained()) throw OutputError(file.string() + " is damaged or is no VTK file");
  if (vtkDataArray* format = reader->GetOutput()->GetFieldData()->GetArray("puffin_format"))
    check_format_version(file.string(), static_cast<int>(format->GetTuple1(0)));
  return reader;
}

/// The values of one array, tuple by tuple; empty if there is no such array.
template <class T>
std::vector<T> values_of(vtkFieldData* data, const std::string& name) {
  vtkDataArray* array = data->GetArray(name.c_str());
  std::vector<T> out;
  if (!array) return out;
  out.reserve(static_cast<std::size_t>(array->GetNumberOfValues()));
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c) out.push_back(static_cast<T>(array->GetComponent(i, c)));
  }
  return out;
}

std::vector<std::array<float, 3>> vectors_of(vtkFieldData* data, const std::string& name) {
  const std::vector<float> flat = values_of<float>(data, name);
  std::vector<std::array<float, 3>> out;
  for (std::size_t i = 0; i + 2 < flat.size(); i += 3) out.push_back({flat[i], flat[i + 1], flat[i + 2]});
  return out;
}

/// An array may be absent; one that is there has a value for each cell, carrier or triangle.
void demand_length(const std::filesystem::path& file, const std::string& name, std::size_t length, std::size_t wanted) {
  if (length != 0 && length != wanted)
    throw OutputError(file.string() + " is damaged: its array '" + name + "' has " + std::to_string(length) +
                      " values, not " + std::to_string(wanted));
}

std::vector<std::array<double, 3>> points_of(vtkPolyData* poly) {
  std::vector<std::array<double, 3>> out(static_cast<std::size_t>(poly->GetNumberOfPoints()));
  for (std::size_t i = 0; i < out.size(); ++i) poly->GetPoint(static_cast<vtkIdType>(i), out[i].data());
  return out;
}

}  // namespace

FieldFrame read_field_frame(const std::filesystem::path& file) {
  const auto reader = read_xml<vtkXMLImageDataReader>(file);
  vtkImageData* image = reader->GetOutput();
  vtkCellData* data = image->GetCellData();
  FieldFrame frame;
  frame.dx = image->GetSpacing()[0];
  for (int c = 0; c < 3; ++c) {
    frame.size[c] = image->GetDimensions()[c] - 1;
    frame.origin[c] = image->GetOrigin()[c] + 0.5 * frame.dx;
  }
  frame.fluid = values_of<std::uint8_t>(data, "fluid");
  const auto cells = static_cast<std::size_t>(frame.cells());
  if (frame.fluid.size() != cells) throw OutputError(file.string() + " has no cell array 'fluid'");
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    const char* given = data->GetArrayName(i);
    const std::string name = given ? given : "";
    if (name == "velocity") {
      frame.velocity = values_of<float>(data, name);
      demand_length(file, name, frame.velocity.size(), 3 * cells);
    } else if (name == "pressure") {
      frame.pressure = values_of<float>(data, name);
      demand_length(file, name, frame.pressure.size(), cells);
    } else if (name.rfind("fines_", 0) == 0) {
      frame.fines.push_back({name.substr(6), values_of<float>(data, name)});
      demand_length(file, name, frame.fines.back().values.size(), cells);
    } else if (name != "fluid" && name != vtkDataSetAttributes::GhostArrayName()) {
      frame.more.push_back({name, values_of<float>(data, name)});
    }
  }
  return frame;
}

CarrierFrame read_carrier_frame(const std::filesystem::path& file) {
  const auto reader = read_xml<vtkXMLPolyDataReader>(file);
  vtkPolyData* poly = reader->GetOutput();
  vtkPointData* data = poly->GetPointData();
  CarrierFrame frame;
  frame.position = points_of(poly);
  frame.id = values_of<std::int32_t>(data, "id");
  frame.diameter = values_of<float>(data, "diameter");
  frame.velocity = vectors_of(data, "velocity");
  frame.spin = vectors_of(data, "spin");
  frame.fines = values_of<float>(data, "fines");
  frame.asleep = values_of<std::uint8_t>(data, "asleep");
  if (frame.diameter.size() != frame.position.size() || frame.velocity.size() != frame.position.size())
    throw OutputError(file.string() + " lacks the arrays of carriers");
  const std::size_t count = frame.position.size();
  demand_length(file, "id", frame.id.size(), count);
  demand_length(file, "spin", frame.spin.size(), count);
  demand_length(file, "fines", frame.fines.size(), count);
  demand_length(file, "asleep", frame.asleep.size(), count);
  return frame;
}

WallFrame read_wall_frame(const std::filesystem::path& file) {
  const auto reader = read_xml<vtkXMLPolyDataReader>(file);
  vtkPolyData* poly = reader->GetOutput();
  vtkCellData* data = poly->GetCellData();
  WallFrame frame;
  frame.vertices = points_of(poly);
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < poly->GetNumberOfCells(); ++i) {
    poly->GetCellPoints(i, corners);
    if (corners->GetNumberOfIds() != 3) throw OutputError(file.string() + " holds cells that are no triangles");
    std::array<int, 3> triangle{};
    for (int c = 0; c < 3; ++c) {
      const vtkIdType corner = corners->GetId(c);  // VTK reads any number
      if (corner < 0 || corner >= poly->GetNumberOfPoints())
        throw OutputError(file.string() + " is damaged: a triangle has a corner that is not there");
      triangle[c] = static_cast<int>(corner);
    }
    frame.triangles.push_back(triangle);
  }
  frame.patch = values_of<std::int32_t>(data, "patch");
  if (frame.patch.size() != frame.triangles.size()) throw OutputError(file.string() + " has no cell array 'patch'");
  frame.fines = values_of<double>(data, "fines");
  frame.hits = values_of<double>(data, "hits");
  frame.energy = values_of<double>(data, "energy");
  demand_length(file, "fines", frame.fines.size(), frame.triangles.size());
  demand_length(file, "hits", frame.hits.size(), frame.triangles.size());
  demand_length(file, "energy", frame.energy.size(), frame.triangles.size());
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    const std::string name = data->GetArrayName(i) ? data->GetArrayName(i) : "";
    if (name.rfind("fines_", 0) != 0) continue;
    frame.further_fines.emplace_back(name.substr(6), values_of<double>(data, name));
    demand_length(file, name, frame.further_fines.back().second.size(), frame.triangles.size());
  }
  auto* names = vtkStringArray::SafeDownCast(poly->GetFieldData()->GetAbstractArray("patch_names"));
  const std::vector<int> openings = values_of<int>(poly->GetFieldData(), "patch_opening");
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i) {
    const bool opening = static_cast<std::size_t>(i) < openings.size() && openings[static_cast<std::size_t>(i)] != 0;
    frame.patches.push_back({names->GetValue(i), opening});
  }
  for (const auto patch : frame.patch) {
    if (patch < 0 || static_cast<std::size_t>(patch) >= frame.patches.size())
      throw OutputError(file.string() + " names a patch that it does not list");
  }
  return frame;
}

}  // namespace puffin::output
