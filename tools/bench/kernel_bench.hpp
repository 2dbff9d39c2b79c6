#pragma once
// How fast the air is, beside what the memory of this machine allows in the same run.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace puffin::bench {

/// One setting: a closed box at rest walls, or the L-bend with its openings; `wall` "none" is a periodic box.
struct KernelSetting {
  std::string scene = "l-bend";  // box | l-bend
  double cells = 210000;         // wanted number of fluid cells
  int threads = 1;
  std::string collision = "rr3";
  std::string precision = "float";
  std::string wall = "bouzidi";
};

struct KernelRow {
  KernelSetting setting;
  std::int64_t cells = 0;          // fluid cells
  double mlups = 0.0;              // complete steps: collision, streaming, walls, openings
  double mlups_bare = 0.0;         // collision and streaming alone
  double bound_mlups = 0.0;        // 19 reads and 19 writes a cell of the same memory, in place
  double fraction_of_bound = 0.0;  // mlups / bound_mlups, median over the turns
  double bare_fraction_of_bound = 0.0;
  double copy_bandwidth = 0.0;   // [B/s] of a plain copy of the same size
  double bound_over_copy = 0.0;  // bandwidth of the bound's stream over that of the copy
  double foreign_load = 0.0;     // share of the cores that other processes used meanwhile
  double seconds = 0.0;          // wall-clock of the row
};

/// All rows of `puffin bench kernel`. sizes: wanted numbers of cells; empty: 0.21, 1, 4 and 16 million. quick: fewer
/// settings, and 0.21 million cells alone. `row_done` is told of each row.
std::vector<KernelRow> kernel_benchmark(bool quick, std::vector<double> sizes,
                                        const std::function<void(const KernelRow&)>& row_done);

/// One row: `repeats` turns of bound, whole steps, bare kernel and copy, at least `seconds` each; medians over the
/// turns.
KernelRow measure_kernel(const KernelSetting& setting, double seconds, int repeats);

}  // namespace puffin::bench
