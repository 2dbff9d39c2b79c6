// Reading and writing STL files, good and bad.

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "lbm/geometry/stl.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

namespace fs = std::filesystem;

class StlFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("puffin-stl-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name = "a.stl") const { return (folder_ / name).string(); }
  std::string put(const std::string& bytes) const {
    std::ofstream(path(), std::ios::binary) << bytes;
    return path();
  }
  static std::string bytes_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // The message of reading these bytes; empty if they were read.
  std::string complaint(const std::string& bytes) const {
    put(bytes);
    try {
      read_stl(path());
    } catch (const StlError& e) {
      return e.what();
    }
    return "";
  }
  fs::path folder_;
};

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) {
    text.replace(at, what.size(), with);
  }
  return text;
}

const char* const one_facet =
    "solid part\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n "
    "endfacet\nendsolid part\n";

TEST_F(StlFiles, AsciiKeepsShapeAndNamedSolids) {
  const TriangleMesh box = shapes::box({0, 0, 0}, {0.002, 0.003, 0.004});
  write_stl(path(), box);
  const TriangleMesh back = read_stl(path());
  EXPECT_EQ(back.solids, box.solids);
  EXPECT_EQ(back.solid, box.solid);
  EXPECT_EQ(back.vertices.size(), 8u);
  EXPECT_EQ(back.triangles.size(), 12u);
  // Nine digits: relative 1e-9 a coordinate, three of them in a volume.
  EXPECT_NEAR(enclosed_volume(back), 24e-9, 24e-9 * 3e-9);
}

TEST_F(StlFiles, BinaryKeepsShapeAndTheNameOfASingleSolid) {
  const TriangleMesh torus = shapes::torus(0.02, 0.005, 24, 12);
  write_stl(path(), torus, true);
  EXPECT_EQ(fs::file_size(path()), 84 + 50 * torus.triangles.size());
  const TriangleMesh back = read_stl(path());
  EXPECT_EQ(back.solids, torus.solids);
  EXPECT_EQ(back.vertices.size(), torus.vertices.size());
  // Single precision: 6e-8 of the largest coordinate.
  for (std::size_t t = 0; t < torus.triangles.size(); ++t) {
    EXPECT_LT((back.corner(t, 0) - torus.corner(t, 0)).norm(), 0.025 * 6e-8 * 2);
  }
}

TEST_F(StlFiles, UnitScalesEveryCoordinateBothWays) {
  const TriangleMesh box = shapes::box({0, 0, 0}, {1.0, 2.0, 3.0});
  write_stl(path(), box);
  EXPECT_NEAR(enclosed_volume(read_stl(path(), 1e-3)), 6e-9, 6e-9 * 1e-9);
  write_stl(path(), read_stl(path(), 1e-3), false, 1e-3);
  EXPECT_NEAR(enclosed_volume(read_stl(path())), 6.0, 6.0 * 1e-8);
}

TEST_F(StlFiles, BinaryThatBeginsWithSolidIsReadAsBinary) {
  write_stl(path(), shapes::box({0, 0, 0}, {1, 1, 1}), true);
  std::string bytes = bytes_of(path());
  bytes.replace(0, 20, "solid exported by X ");
  put(bytes);
  EXPECT_EQ(read_stl(path()).triangles.size(), 12u);
  // Also if the header is text to its end.
  bytes.replace(0, 80, std::string("solid ") + std::string(74, 'x'));
  put(bytes);
  EXPECT_EQ(read_stl(path()).triangles.size(), 12u);
}

TEST_F(StlFiles, AsciiDialectsReadTheSame) {
  const std::string text = one_facet;
  for (const std::string& dialect :
       {text, replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r"), replaced(text, "endsolid part\n", ""),
        replaced(replaced(text, "facet normal 0 0 1", "FACET NORMAL nan -nan 1e999"), "vertex", "Vertex"),
        "\xEF\xBB\xBF" + text, "  \n\t" + text, replaced(text, " facet", "color 1 0 0\n facet"),
        replaced(text, "1 0 0", "+1.0e+0 -0 0E0"), replaced(text, "1 0 0", "1 1e-400 0"), replaced(text, "   ", "\t"),
        replaced(text, "\n", " ")}) {
    put(dialect);
    const TriangleMesh mesh = read_stl(path());
    ASSERT_EQ(mesh.triangles.size(), 1u) << dialect;
    EXPECT_EQ(mesh.solids, std::vector<std::string>{"part"}) << dialect;
    EXPECT_DOUBLE_EQ(mesh.area(0), 0.5) << dialect;
  }
}

TEST_F(StlFiles, AsciiWithoutLineBreaksKeepsItsSolids) {
  const std::string other = replaced(one_facet, " part", " the other part");
  put(replaced(std::string(one_facet) + other, "\n", " "));
  const TriangleMesh mesh = read_stl(path());
  EXPECT_EQ(mesh.solids, (std::vector<std::string>{"part", "the other part"}));
  EXPECT_EQ(mesh.solid, (std::vector<int>{0, 1}));
}

TEST_F(StlFiles, TextInUtf16IsRefusedByName) {
  std::string wide = "\xFF\xFE";
  for (const char c : std::string(one_facet)) wide += std::string{c, '\0'};
  put(wide);
  try {
    read_stl(path());
    FAIL();
  } catch (const StlError& e) {
    EXPECT_NE(std::string(e.what()).find("UTF-16"), std::string::npos) << e.what();
  }
}

TEST_F(StlFiles, SolidsOfOneNameBecomeOneAndNamelessOnesAreCalledSolid) {
  const std::string other = replaced(one_facet, " part", "");
  put(std::string(one_facet) + other + one_facet);
  const TriangleMesh mesh = read_stl(path());
  EXPECT_EQ(mesh.solids, (std::vector<std::string>{"part", "solid"}));
  EXPECT_EQ(mesh.solid, (std::vector<int>{0, 1, 0}));
}

TEST_F(StlFiles, CornersWithinTheToleranceAreWeldedAndOthersAreNot) {
  const std::string second = replaced(one_facet, "vertex 0 1 0", "vertex 0 -1 0");
  put(one_facet + replaced(second, "vertex 1 0 0", "vertex 1.0000001 0 0"));  // 1e-7 < 1e-7 sqrt(5)
  EXPECT_EQ(read_stl(path()).vertices.size(), 4u);
  put(one_facet + replaced(second, "vertex 1 0 0", "vertex 1.000001 0 0"));
  EXPECT_EQ(read_stl(path()).vertices.size(), 5u);
}

TEST_F(StlFiles, BadTextIsRefusedWithItsLine) {
  const std::string text = one_facet;
  const std::vector<std::array<std::string, 3>> zoo{
      {"cut in a vertex", text.substr(0, text.find("vertex 0 1") + 8), ":6: error: the file ends inside a facet"},
      {"cut after the loop", text.substr(0, text.find("endfacet")), "the file ends inside a facet"},
      {"comma", replaced(text, "vertex 1 0 0", "vertex 1,5 0 0"),
       ":5: error: '1,5' is no coordinate; write decimals with a point"},
      {"word", replaced(text, "vertex 1 0 0", "vertex one 0 0"), ":5: error: 'one' is no coordinate"},
      {"nan", replaced(text, "vertex 1 0 0", "vertex nan 0 0"), ":5: error: 'nan' is no coordinate"},
      {"overflow", replaced(text, "vertex 1 0 0", "vertex 1e999 0 0"), ":5: error: '1e999' is no coordinate"},
      {"two numbers", replaced(text, "vertex 1 0 0", "vertex 1 0"), ":6: error: 'vertex' is no coordinate"},
      {"four corners", replaced(text, "  endloop", "   vertex 5 5 5\n  endloop"), "more than three corners"},
      {"two corners", replaced(text, "   vertex 0 1 0\n", ""), ":6: error: 'endloop' where 'vertex' was expected"},
      {"no loop", replaced(text, "  outer loop\n", ""), "'vertex' where 'outer loop' was expected"},
      {"stray vertex", replaced(text, " facet normal 0 0 1\n", ""), "'outer' outside a facet"},
      {"no facets", "solid empty\nendsolid empty\n", "holds no triangles"},
  };
  for (const auto& [name, bytes, expected] : zoo) {
    EXPECT_NE(complaint(bytes).find(expected), std::string::npos) << name << ": " << complaint(bytes);
  }
}

TEST_F(StlFiles, BadBinaryIsRefusedWithItsTriangleAndInBoundedMemory) {
  write_stl(path(), shapes::box({0, 0, 0}, {1, 1, 1}), true);
  const std::string good = bytes_of(path());
  std::string huge = good;
  std::memset(huge.data() + 80, 0xFF, 4);  // promises 4294967295 triangles
  std::string few = good;
  few[80] = 3;
  std::string nan = good;
  const float not_a_number = std::nanf("");
  std::memcpy(nan.data() + 84 + 50 * 6 + 12, &not_a_number, 4);
  std::string far = good;
  const float far_away = 3e38F;
  std::memcpy(far.data() + 84 + 50 * 6 + 12, &far_away, 4);
  const std::vector<std::array<std::string, 3>> zoo{
      {"empty", "", "the file is empty"},
      {"short", good.substr(0, 50), "50 bytes are too few"},
      {"header only", good.substr(0, 84), "promises 12 triangles but the file ends in triangle 1"},
      {"cut", good.substr(0, 84 + 50 * 7 + 20), "promises 12 triangles but the file ends in triangle 8"},
      {"huge", huge, "promises 4294967295 triangles"},
      {"few", few, "promises 3 triangles but the file has room for 12"},
      {"nan", nan, "triangle 7 has a corner that is no finite number"},
      {"far", far, "triangle 7 has a corner"},
      {"far", far, "no device is that large"},
      {"cut, begins with solid", "solid " + good.substr(6, 300), "truncated"},
      {"a picture", "\x89PNG\r\n\x1a\n" + std::string(500, '\x7'), "no STL"},
      {"a text",
       "Dear Sir,\nplease find enclosed the device, in the enclosed envelope, with all the dimensions asked "
       "for.\n",
       "no STL"},
      {"a comment first", std::string("// exported from the CAD program by someone who likes comments\n") + one_facet,
       "text that does not begin with 'solid'"},
  };
  for (const auto& [name, bytes, expected] : zoo) {
    EXPECT_NE(complaint(bytes).find(expected), std::string::npos) << name << ": " << complaint(bytes);
  }
}

TEST_F(StlFiles, NoSuchFileAFolderAndABadUnitAreRefused) {
  auto message = [](const std::function<void()>& f) -> std::string {
    try {
      f();
    } catch (const StlError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message([&] { read_stl(path("missing.stl")); }).find("no such file"), std::string::npos);
  EXPECT_NE(message([&] { read_stl(folder_.string()); }).find("not a regular file"), std::string::npos);
  put(one_facet);
  EXPECT_NE(message([&] { read_stl(path(), 0.0); }).find("unit"), std::string::npos);
}

TEST_F(StlFiles, AFailedWriteLeavesTheOldFileAndNoOther) {
  EXPECT_THROW(write_stl(path("none/a.stl"), shapes::box({0, 0, 0}, {1, 1, 1})), StlError);
  write_stl(path(), shapes::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(StlFiles, DamagedBytesNeverCrashTheReader) {
  write_stl(path(), shapes::box({0, 0, 0}, {1, 1, 1}));
  const std::string text = bytes_of(path());
  write_stl(path(), shapes::box({0, 0, 0}, {1, 1, 1}), true);
  const std::string binary = bytes_of(path());
  std::uint32_t state = 12345;
  auto random = [&] { return state = state * 1664525u + 1013904223u, state >> 8; };
  for (int round = 0; round < 400; ++round) {
    std::string bytes = round % 2 ? text : binary;
    for (int k = 0; k < 1 + round % 5; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (round % 3 == 0) bytes.resize(random() % bytes.size());
    put(bytes);
    try {
      EXPECT_LE(read_stl(path()).triangles.size(), 12u);
    } catch (const StlError&) {
    }
  }
}

}  // namespace
}  // namespace puffin::lbm::geometry
