#pragma once
// A made-up run in an L-shaped duct, for pictures and reports: its numbers are invented, its files are real.

#include <filesystem>

#include "tools/output/frames.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {

/// 30 x 25 x 4.5 mm, 7 mm wide; patches wall, inlet (x = 0), outlet (y = 25 mm), pocket (a disc of the floor).
WallFrame synthetic_walls();
/// Air that turns around the corner, on cells of 0.5 mm.
FieldFrame synthetic_field(double time);
/// Bodies that start in the pocket, fly into the corner and leave: 0.06 s to 0.2 s.
CarrierFrame synthetic_carriers(double time);
Summary synthetic_summary();

enum class RunKind { whole, flow_only, diverged };
/// Writes summary.json, history.csv and vtk/ into `folder`.
void write_synthetic_run(const std::filesystem::path& folder, RunKind kind = RunKind::whole);

}  // namespace puffin::output
