// puffin replay, and micro-models that are fitted, derived, calibrated and shown: through the program.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/sanitized.hpp"
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
  // On the coarser cells of a sanitized build too few fines come off for the targets to be in reach of any constant.
  const double miss = sanitized ? 1e-3 : 1e-5;
  EXPECT_NEAR(c.at("targets")[0].at("fitted").get<double>(), left, miss);
  EXPECT_NEAR(c.at("targets")[1].at("fitted").get<double>(), walls, miss);
  ASSERT_EQ(puffin("replay out --micromodels c.toml --json", "c2.json"), 0) << text("c2.json.log");
  EXPECT_NEAR(json::parse(text("c2.json")).at("fines").at(f.name).at("FFCR").get<double>(), left, miss);

  // More on the walls than came off: no constant brings it about. The fit says so, and ends.
  ASSERT_EQ(puffin("micromodel fit --calibrate out --micromodels lactose-3.6e-3.toml --free wall_attach.scale --target "
                   "FFW=1 --json --out far.toml",
                   "far.json"),
            0)
      << text("far.json.log");
  const json far = json::parse(text("far.json"));
  EXPECT_LT(far.at("constants").at("wall_attach.scale").at("value").get<double>(), 1001.0);
  ASSERT_FALSE(far.at("warnings").empty());
  if (!sanitized) {  // on its coarser cells none of the fines that come off meet a wall, at any scale
    EXPECT_NE(far.at("warnings").dump().find("wall_attach.scale stopped at"), std::string::npos) << far.at("warnings");
  }
  EXPECT_NE(text("far.json.log").find("the target FFW = 1 of out is not met"), std::string::npos);
  EXPECT_TRUE(c.at("warnings").empty()) << c;

  std::ofstream(folder_ / "bad.toml") << "label = \"given\"\n[wall_detach]\nlaw = \"powr\"\n";
  EXPECT_EQ(puffin("replay out --micromodels bad.toml", "bad"), 3);
  EXPECT_NE(text("bad.log").find("bad.toml:3"), std::string::npos) << text("bad.log");
  EXPECT_EQ(puffin("replay nowhere --micromodels lactose-3.6e-3.toml", "none"), 7);
}

// The record of one carrier with one contact is sound at first, then wrong in one way after the other.
TEST_F(Replay, ARecordThatNoRunWritesIsRefused) {
  struct Record {
    output::EventRecord contact{.a = 0, .b = -1, .normal_speed = 1.0, .angle = 90.0, .order = 0.0, .a_loses = 1};
    output::ReplayTables tables{.end = 1e-3,
                                .carriers = {{2000.0, 0.0, 0, 0}},
                                .slip = {{1e-3, 1e-3, 0, 0}},
                                .air = {{4.0, 1.0, 2.0, 1.0, 0, 0}, {.mechanism = 1}, {.mechanism = 2}},
                                .rates = {},
                                .scalars = {"fines"}};
  };
  const auto replayed = [&](const Record& r) {
    std::filesystem::create_directories(folder_ / "out");
    output::EventsFile(folder_ / "out" / "events.h5").append({&r.contact, 1});
    output::write_replay_tables(folder_ / "out" / "events.h5", r.tables);
    return puffin("replay out --micromodels lactose-3.6e-3.toml", "said");
  };
  ASSERT_EQ(replayed({}), 0) << text("said.log");
  const double nan = std::nan(""), infinite = HUGE_VAL;
  using Tables = output::ReplayTables;
  using Wrong = std::function<void(Record&)>;
  const auto contact = [](auto member, auto value) { return [=](Record& r) { r.contact.*member = value; }; };
  const auto carrier = [](auto member, auto value) { return [=](Record& r) { r.tables.carriers[0].*member = value; }; };
  const auto slip = [](auto member, auto value) { return [=](Record& r) { r.tables.slip[0].*member = value; }; };
  const auto air = [](auto member, auto value) { return [=](Record& r) { r.tables.air[0].*member = value; }; };
  std::vector<std::pair<std::string, Wrong>> wrong;
  const auto add = [&](const std::string& says, const Wrong& change) { wrong.emplace_back(says, change); };
  using Event = output::EventRecord;
  for (const int id : {-5, 1, 12345}) {
    add("/events, row 0: a is " + std::to_string(id), contact(&Event::a, id));
    add("/replay_slip, row 0: carrier is " + std::to_string(id), slip(&Tables::Slip::carrier, id));
    add("/replay_carriers, row 0: id is " + std::to_string(id), carrier(&Tables::Carrier::id, id));
  }
  add("/events, row 0: b is 0, but must be another carrier than a", contact(&Event::b, 0));
  for (const double value : {nan, infinite, -2.0}) {
    add("/events, row 0: time_start is ", contact(&Event::time_start, value));
    add("/events, row 0: normal_speed is ", contact(&Event::normal_speed, value));
    add("/events, row 0: tangential_speed is ", contact(&Event::tangential_speed, value));
    add("/events, row 0: angle is ", contact(&Event::angle, value));
    add("/events, row 0: order is ", contact(&Event::order, value));
    add("/events, row 0: drag_a is ", contact(&Event::drag_a, value));
    add("/events, row 0: drag_b is ", contact(&Event::drag_b, value));
    add("/replay_carriers, row 0: initial is ", carrier(&Tables::Carrier::initial, value));
    add("/replay_carriers, row 0: drag_rest is ", carrier(&Tables::Carrier::drag_rest, value));
    add("/replay_slip, row 0: seconds is ", slip(&Tables::Slip::seconds, value));
    add("/replay_slip, row 0: metres is ", slip(&Tables::Slip::metres, value));
    add("/replay_air, row 0: released is ", air(&Tables::Air::released, value));
    add("/replay_air, row 0: emitted is ", air(&Tables::Air::emitted, value));
    add("/replay_air, row 0: deposited is ", air(&Tables::Air::deposited, value));
    add("/replay_air, row 0: in_air is ", air(&Tables::Air::in_air, value));
    add("/replay_rates, row 0: rate is ", [=](Record& r) { r.tables.rates = {value}; });
    add("replay_end is ", [=](Record& r) { r.tables.end = value; });
  }
  add("/events, row 0: time_start is 0.002, but must be from 0 to 0.001", contact(&Event::time_start, 2e-3));
  add("/events, row 0: normal_speed is 1e+09", contact(&Event::normal_speed, 1e9));  // faster than light
  add("/events, row 0: angle is 91", contact(&Event::angle, 91.0));
  add("/events, row 0: a_loses is 2", contact(&Event::a_loses, 2));
  add("/replay_carriers, row 0: initial is 1e+300", carrier(&Tables::Carrier::initial, 1e300));
  add("/replay_carriers, row 0: emitted is -1", carrier(&Tables::Carrier::emitted, -1));
  add("/replay_slip, row 0: slip_class is 50", slip(&Tables::Slip::slip_class, 50));
  add("/replay_slip, row 0: seconds is 1", slip(&Tables::Slip::seconds, 1.0));
  add("/replay_air, row 0: released is 2001, but must be from 0 to 2000", air(&Tables::Air::released, 2001.0));
  add("/replay_air, row 0: emitted is 5, but must be from 0 to 4", air(&Tables::Air::emitted, 5.0));
  add("/replay_air, row 0: in_air is 1.5, but must be what is released", air(&Tables::Air::in_air, 1.5));
  add("/replay_air, row 0: mechanism is 1, but must be 0", air(&Tables::Air::mechanism, 1));
  add("/replay_air has 2 rows, but must have 3", [](Record& r) { r.tables.air.pop_back(); });
  for (const auto& [says, change] : wrong) {
    Record record;
    change(record);
    EXPECT_EQ(replayed(record), 7) << says << text("said");
    EXPECT_NE(text("said.log").find("out/events.h5 is damaged: " + says), std::string::npos) << says << '\n'
                                                                                             << text("said.log");
    EXPECT_NE(text("said.log").find("repeat the run"), std::string::npos) << "the remedy";
  }
}

// As far as a sound record may go: parts of the dose, finite and not negative, that add up.
TEST_F(Replay, WhatIsAcceptedGivesFinitePartsOfTheDose) {
  std::filesystem::create_directories(folder_ / "out");
  output::EventRecord contact{.a = 0, .b = 1, .normal_speed = 2e8, .tangential_speed = 2e8, .order = 0.0, .a_loses = 1};
  contact.drag_a = 1e308;
  output::EventsFile(folder_ / "out" / "events.h5").append({&contact, 1});
  output::write_replay_tables(folder_ / "out" / "events.h5",
                              {.end = 1e300,
                               .carriers = {{1e30, 1e308, 0, 1}, {0.0, 0.0, 1, 0}},
                               .slip = {{1e-300, 1e-292, 0, 49}},
                               .air = {{1e-300, 0.0, 1e20, 0.0, 0, 0}, {.mechanism = 1}, {.mechanism = 2}},
                               .rates = {1.0},
                               .scalars = {"fines"}});
  // Emitted: more than was released, within what rounding may leave of a dose of 1e30.
  ASSERT_EQ(puffin("replay out --micromodels lactose-3.6e-3.toml --json", "said"), 0) << text("said.log");
  const json fines = json::parse(text("said")).at("fines").at("fines");
  double sum = 0.0;
  for (const char* part : {"FFE", "FFW", "FFCR", "FFCE", "in_air"}) {
    ASSERT_TRUE(fines.at(part).is_number()) << part << text("said");
    EXPECT_GE(fines.at(part).get<double>(), 0.0) << part;
    sum += fines.at(part).get<double>();
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
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
