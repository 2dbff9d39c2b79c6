#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/tools/output/scratch.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {
namespace {

/// Every member has a value of its own.
Summary full_summary() {
  Summary s;
  s.name = "L-Base";
  s.version = "0.1.0";
  s.state = "finished";
  s.message = "every carrier has left";
  s.preset = "fast", s.stop_time = 0.211, s.case_stop_time = 0.3;
  s.simulated_time = 0.211;
  s.wall_clock = 350.5;
  s.threads = 2;
  s.host = "x86-64-v3";
  s.cells_fluid = 213576;
  s.cells_active = 250001;
  s.steps = 3000000000;
  s.mlups = 40.5;
  s.mlups_active = 47.25;
  s.dx = 0.234e-3;
  s.dt_min = 2e-7;
  s.dt_max = 1e-6;
  s.tau_min = 0.5003;
  s.mach_max = 0.21;
  s.memory_peak = 1.5e8;
  s.phases = {{"collide and stream", 200.5}, {"carriers", 120.25}};
  s.skipped = {{"carriers at rest", 1200, 33.5}};
  s.pressure = PressureSummary{
      {2400.0, 2300.0, 2500.0, 20}, {2600.0, 2550.0, 2650.0, 21}, 0.19, 0.211, {6e-4, 5.9e-4, 6.1e-4, 20}};
  s.forces = {{"wall", 1e-3, 2e-3, 3e-3}};
  s.air_mass = AirMass{1.5e-6, 1.25e-6, 2.5e-7, 40};
  s.carriers = CarrierSummary{25000, 24990, 10, 0.0004, 0.064, 0.097, 0.2105, 0.13};
  s.fines = {{"L-Base", 0.67, 0.12, 0.001, 0.2, 0.009, 3e-12, {0.997, 0.002, 0.001}},
             {"L-Diffusion", 0.66, 0.13, 0.001, 0.2, 0.009, 4e-12, {0.996, 0.003, 0.001}}};
  s.collisions = CollisionSummary{232560, 548490, 24, 25, 5.5e-10, 1.5e-13};
  s.assumptions = {"the leg's width is assumed"};
  s.reference = {{"FFE", 0.67, 0.2, 0.64, 0.7, 0.03}, {"unknown", 1.0, {}, {}, {}, {}}};
  return s;
}

TEST(Summary, WritingWhatWasReadGivesTheSameText) {
  const Scratch folder;
  write_summary(folder / "summary.json", full_summary());
  const Summary back = read_summary(folder / "summary.json");
  EXPECT_EQ(summary_json(back), summary_json(full_summary()));
  EXPECT_EQ(back.steps, 3000000000);
  EXPECT_EQ(back.carriers->last_emitted, 0.2105);
  EXPECT_EQ(back.fines.at(1).by_mechanism.particle, 0.003);
}

TEST(Summary, HoldsEveryKeyOfTheInterfaceWithItsValue) {
  const auto json = nlohmann::json::parse(summary_json(full_summary()));
  const auto at = [&](const char* path) { return json.at(nlohmann::json::json_pointer(path)); };
  EXPECT_EQ(at("/name"), "L-Base");
  EXPECT_EQ(at("/version"), "0.1.0");
  EXPECT_EQ(at("/state"), "finished");
  EXPECT_EQ(at("/assumptions/0"), "the leg's width is assumed");
  EXPECT_EQ(at("/skipped/0/name"), "carriers at rest");
  EXPECT_EQ(at("/reference/0/name"), "FFE");
  const std::pair<const char*, double> numbers[] = {{"/simulated_time", 0.211},
                                                    {"/wall_clock", 350.5},
                                                    {"/threads", 2},
                                                    {"/cells_fluid", 213576},
                                                    {"/cells_active", 250001},
                                                    {"/steps", 3e9},
                                                    {"/mlups", 40.5},
                                                    {"/mlups_active", 47.25},
                                                    {"/dx", 0.234e-3},
                                                    {"/dt_min", 2e-7},
                                                    {"/dt_max", 1e-6},
                                                    {"/tau_min", 0.5003},
                                                    {"/mach_max", 0.21},
                                                    {"/memory_peak", 1.5e8},
                                                    {"/air_mass/lost", 1.5e-6},
                                                    {"/air_mass/returned", 1.25e-6},
                                                    {"/air_mass/missing", 2.5e-7},
                                                    {"/air_mass/corrections", 40},
                                                    {"/phases/carriers", 120.25},
                                                    {"/skipped/0/times", 1200},
                                                    {"/skipped/0/seconds_saved", 33.5},
                                                    {"/pressure/static_drop/mean", 2400},
                                                    {"/pressure/static_drop/ci_low", 2300},
                                                    {"/pressure/total_to_static_drop/ci_high", 2650},
                                                    {"/pressure/total_to_static_drop/batches", 21},
                                                    {"/pressure/window/0", 0.19},
                                                    {"/forces/wall/1", 2e-3},
                                                    {"/carriers/count", 25000},
                                                    {"/carriers/emitted", 24990},
                                                    {"/carriers/retained", 10},
                                                    {"/carriers/retained_fraction", 0.0004},
                                                    {"/carriers/first_motion", 0.064},
                                                    {"/carriers/first_emitted", 0.097},
                                                    {"/carriers/last_emitted", 0.2105},
                                                    {"/carriers/RDF", 0.13},
                                                    {"/fines/L-Base/FFE", 0.67},
                                                    {"/fines/L-Base/FFW", 0.12},
                                                    {"/fines/L-Base/FFCR", 0.001},
                                                    {"/fines/L-Base/FFCE", 0.2},
                                                    {"/fines/L-Base/in_air", 0.009},
                                                    {"/fines/L-Base/ledger_error", 3e-12},
                                                    {"/fines/L-Base/by_mechanism/wall", 0.997},
                                                    {"/fines/L-Base/by_mechanism/particle", 0.002},
                                                    {"/fines/L-Base/by_mechanism/drag", 0.001},
                                                    {"/collisions/wall", 232560},
                                                    {"/collisions/particle", 548490},
                                                    {"/collisions/median_per_carrier", 24},
                                                    {"/collisions/median_per_emitted_carrier", 25},
                                                    {"/collisions/mean_wall_energy", 5.5e-10},
                                                    {"/collisions/mean_particle_energy", 1.5e-13},
                                                    {"/reference/0/given", 0.67},
                                                    {"/reference/0/difference", 0.03}};
  for (const auto& [path, value] : numbers) EXPECT_EQ(at(path), value) << path;
}

TEST(Summary, WhatIsNotANumberBecomesNull) {
  Summary s;
  s.mach_max = std::numeric_limits<double>::quiet_NaN();
  s.carriers = CarrierSummary{};
  const auto json = nlohmann::json::parse(summary_json(s));
  EXPECT_TRUE(json["mach_max"].is_null());
  EXPECT_TRUE(json["carriers"]["first_motion"].is_null());
  EXPECT_TRUE(json["collisions"]["mean_wall_energy"].is_null()) << "there, and empty";
  EXPECT_TRUE(json["pressure"]["static_drop"]["mean"].is_null());
  EXPECT_TRUE(json["pressure"]["window"].is_null());
}

TEST(Summary, ADamagedOrMissingFileIsAnOutputError) {
  const Scratch folder;
  EXPECT_THROW(read_summary(folder / "none.json"), OutputError);
  std::ofstream(folder / "bad.json") << "{\"name\": ";
  EXPECT_THROW(read_summary(folder / "bad.json"), OutputError);
  EXPECT_THROW(write_summary("/proc/summary.json", Summary{}), OutputError);
}

TEST(Reference, NamesAreFoundByKeyByPathAndByMean) {
  const Summary s = full_summary();
  EXPECT_EQ(find_value(s, "FFE"), 0.67);
  EXPECT_EQ(find_value(s, "fines.L-Diffusion.FFE"), 0.66);
  EXPECT_EQ(find_value(s, "retained_fraction"), 0.0004);
  EXPECT_EQ(find_value(s, "static_drop"), 2400.0);
  EXPECT_EQ(find_value(s, "pressure.total_to_static_drop.ci_high"), 2650.0);
  EXPECT_EQ(find_value(s, "experiment.FFE"), 0.67);
  EXPECT_EQ(find_value(s, "thesis.by_mechanism.wall"), s.fines[0].by_mechanism.wall);
  EXPECT_EQ(find_value(s, "collisions.wall"), 232560);
  EXPECT_EQ(find_value(s, "collisions.FFE"), std::nullopt);
  EXPECT_EQ(find_value(s, "FFX"), std::nullopt);
}

TEST(Reference, DifferenceIsOursMinusGiven) {
  Summary s = full_summary();
  compare_with_reference(s, {{"FFE", 0.5, {}, {}}, {"no such number", 1.0, {}, {}}});
  ASSERT_EQ(s.reference.size(), 2u);
  EXPECT_EQ(s.reference[0].ours, 0.67);
  EXPECT_EQ(s.reference[0].difference, 0.67 - 0.5);
  EXPECT_FALSE(s.reference[1].ours || s.reference[1].difference);
}

TEST(Status, ReadsBack) {
  const Scratch folder;
  write_status(folder / "status.json",
               {"L-Base", "running", "carriers", 0.1, 0.211, 12345, 40.5, 60.0, 66.5, 1e-13, 2e-8, {"tau near 1/2"}});
  const Status back = read_status(folder / "status.json");
  EXPECT_EQ(back.phase, "carriers");
  EXPECT_EQ(back.steps, 12345);
  EXPECT_EQ(back.eta, 66.5);
  EXPECT_EQ(back.air_lost, 2e-8);
  EXPECT_EQ(back.warnings, std::vector<std::string>{"tau near 1/2"});
  EXPECT_FALSE(std::filesystem::exists(folder / "status.json.part"));
}

}  // namespace
}  // namespace puffin::output
