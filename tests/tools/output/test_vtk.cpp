#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/tools/output/scratch.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

FieldFrame block(float shift) {
  FieldFrame f;
  f.origin = {1e-3, 2e-3, 3e-3};
  f.dx = 0.25e-3;
  f.size = {3, 2, 4};
  for (int i = 0; i < 24; ++i) {
    f.fluid.push_back(i % 5 != 0);
    f.pressure.push_back(10.0f * i + shift);
    for (int c = 0; c < 3; ++c) f.velocity.push_back(i + 0.1f * c + shift);
  }
  f.fines = {{"L-Base", f.pressure}};
  return f;
}

CarrierFrame some_carriers() {
  CarrierFrame f;
  f.position = {{1e-3, 2e-3, 3e-3}, {4e-3, 5e-3, 6e-3}};
  f.id = {7, 3};
  f.diameter = {7e-5f, 8e-5f};
  f.velocity = {{1, 2, 3}, {4, 5, 6}};
  f.spin = {{10, 20, 30}, {40, 50, 60}};
  f.fines = {2000, 1500};
  f.asleep = {0, 1};
  return f;
}

WallFrame two_triangles() {
  WallFrame f;
  f.vertices = {{0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}, {1e-3, 1e-3, 0}};
  f.triangles = {{0, 1, 2}, {1, 3, 2}};
  f.patch = {0, 1};
  f.patches = {{"wall", false}, {"outlet", true}};
  f.fines = {1e9 / 3.0, 0};
  f.further_fines = {{"slow", {1e8 / 7.0, 0}}};
  f.hits = {12, 0};
  f.energy = {1e-9 / 3.0, 0};
  return f;
}

TEST(VtkFields, ReadBackWithTheirPlaceAndValues) {
  const Scratch folder;
  const FieldFrame frame = block(0.5f);
  write_vti(folder / "a.vti", frame);
  const FieldFrame back = read_field_frame(folder / "a.vti");
  EXPECT_EQ(back.size, frame.size);
  // dx is written as text of a double; the origin is shifted by half a cell and back: one rounding of 1e-3 each way.
  EXPECT_EQ(back.dx, frame.dx);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.origin[c], frame.origin[c], 1e-18);
  EXPECT_EQ(back.fluid, frame.fluid);
  ASSERT_EQ(back.fines.size(), 1u);
  EXPECT_EQ(back.fines[0].name, "L-Base");
  for (int i = 0; i < 24; ++i) {
    EXPECT_EQ(back.pressure[i], frame.fluid[i] ? frame.pressure[i] : 0.0f) << i;
    EXPECT_EQ(back.fines[0].values[i], back.pressure[i]) << i;
    EXPECT_EQ(back.velocity[3 * i + 2], frame.fluid[i] ? frame.velocity[3 * i + 2] : 0.0f) << i;
  }
}

TEST(VtkFields, NoFileHoldsANumberThatIsNone) {
  const Scratch folder;
  FieldFrame frame = block(0.0f);
  frame.velocity[3 * 7] = std::numeric_limits<float>::quiet_NaN();  // a fluid cell of a diverged run
  frame.pressure[0] = std::numeric_limits<float>::infinity();       // a cell that is not fluid
  write_vti(folder / "a.vti", frame);
  const FieldFrame back = read_field_frame(folder / "a.vti");
  for (const float value : back.velocity) EXPECT_TRUE(std::isfinite(value));
  for (const float value : back.pressure) EXPECT_TRUE(std::isfinite(value));
}

TEST(VtkFields, CellsThatAreNotFluidAreBlanked) {
  const Scratch folder;
  write_vti(folder / "a.vti", block(0.0f));
  EXPECT_NE(text_of(folder / "a.vti").find("vtkGhostType"), std::string::npos);
  EXPECT_NE(text_of(folder / "a.vti").find("vtkZLibDataCompressor"), std::string::npos);
}

TEST(Vtk, ArraysHaveTheNamesOfTheInterface) {
  const Scratch folder;
  write_vti(folder / "a.vti", block(0.0f));
  write_vtp(folder / "c.vtp", some_carriers());
  write_vtp(folder / "w.vtp", two_triangles());
  const auto names = [&](const char* file, const std::vector<std::string>& wanted) {
    const std::string text = text_of(folder / file);
    for (const auto& name : wanted) {
      EXPECT_NE(text.find("Name=\"" + name + "\""), std::string::npos) << file << ' ' << name;
    }
  };
  names("a.vti", {"velocity", "pressure", "fines_L-Base"});
  names("c.vtp", {"id", "diameter", "velocity", "spin", "fines", "asleep"});
  names("w.vtp", {"fines", "hits", "energy", "patch"});
}

TEST(VtkFields, ArraysOfTheWrongLengthAreRefused) {
  const Scratch folder;
  FieldFrame frame = block(0.0f);
  frame.pressure.pop_back();
  EXPECT_THROW(write_vti(folder / "a.vti", frame), std::invalid_argument);
}

TEST(VtkCarriers, ReadBack) {
  const Scratch folder;
  const CarrierFrame frame = some_carriers();
  write_vtp(folder / "a.vtp", frame);
  const CarrierFrame back = read_carrier_frame(folder / "a.vtp");
  EXPECT_EQ(back.position, frame.position);
  EXPECT_EQ(back.id, frame.id);
  EXPECT_EQ(back.diameter, frame.diameter);
  EXPECT_EQ(back.velocity, frame.velocity);
  EXPECT_EQ(back.spin, frame.spin);
  EXPECT_EQ(back.fines, frame.fines);
  EXPECT_EQ(back.asleep, frame.asleep);
}

TEST(VtkCarriers, AnEmptyDeviceIsAFrameToo) {
  const Scratch folder;
  write_vtp(folder / "a.vtp", CarrierFrame{});
  EXPECT_TRUE(read_carrier_frame(folder / "a.vtp").position.empty());
}

TEST(VtkWalls, ReadBackWithTheNamesOfThePatches) {
  const Scratch folder;
  const WallFrame frame = two_triangles();
  write_vtp(folder / "a.vtp", frame);
  const WallFrame back = read_wall_frame(folder / "a.vtp");
  EXPECT_EQ(back.vertices, frame.vertices);
  EXPECT_EQ(back.triangles, frame.triangles);
  EXPECT_EQ(back.patch, frame.patch);
  EXPECT_EQ(back.fines, frame.fines);
  EXPECT_EQ(back.hits, frame.hits);
  EXPECT_EQ(back.energy, frame.energy);
  EXPECT_EQ(back.further_fines, frame.further_fines);
  ASSERT_EQ(back.patches.size(), 2u);
  EXPECT_EQ(back.patches[1].name, "outlet");
  EXPECT_TRUE(back.patches[1].opening && !back.patches[0].opening);
}

/// The file with one word of its text replaced.
void alter(const std::filesystem::path& file, const std::string& what, const std::string& with) {
  std::string text = text_of(file);
  ASSERT_NE(text.find(what), std::string::npos) << what;
  text.replace(text.find(what), what.size(), with);
  std::ofstream(file, std::ios::binary) << text;
}

// VTK's readers take any corner and any number of components; whoever paints the frame takes them for sound.
TEST(VtkWalls, ACornerThatIsNotThereIsDamage) {
  const Scratch folder;
  std::ofstream(folder / "walls.vtp")
      << R"(<VTKFile type="PolyData" version="1.0"><PolyData><Piece NumberOfPoints="3" NumberOfPolys="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<CellData><DataArray type="Int32" Name="patch" format="ascii">0</DataArray></CellData>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray></Polys>
</Piece><FieldData><Array type="String" Name="patch_names" NumberOfTuples="1" format="ascii">119 0</Array></FieldData>
</PolyData></VTKFile>)";
  EXPECT_EQ(read_wall_frame(folder / "walls.vtp").triangles.size(), 1U) << "sound before it is altered";
  for (const char* corners : {"0 1 3", "0 1 1000000000", "-1 1 2"}) {
    alter(folder / "walls.vtp", "0 1 2", corners);
    EXPECT_THROW(read_wall_frame(folder / "walls.vtp"), OutputError) << corners;
    alter(folder / "walls.vtp", corners, "0 1 2");
  }
}

TEST(VtkFields, AVelocityOfOneComponentIsDamage) {
  const Scratch folder;
  std::ofstream(folder / "a.vti")
      << R"(<VTKFile type="ImageData" version="1.0"><ImageData WholeExtent="0 2 0 1 0 1" Origin="0 0 0" Spacing="1 1 1">
<Piece Extent="0 2 0 1 0 1"><CellData><DataArray type="UInt8" Name="fluid" format="ascii">1 1</DataArray>
<DataArray type="Float32" Name="velocity" NumberOfComponents="3" format="ascii">1 2 3 4 5 6</DataArray>
</CellData></Piece></ImageData></VTKFile>)";
  EXPECT_EQ(read_field_frame(folder / "a.vti").velocity.size(), 6U) << "sound before it is altered";
  alter(folder / "a.vti", "NumberOfComponents=\"3\" format=\"ascii\">1 2 3 4 5 6", "format=\"ascii\">1 2");
  EXPECT_THROW(read_field_frame(folder / "a.vti"), OutputError);
}

TEST(VtkSeries, EveryFrameIsListedWithItsExactTime) {
  const Scratch folder;
  VtkSeries series(folder / "vtk", "fields");
  for (const double time : {0.0, 0.1, 1.0 / 3.0}) {
    series.append(time, block(static_cast<float>(time)));
    series.append(time, block(-1.0f), 1);  // a second region
  }
  const std::vector<SeriesEntry> entries = read_pvd(folder / "vtk" / "fields.pvd");
  ASSERT_EQ(entries.size(), 6u);
  EXPECT_EQ(entries[4].time, 1.0 / 3.0);
  EXPECT_EQ(entries[5].part, 1);
  EXPECT_EQ(entries[4].file, "fields_000002.vti");
  EXPECT_EQ(read_field_frame(folder / "vtk" / entries[2].file).pressure[1], 10.1f);
}

TEST(VtkSeries, TheSameMomentTwiceKeepsTheLastOne) {
  const Scratch folder;
  VtkSeries series(folder.path(), "fields");
  series.append(0.1, block(1.0f));
  series.append(0.1, block(2.0f));
  ASSERT_EQ(series.entries().size(), 1u);
  EXPECT_EQ(read_field_frame(folder / series.entries()[0].file).pressure[1], 12.0f);
}

TEST(VtkSeries, ResumingContinuesAfterTheGivenFrames) {
  const Scratch folder;
  {
    VtkSeries series(folder.path(), "carriers");
    for (const double time : {0.0, 0.1, 0.2, 0.3}) series.append(time, some_carriers());
  }
  VtkSeries series(folder.path(), "carriers", 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "carriers_000003.vtp"));
  series.append(0.16, CarrierFrame{});
  const std::vector<SeriesEntry> entries = read_pvd(folder / "carriers.pvd");
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[2].file, "carriers_000002.vtp");
  EXPECT_TRUE(read_carrier_frame(folder / entries[2].file).position.empty());
  EXPECT_THROW(VtkSeries(folder.path(), "carriers", 4), OutputError);
}

// Frames reach the disk at sync(); one that somebody has taken away by then is nobody's loss.
TEST(VtkSeries, AFrameTakenAwayBeforeItIsSyncedIsNoError) {
  const Scratch folder;
  VtkSeries series(folder.path(), "carriers");
  for (const double time : {0.0, 0.1}) series.append(time, some_carriers());
  std::filesystem::remove(folder / "carriers_000000.vtp");
  EXPECT_NO_THROW(series.sync());
  EXPECT_EQ(read_pvd(folder / "carriers.pvd").size(), 2u);
  EXPECT_EQ(read_carrier_frame(folder / "carriers_000001.vtp").position.size(), some_carriers().position.size());
}

TEST(VtkSeries, AFullDiskLeavesTheSeriesAsItWas) {
  const Scratch folder;
  VtkSeries series(folder.path(), "fields");
  series.append(0.0, block(0.0f));
  {
    const FullDisk full(200);
    EXPECT_THROW(series.append(0.1, block(1.0f)), OutputError);
  }
  ASSERT_EQ(read_pvd(folder / "fields.pvd").size(), 1u);
  EXPECT_EQ(read_field_frame(folder / "fields_000000.vti").pressure[1], 10.0f);
}

TEST(Vtk, AMissingOrDamagedFileIsAnOutputError) {
  const Scratch folder;
  EXPECT_THROW(read_field_frame(folder / "none.vti"), OutputError);
  std::ofstream(folder / "bad.vti") << "<VTKFile type=\"ImageData\"><half";
  testing::internal::CaptureStderr();
  EXPECT_THROW(read_field_frame(folder / "bad.vti"), OutputError);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  write_vti(folder / "cut.vti", block(0.0f));
  std::filesystem::resize_file(folder / "cut.vti", std::filesystem::file_size(folder / "cut.vti") - 100);
  EXPECT_THROW(read_field_frame(folder / "cut.vti"), OutputError);
  EXPECT_THROW(read_pvd(folder / "none.pvd"), OutputError);
  EXPECT_THROW(write_vtp("/proc/a.vtp", some_carriers()), OutputError);
}

}  // namespace
}  // namespace puffin::output
