// The program as a user and a script see it: output, exit codes, one JSON object.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

struct Outcome {
  int code = -1;
  std::string out;
};

/// Runs the program in a folder of its own; stdout alone is caught.
Outcome puffin(const std::string& arguments) {
  const std::string command = std::string(PUFFIN_BINARY_DIR) + "/puffin " + arguments + " 2>/dev/null";
  Outcome result;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) result.out.append(buffer.data(), n);
  result.code = WEXITSTATUS(pclose(pipe));
  return result;
}

class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("puffin-program-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  const std::string l_base = std::string(PUFFIN_SOURCE_DIR) + "/cases/l-base/case.toml";
  std::filesystem::path folder_;
};

bool one_object(const std::string& text) {
  return text.starts_with("{") && text.ends_with("}\n") && text.find("\n{") == std::string::npos;
}

TEST_F(Program, VersionIsPrinted) {
  EXPECT_EQ(puffin("version").code, 0);
  EXPECT_TRUE(one_object(puffin("version --json").out));
}

TEST_F(Program, UsageErrorsEndWith2) {
  for (const char* arguments : {"", "no-such-command", "check", "geometry l-bend", "version --nonsense",
                                "geometry l-bend --set step_heigth=1 --out x.stl"})
    EXPECT_EQ(puffin(arguments).code, 2) << arguments;
}

TEST_F(Program, ACaseWithThreeMistakesEndsWith3AndNamesThem) {
  const std::string bad = file("bad.toml",
                               "name = \"bad\"\n[geometry]\ngenerator = \"box\"\n[air]\nmodel = \"lbn\"\n[numerics]\n"
                               "dx = \"1 s\"\n[stop]\ntimes = 1\n");
  const Outcome o = puffin("check " + bad + " --json");
  EXPECT_EQ(o.code, 3);
  EXPECT_TRUE(one_object(o.out)) << o.out;
  for (const char* part : {"\"line\": 5", "\"line\": 7", "\"line\": 9", "did you mean 'lbm'", "did you mean 'time'"})
    EXPECT_NE(o.out.find(part), std::string::npos) << part << o.out;
}

TEST_F(Program, CellsTooCoarseForTheJetOfAnInletAreToldWithARemedy) {
  // 4 area / perimeter of 7 mm x 1.5 mm is 2.47 mm: 9.9 cells of 0.25 mm, 6.6 of 0.375 mm; an eighth is 0.309 mm.
  const std::string coarse = puffin("check " + l_base + " --preset quick --json").out;
  EXPECT_NE(coarse.find("has 6.6 cells"), std::string::npos) << coarse;
  EXPECT_NE(coarse.find("take a dx of at most 0.309 mm"), std::string::npos) << coarse;
  EXPECT_EQ(puffin("check " + l_base + " --json").out.find("for a jet of"), std::string::npos);
}

TEST_F(Program, APictureIsOfWhatIsAskedOrTheWordIsRefused) {
  const std::string air = file("air.toml", R"toml(
name = "air"
geometry = { generator = "duct", duct = { length = "2 mm", width = "1 mm", height = "1 mm" } }
numerics = { dx = "0.2 mm" }
stop = { time = "0.05 ms" }
output = { fields = [{ what = ["velocity", "pressure"], region = "all", every = "0.05 ms" }] }
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = "1 L/min"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
)toml");
  const std::string run = (folder_ / "run").string(), png = (folder_ / "a.png").string();
  ASSERT_EQ(puffin("run " + air + " --out " + run + " --quiet").code, 0);
  const auto code = [&](const std::string& arguments) {
    return puffin("render " + run + " --out " + png + " " + arguments).code;
  };
  const auto bytes = [&] {
    std::ifstream stream(png);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  ASSERT_EQ(code("--view slice"), 0);
  const std::string speed = bytes();
  EXPECT_EQ(code("--view slice --quantity speed"), 0);
  EXPECT_EQ(bytes(), speed);
  EXPECT_EQ(code("--view slice --quantity pressure --max 50Pa --plane x=1mm"), 0);
  EXPECT_NE(bytes(), speed);
  for (const char* refused : {"--quantity fines", "--quantity hits", "--plane x=1m", "--plane x=-1um", "--max 0",
                              "--quantity pressure --max 2m/s"})
    EXPECT_EQ(code(std::string("--view slice ") + refused), 2) << refused;
}

TEST_F(Program, AMissingCaseFileEndsWith7) { EXPECT_EQ(puffin("check no/such/case.toml").code, 7); }

TEST_F(Program, ASurfaceWithAHoleEndsWith4) {
  const std::string stl = file("hole.stl",
                               "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                               "endloop\nendfacet\nendsolid s\n");
  EXPECT_EQ(puffin("voxelize " + stl + " --dx 0.1mm").code, 4);
}

// A box of 1 mm whose lid stands twice, in ASCII STL as many exporters write it.
TEST_F(Program, FacetsThatStandTwiceAreLeftOutWithAWarning) {
  const int corners[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                              {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  std::string text = "solid wall\n";
  for (const int f : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 2, 3}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int c : corners[f])
      text +=
          "vertex " + std::to_string(c & 1) + " " + std::to_string(c >> 1 & 1) + " " + std::to_string(c >> 2) + "\n";
    text += "endloop\nendfacet\n";
  }
  const std::string stl = file("twice.stl", text + "endsolid wall\n");
  const std::string box = file("twice.toml", "schema = 1\nname = \"twice\"\n[geometry]\nstl = \"" + stl +
                                                 "\"\n[air]\nmodel = \"none\"\n[carriers]\ndiameter = \"70 um\"\n"
                                                 "density = 1520\nlist = [{ position = [5e-4, 5e-4, 5e-4] }]\n"
                                                 "outside = \"bounce\"\n[carriers.adhesion]\nmodel = \"none\"\n"
                                                 "[stop]\ntime = \"1 us\"\n");
  const Outcome o = puffin("check " + box + " --json");
  EXPECT_EQ(o.code, 0) << o.out;
  EXPECT_NE(o.out.find("2 facets stand more than once"), std::string::npos) << o.out;
  EXPECT_EQ(puffin("voxelize " + stl + " --dx 0.1mm").code, 4);  // which describes the file as it is
}

TEST_F(Program, AnUnusableSurfaceIsDescribedAsJsonAndAsAPictureBeforeTheProgramEndsWith4) {
  const std::string stl = file("hole.stl",
                               "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                               "endloop\nendfacet\nendsolid s\n");
  const Outcome o = puffin("voxelize " + stl + " --dx 0.1mm --json --out " + (folder_ / "look").string());
  EXPECT_EQ(o.code, 4);
  EXPECT_TRUE(one_object(o.out)) << o.out;
  for (const char* part : {"\"ok\": false", "\"kind\": \"hole\"", "\"count\": 3", "\"cells_fluid\": null", "--repair"})
    EXPECT_NE(o.out.find(part), std::string::npos) << part << o.out;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "look/report.png"));
}

TEST_F(Program, AMissingSurfaceAndAFolderThatIsNotThereEndWith7) {
  EXPECT_EQ(puffin("voxelize no-such.stl --dx 0.1mm").code, 7);
  EXPECT_EQ(puffin("geometry box --out no/such/folder/box.stl").code, 7);
}

TEST_F(Program, ARepairedSurfaceIsWrittenAndNeedsNoRepair) {
  const std::string stl = (folder_ / "box.stl").string(), mended = (folder_ / "mended").string();
  ASSERT_EQ(puffin("geometry box --set x=2mm --set y=1mm --set z=1mm --out " + stl).code, 0);
  std::ifstream in(stl);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const auto first = whole.find(" facet"), second = whole.find(" facet", first + 1);
  const std::string damaged = file("damaged.stl", whole.substr(0, first) + whole.substr(second));
  EXPECT_EQ(puffin("voxelize " + damaged + " --dx 0.1mm").code, 4);
  const Outcome o = puffin("voxelize " + damaged + " --dx 0.1mm --repair --largest-hole 10mm --json --out " + mended);
  EXPECT_EQ(o.code, 0) << o.out;
  EXPECT_NE(o.out.find("filled holes: 1"), std::string::npos) << o.out;
  EXPECT_EQ(puffin("voxelize " + mended + "/repaired.stl --dx 0.1mm").code, 0);
}

TEST_F(Program, AnOpeningThatTheCaseForgetsEndsWith4) {
  const std::string air =
      "name = \"forgetful\"\n[geometry]\ngenerator = \"duct\"\n[air]\nmodel = \"lbm\"\n"
      "density = 1.2\nviscosity = 1.8e-5\n[numerics]\ncells = 4000\nreference_speed = 1.0\n[stop]\ntime = \"1 ms\"\n";
  const Outcome o = puffin("check " + file("forgetful.toml", air) + " --json");
  EXPECT_EQ(o.code, 4) << o.out;
  EXPECT_NE(o.out.find("untagged opening: the patch 'inlet'"), std::string::npos) << o.out;
}

TEST_F(Program, TheQuickLBaseIsFoundRight) {
  const Outcome o = puffin("check " + l_base + " --preset quick --json");
  EXPECT_EQ(o.code, 0);
  EXPECT_TRUE(one_object(o.out));
  EXPECT_NE(o.out.find("\"ok\": true"), std::string::npos);
}

TEST_F(Program, AGeneratedSurfaceCanBeVoxelized) {
  const std::string stl = (folder_ / "box.stl").string();
  EXPECT_EQ(puffin("geometry box --set x=2mm --set y=1mm --set z=1mm --out " + stl).code, 0);
  const Outcome o = puffin("voxelize " + stl + " --dx 0.1mm --json --out " + folder_.string());
  EXPECT_EQ(o.code, 0);
  EXPECT_TRUE(one_object(o.out));
  EXPECT_NE(o.out.find("\"cells_fluid\": 2000"), std::string::npos) << o.out;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "voxels.vti"));
}

TEST_F(Program, TheDoctorNamesWhatIsWrongWithAMachine) {
  setenv("TMPDIR", "/proc/nowhere", 1);
  const Outcome o = puffin("doctor");
  unsetenv("TMPDIR");
  EXPECT_EQ(o.code, 6);
  EXPECT_NE(o.out.find("set TMPDIR to a folder that can be written"), std::string::npos) << o.out;
}

TEST_F(Program, PlanSaysWhatIsSkippedAndWhy) {
  const Outcome o = puffin("plan " + std::string(PUFFIN_SOURCE_DIR) + "/cases/l-flow/case.toml --json");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.out.find("the case has no [carriers]"), std::string::npos) << o.out;
}

}  // namespace
