// What lies beside a run, changed or taken away, neither loses it nor goes unnoticed.

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tools/output/output_folder.hpp"
#include "tools/output/summary.hpp"

namespace puffin {
namespace {

namespace fs = std::filesystem;

class LostFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("puffin-lost-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void file(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string text(const std::string& name) const {
    std::ifstream stream(folder_ / name);
    std::stringstream all;
    all << stream.rdbuf();
    return all.str();
  }
  int puffin(const std::string& arguments) const {
    return WEXITSTATUS(std::system(("cd " + folder_.string() + " && timeout 120 " + PUFFIN_BINARY_DIR + "/puffin " +
                                    arguments + " > said.txt 2> log.txt")
                                       .c_str()));
  }
  fs::path folder_;
};

// A duct of 20 cells; its inlet's profile is a file.
constexpr const char* duct = R"toml(name = "duct"
geometry = { generator = "duct", duct = { length = "5 mm", width = "2 mm", height = "2 mm" } }
numerics = { dx = "0.5 mm" }
stop = { time = "1 ms" }
output = { statistics = "0.1 ms" }
[air]
density = 1.2
viscosity = 1.8e-5
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
profile = { file = "profile.csv" }
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
)toml";
constexpr const char* profile =
    "x,y,z,u,v,w\n0,0,0,5,0,0\n0,2e-3,0,5,0,0\n0,0,2e-3,5,0,0\n0,2e-3,2e-3,5,0,0\n0,5e-4,1e-3,9,0,0\n";

TEST_F(LostFiles, AResumedRunRefusesOtherInputs) {
  const std::string force = "time,fx,fy,fz\n0,10,0,0\n1,10,0,0\n", weaker = "time,fx,fy,fz\n0,10,0,0\n1,9,0,0\n";
  file("profile.csv", profile);
  file("force.csv", force);
  std::string with_force = duct;
  with_force.insert(with_force.find("[[air.boundary]]"), "body_force = { file = \"force.csv\" }\n");
  file("case.toml", with_force);
  ASSERT_EQ(puffin("run case.toml --no-report --out out --until 0.5ms"), 0) << text("log.txt");
  file("force.csv", weaker);
  EXPECT_EQ(puffin("run case.toml --no-report --out out --resume"), 7) << text("log.txt");
  EXPECT_NE(text("log.txt").find("what air.body_force.file holds"), std::string::npos) << text("log.txt");
  file("force.csv", force);
  EXPECT_EQ(puffin("run case.toml --no-report --out out --resume"), 0) << text("log.txt");
}

// What stands in the way of summary.json stands for a full disk at that moment: the run has ended, its end is not told
// yet.
TEST_F(LostFiles, ARunWhoseSummaryCouldNotBeWrittenCanBeResumed) {
  file("profile.csv", profile);
  file("case.toml", std::string(duct) +
                        "[carriers]\nlist = [{ position = [1e-3, 1e-3, 1e-3], diameter = \"70 um\", density = 1520 }]\n"
                        "contact = { restitution = 0.6, friction = 0.3 }\n");
  fs::create_directories(folder_ / "out");
  ASSERT_EQ(puffin("run case.toml --no-report --out out --until 0.5ms"), 0) << text("log.txt");
  fs::create_directories(folder_ / "out/summary.json.part/in-the-way");
  EXPECT_EQ(puffin("run case.toml --no-report --out out --resume"), 7) << text("log.txt");
  fs::remove_all(folder_ / "out/summary.json.part");
  ASSERT_EQ(puffin("run case.toml --no-report --out out --resume"), 0) << text("log.txt");
  EXPECT_EQ(output::read_summary(folder_ / "out/summary.json").state, "finished");
}

// What the last carrier owed the air is given in the exchange after it left; then nothing is owed.
TEST_F(LostFiles, ARunWhoseCarriersHaveAllLeftCanBeResumed) {
  file("profile.csv", profile);
  file("case.toml",
       std::string(duct) +
           "[carriers]\nlist = [{ position = [4.8e-3, 1e-3, 1e-3], velocity = [20.0, 0.0, 0.0], diameter = "
           "\"70 um\", density = 1520 }]\ncontact = { restitution = 0.6, friction = 0.3 }\n");
  std::string all = text("case.toml");
  all.replace(all.find("time = \"1 ms\""), 13, "time = \"60 ms\", when_empty = false");
  all.replace(all.find("0.1 ms"), 8, "1 ms\", checkpoint = { wall = \"1 us\" } ");
  file("case.toml", all);
  ASSERT_EQ(puffin("run case.toml --no-report --out out --until 30ms"), 0) << text("log.txt");
  EXPECT_EQ(output::read_summary(folder_ / "out/summary.json").carriers->emitted, 1);
  EXPECT_EQ(puffin("run case.toml --no-report --out out --resume"), 0) << text("log.txt");
}

// A cloud in air that does not change: nothing is streamed, so no air step is there to be counted.
TEST_F(LostFiles, FinesInFrozenAirHaveCheckpointsOnTheWay) {
  file("case.toml", R"toml(name = "cloud"
geometry = { generator = "box", box = { x = "1 mm", y = "0.5 mm", z = "0.5 mm" } }
numerics = { dx = "0.1 mm" }
stop = { time = "200 ms", when_empty = false }
output = { checkpoint = { wall = "1 us", keep = 100 } }
[air]
model = "frozen"
field = "uniform"
velocity = [2.0, 0.0, 0.0]
boundary = [ { patch = "x-min", type = "periodic", with = "x-max" } ]
[[fines.scalar]]
name = "cloud"
initial = { shape = "gaussian", center = [5e-4, 2.5e-4, 2.5e-4], sigma = "0.1 mm", amount = 1000.0 }
)toml");
  ASSERT_EQ(puffin("run case.toml --no-report --out out"), 0) << text("log.txt");
  EXPECT_GT(output::list_checkpoints(folder_ / "out").size(), 2u);
}

// The outlet: a triangle of 0.1 mm between the links of cells of 1 mm, with the rest of the face around it.
TEST_F(LostFiles, AnOpeningWithoutACellIsAMatterOfTheGeometry) {
  std::string stl;
  const auto solid = [&](const char* name, const std::vector<std::array<const char*, 3>>& triangles) {
    stl += std::string("solid ") + name + "\n";
    for (const auto& t : triangles) {
      stl += "facet normal 0 0 0\nouter loop\n";
      for (const char* vertex : t) stl += std::string("vertex ") + vertex + "\n";
      stl += "endloop\nendfacet\n";
    }
    stl += std::string("endsolid ") + name + "\n";
  };
  const char *a = "0 0 0", *b = "0 4 0", *c = "0 4 4", *d = "0 0 4", *e = "6 0 0", *f = "6 4 0", *g = "6 4 4",
             *h = "6 0 4", *p = "6 2.7 2.2", *q = "6 2.8 2.2", *r = "6 2.75 2.3";
  solid("inlet", {{a, d, c}, {a, c, b}});
  solid("outlet", {{p, q, r}});
  solid("wall", {{a, b, f},
                 {a, f, e},
                 {b, c, g},
                 {b, g, f},
                 {c, d, h},
                 {c, h, g},
                 {d, a, e},
                 {d, e, h},
                 {e, f, q},
                 {e, q, p},
                 {f, g, r},
                 {f, r, q},
                 {g, h, r},
                 {h, e, p},
                 {h, p, r}});
  file("small.stl", stl);
  file("case.toml", R"toml(name = "small"
geometry = { stl = "small.stl", unit = "mm" }
numerics = { dx = "1 mm" }
stop = { time = "1 ms" }
[air]
density = 1.2
viscosity = 1.8e-5
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
velocity = "5 m/s"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
)toml");
  EXPECT_EQ(puffin("run case.toml --no-report --out out"), 4) << text("log.txt");
  EXPECT_NE(text("log.txt").find("'outlet' touches no cell"), std::string::npos) << text("log.txt");
}

TEST_F(LostFiles, APipeOfDiametersIsNotWaitedFor) {
  ASSERT_EQ(std::system(("mkfifo " + (folder_ / "sizes.csv").string()).c_str()), 0);
  for (const char* key : {"diameter = { law = \"table\", file = \"sizes.csv\" }",
                          "diameter = \"70 um\"\nfill = { shape = \"file\", file = \"sizes.csv\" }"}) {
    file("case.toml", std::string(R"toml(name = "pipe"
geometry = { generator = "box", box = { x = "1 mm", y = "1 mm", z = "1 mm" } }
stop = { time = "1 ms" }
[air]
model = "none"
density = 1.2
viscosity = 1.8e-5
[carriers]
count = 10
density = 1520
contact = { restitution = 0.6, friction = 0.3 }
)toml") + key + "\n");
    EXPECT_EQ(puffin("check case.toml"), 3) << text("log.txt");
  }
}

TEST_F(LostFiles, ADamagedStudyIsNamed) {
  file("profile.csv", profile);
  file("case.toml", duct);
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\n");
  fs::create_directories(folder_ / "out");
  for (const char* damage : {R"({"jobs":[1]})", R"({"jobs":5})", R"({"jobs":[{"id":3}]})"}) {
    file("out/study.json", damage);
    EXPECT_EQ(puffin("batch study.toml --out out"), 7) << damage << text("log.txt");
    EXPECT_NE(text("log.txt").find("study.json is damaged"), std::string::npos) << text("log.txt");
  }
}

TEST_F(LostFiles, AFullStandardOutputIsTold) {
  file("profile.csv", profile);
  file("case.toml", duct);
  EXPECT_EQ(WEXITSTATUS(std::system(("cd " + folder_.string() + " && " + PUFFIN_BINARY_DIR +
                                     "/puffin check case.toml --json > /dev/full 2> log.txt")
                                        .c_str())),
            7);
}

// As many CAD programs write it: a byte that is no UTF-8.
TEST_F(LostFiles, ASolidNamedInLatinOneIsReported) {
  ASSERT_EQ(puffin("geometry duct --out duct.stl"), 0) << text("log.txt");
  std::string stl = text("duct.stl");
  for (std::size_t at = 0; (at = stl.find("solid wall", at)) != std::string::npos;)
    stl.replace(at, 10, "solid w\xe4ll");
  file("duct.stl", stl);
  EXPECT_EQ(puffin("voxelize duct.stl --dx 0.5mm --out vox"), 0) << text("log.txt");
  EXPECT_NE(text("vox/report.json").find("cells_fluid"), std::string::npos);
}

}  // namespace
}  // namespace puffin
