#pragma once
// summary.json from a simulation and its history.

#include <array>
#include <optional>
#include <string>

#include "tools/output/summary.hpp"
#include "tools/puffin/recorder.hpp"

namespace puffin::tools {

/// What only the run loop knows.
struct RunFacts {
  std::string state;  // finished | diverged | stopped
  std::string message;
  std::optional<double> until;  // the run ended there [s] though its case goes on
  std::string preset;
  double case_stop_time = 0.0;  // without preset and --until [s]
  std::vector<std::string> warnings;
  double wall_clock = 0.0;            // [s]
  double set_up = 0.0, output = 0.0;  // [s]
  int threads = 0;
};

/// The block of one scalar. Mechanisms (wall, particle, drag) share all fines that left a carrier, which are those that
/// each gave to the air, and to_wall: what sticks to walls was taken there by wall impacts.
output::FinesSummary fines_summary(const std::string& name, const coupling::Ledger& ledger,
                                   const std::array<double, 3>& to_air, double to_wall);

output::Summary summarize(const cases::Simulation& s, const Recorder& recorder, const RunFacts& facts);

}  // namespace puffin::tools
