// puffin replay, and micro-models that are fitted, derived, calibrated and shown: through the program.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/run/small_dose.hpp"
#include "tools/output/events_file.hpp"
#include "tools/output/replay_tables.hpp"
#include "tools/output/summary.hpp"

namespace {

using namespace puffin;
using nlohmann::json;

class Replay : public SmallDose {
 protected:
  /// Exit code of `puffin ARGUMENTS`, run in the folder; stdout goes to NAME.
  int puffin(const std::string& arguments, const std::string& name) const {
    const std::string command = "cd " + folder_.string() + " && " + PUFFIN_BINARY_DIR + "/puffin " + arguments + " >" +
                                name + " 2>" + name + ".log";
    return WEXITSTATUS(std::system(command.c_str()));
  }
};

// Two carriers of fines add and subtract the same numbers in the same order: rounding alone, far below 1e-9.
TEST_F(Replay, TheRunsOwnConstantsReturnItsResults) {
  ASSERT_EQ(run("out", "--set stop.time='14 ms'"), 0) << text("out.log");  // until walls are hit hard
  ASSERT_EQ(puffin("replay out --micromodels lactose-3.6e-3.toml --json", "own.json"), 0) << text("own.json.log");
  const json own = json::parse(text("own.json"));
  const output::Summary summary = output::read_summary(folder_ / "out" / "summary.json");
  ASSERT_EQ(summary.fines.size(), 1U);
  const auto& f = summary.fines[0];
  const json& r = own.at("fines").at(f.name);
  ASSERT_GT(f.FFW + f.FFE + f.in_air, 0.0) << "the scene is meant to release fines";
  EXPECT_NEAR(r.at("FFW").get<double>(), f.FFW, 1e-9);
  EXPECT_NEAR(r.at("FFCR").get<double>(), f.FFCR, 1e-9);
  EXPECT_NEAR(r.at("FFCE").get<double>(), f.FFCE, 1e-9);
  EXPECT_NEAR(r.at("FFE").get<double>(), f.FFE, f.in_air + 1e-9);
  EXPECT_NEAR(r.at("by_mechanism").at("drag").get<double>(), f.by_mechanism.drag, 1e-9);
  EXPECT_GT(f.by_mechanism.drag, 0.0) << "else the slip was not tested";
  EXPECT_LT(own.at("seconds").get<double>(), 5.0);

  // Stronger adhesion takes less.
  ASSERT_EQ(puffin("replay out --micromodels lactose-1.8e-2.toml --json", "high.json"), 0);
  EXPECT_GT(json::parse(text("high.json")).at("fines").at(f.name).at("FFCR").get<double>(), f.FFCR);

  // Two constants for two targets that lie a little off the run's own outcome, so that they can be met.
  const double left = f.FFCR + 0.1 * (1.0 - f.FFCR), walls = 0.8 * f.FFW;
  ASSERT_EQ(puffin("micromodel fit --calibrate out --micromodels lactose-3.6e-3.toml --free wall_detach.surface_energy "
                   "--free wall_attach.A3 --target FFCR=" +
                       std::to_string(left) + " --target FFW=" + std::to_string(walls) + " --json --out c.toml",
                   "c.json"),
            0)
      << text("c.json.log");
  const json c = json::parse(text("c.json"));
  EXPECT_NEAR(c.at("targets")[0].at("fitted").get<double>(), left, 1e-5);
  EXPECT_NEAR(c.at("targets")[1].at("fitted").get<double>(), walls, 1e-5);
  ASSERT_EQ(puffin("replay out --micromodels c.toml --json", "c2.json"), 0) << text("c2.json.log");
  EXPECT_NEAR(json::parse(text("c2.json")).at("fines").at(f.name).at("FFCR").get<double>(), left, 1e-5);

  std::ofstream(folder_ / "bad.toml") << "label = \"given\"\n[wall_detach]\nlaw = \"powr\"\n";
  EXPECT_EQ(puffin("replay out --micromodels bad.toml", "bad"), 3);
  EXPECT_NE(text("bad.log").find("bad.toml:3"), std::string::npos) << text("bad.log");
  EXPECT_EQ(puffin("replay nowhere --micromodels lactose-3.6e-3.toml", "none"), 7);
}

// Its one contact is sound at first, then wrong in one way after the other.
TEST_F(Replay, ARecordThatNoRunWritesIsRefused) {
  const auto replayed = [&](const output::EventRecord& contact, const output::ReplayTables::Slip& slip) {
    std::filesystem::create_directories(folder_ / "out");
    output::EventsFile(folder_ / "out" / "events.h5").append({&contact, 1});
    output::ReplayTables tables;
    tables.end = 1e-3;
    tables.carriers = {{2000.0, 0.0, 0, 0}};
    tables.slip = {slip};
    tables.air = {{}};
    tables.scalars = {"fines"};
    output::write_replay_tables(folder_ / "out" / "events.h5", tables);
    return puffin("replay out --micromodels lactose-3.6e-3.toml", "said");
  };
  output::EventRecord sound;
  sound.a = 0, sound.b = -1, sound.normal_speed = 1.0, sound.angle = 90.0, sound.a_loses = 1;
  const output::ReplayTables::Slip slip{1e-3, 1e-3, 0, 0};
  ASSERT_EQ(replayed(sound, slip), 0) << text("said.log");
  const auto is_damage = [&](int code) {
    return code == 7 && text("said.log").find("events.h5 is damaged: ") != std::string::npos;
  };
  const double nan = std::nan("");
  for (const int carrier : {-5, 1, 1000000000}) {
    auto wrong = sound;
    wrong.a = carrier;
    EXPECT_TRUE(is_damage(replayed(wrong, slip))) << carrier << text("said.log");
  }
  for (const auto member :
       {&output::EventRecord::order, &output::EventRecord::time_start, &output::EventRecord::normal_speed,
        &output::EventRecord::angle, &output::EventRecord::drag_a}) {
    auto wrong = sound;
    wrong.*member = nan;
    EXPECT_TRUE(is_damage(replayed(wrong, slip))) << text("said.log");
  }
  EXPECT_TRUE(is_damage(replayed(sound, {nan, 1e-3, 0, 0}))) << text("said.log");
  EXPECT_TRUE(is_damage(replayed(sound, {1e-3, 1e-3, 1, 0}))) << text("said.log");
}

TEST_F(Replay, MicromodelsAreFittedAndShown) {
  std::ofstream table(folder_ / "table.csv");
  table << "speed,fraction\n";
  for (int n = 1; n <= 20; ++n) {
    const double v = 0.3 * n;
    table << v << "," << (v < 2.0 ? 0.01 * v : 0.02 * std::sqrt(v)) << "\n";
  }
  table.close();
  ASSERT_EQ(puffin("micromodel fit table.csv --json --out fit.toml --plot fit.svg", "fit.json"), 0)
      << text("fit.json.log");
  const json fit = json::parse(text("fit.json"));
  EXPECT_NEAR(fit.at("A")[0].get<double>(), 0.01, 1e-6);  // six digits in the table
  EXPECT_NEAR(fit.at("A")[4].get<double>(), 0.5, 1e-4);
  EXPECT_NE(text("fit.svg").find("<polyline"), std::string::npos);
  ASSERT_EQ(puffin("micromodel show fit.toml --json", "show.json"), 0) << text("show.json.log");
  const json show = json::parse(text("show.json"));
  EXPECT_EQ(show.at("label"), "given");
  EXPECT_FALSE(show.at("laws").at("wall_detach").at("continuous").get<bool>());
  EXPECT_EQ(puffin("micromodel fit nothing.csv", "none"), 7);
  EXPECT_EQ(puffin("micromodel", "verb"), 2);
}

TEST_F(Replay, MicromodelsAreDerived) {
  ASSERT_EQ(
      puffin("micromodel derive --surface-energy '3.6e-3 J/m^2' --target wall --impacts 4 --speeds 0.6 1.1 1.4 1.7 "
             "2.2 3 5 --out d.toml --json",
             "d.json"),
      0)
      << text("d.json.log");
  const json d = json::parse(text("d.json"));
  EXPECT_EQ(d.at("wall").at("points").size(), 7U);
  ASSERT_EQ(puffin("micromodel show d.toml --json", "show.json"), 0) << text("show.json.log");
  const json show = json::parse(text("show.json"));
  EXPECT_EQ(show.at("label"), "derived");
  EXPECT_EQ(show.at("laws").at("wall_detach").at("law"), "power");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "d.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "d-wall.csv"));
  EXPECT_EQ(puffin("micromodel derive --surface-energy '3 m'", "bad"), 2);
}

}  // namespace
