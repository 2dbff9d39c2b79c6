// Every kind of file carries the number of its format, and one of another format is refused, not misread.

#include <gtest/gtest.h>
#include <hdf5.h>

#include "tests/tools/output/scratch.hpp"
#include "tools/output/format_version.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/stats_file.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

template <class Read>
void expect_refused(const Read& read) {
  try {
    read();
    FAIL() << "read as if it were its own";
  } catch (const OutputError& e) {
    EXPECT_NE(std::string(e.what()).find("has format 2, this program reads format 1"), std::string::npos) << e.what();
  }
}

TEST(FormatVersion, OfJson) {
  const Scratch scratch;
  const auto file = scratch.path() / "summary.json";
  write_summary(file, {});
  std::string text = text_of(file);
  const std::string one = "\"format\": 1";
  ASSERT_NE(text.find(one), std::string::npos);
  EXPECT_NO_THROW(read_summary(file));
  write_whole(file, text.replace(text.find(one), one.size(), "\"format\": 2"));
  expect_refused([&] { read_summary(file); });
  expect_refused([&] { read_status(file); });
}

TEST(FormatVersion, OfHdf5) {
  const Scratch scratch;
  const auto path = scratch.path() / "stats.h5";
  { StatsFile(path, {{"time", "s"}}).flush(); }
  EXPECT_NO_THROW(read_stats(path, "time"));
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(file, "format_version", H5P_DEFAULT);
  const int two = 2;
  ASSERT_GE(H5Awrite(attribute, H5T_NATIVE_INT, &two), 0);
  H5Aclose(attribute);
  H5Fclose(file);
  expect_refused([&] { read_stats(path, "time"); });
}

TEST(FormatVersion, OfVtk) {
  const Scratch scratch;
  const auto with_format = [&](const std::string& number) {
    const auto file = scratch.path() / (number + ".vti");
    write_whole(file,
                "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 0 1 0 1\" Spacing=\"1 1 1\" Origin=\"0 0 0\">"
                "<FieldData><DataArray type=\"Int32\" Name=\"puffin_format\" NumberOfTuples=\"1\" format=\"ascii\">" +
                    number +
                    "</DataArray></FieldData><Piece Extent=\"0 1 0 1 0 1\"><CellData><DataArray type=\"UInt8\" "
                    "Name=\"fluid\" format=\"ascii\">1</DataArray></CellData></Piece></ImageData></VTKFile>");
    return file;
  };
  EXPECT_NO_THROW(read_field_frame(with_format("1")));
  expect_refused([&] { read_field_frame(with_format("2")); });
  FieldFrame frame;
  frame.dx = 1.0;
  frame.size = {1, 1, 1};
  frame.fluid = {1};
  write_vti(scratch.path() / "ours.vti", frame);
  EXPECT_NE(text_of(scratch.path() / "ours.vti").find("puffin_format"), std::string::npos);
}

}  // namespace
}  // namespace puffin::output
