#pragma once
// How fast the carriers are, beside LIGGGHTS on the same machine where that is installed.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace puffin::bench {

struct DemSetting {
  std::string scene = "dense";  // dense | dilute | resting (dem_scenes.hpp)
  std::int64_t carriers = 2500;
  int threads = 1;
};

struct DemRow {
  DemSetting setting;
  /// A carrier over one contact step t_c/20, as any code without our closed forms would have to count it:
  /// carriers * simulated time / (t_c/20), a second. The same for a scene computed by LIGGGHTS with that step.
  double particle_steps_per_second = 0.0;
  double liggghts_particle_steps_per_second = 0.0;  // the same scene by LIGGGHTS, as many processes; 0: not installed
  double ratio = 0.0;                               // of the two; 0: not installed
  double substeps_per_second = 0.0;                 // carriers moved by one sub-step of their cluster
  double contacts_per_second = 0.0;                 // live contacts evaluated, a second
  double contacts_per_carrier = 0.0;                // live ones at the end, each counted once
  double nanoseconds_per_carrier = 0.0;             // of one air step
  double foreign_load = 0.0;                        // share of the cores that other processes used meanwhile
  double seconds = 0.0;                             // wall-clock of the measured steps
};

/// All rows of `puffin bench dem`. sizes: numbers of carriers; empty: 2,500, 25,000 and 250,000. quick: 2,500 and
/// 25,000 without LIGGGHTS, in less time. `row_done` is told of each row.
std::vector<DemRow> dem_benchmark(bool quick, std::vector<std::int64_t> sizes,
                                  const std::function<void(const DemRow&)>& row_done);

/// One row: at least `seconds` of air steps after a warm-up of two; beside LIGGGHTS if `compare` and it is there.
DemRow measure_dem(const DemSetting& setting, double seconds, bool compare);

}  // namespace puffin::bench
