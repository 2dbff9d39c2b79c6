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
  std::string collision = "rr3";  // rr3 | bgk | trt | central-moments | hrr
  std::string precision = "float";
  std::string wall = "bouzidi";  // bouzidi | halfway | psm | ibm | none
};

struct KernelRow {
  KernelSetting setting;
  std::int64_t cells = 0;          // fluid cells
  std::int64_t cells_active = 0;   // those that the wall computes beyond them too
  double steps_per_second = 0.0;   // complete steps: collision, streaming, walls, openings
  double mlups = 0.0;              // million fluid cells a second, complete steps
  double mlups_bare = 0.0;         // collision and streaming of the fluid cells alone
  double bound_mlups = 0.0;        // 19 reads and 19 writes a cell of the same memory, in place
  double fraction_of_bound = 0.0;  // mlups / bound_mlups, median over the turns
  double bare_fraction_of_bound = 0.0;
  double added = 0.0;            // by walls and openings to the time of the bare kernel, as a part of it
  double copy_bandwidth = 0.0;   // [B/s] of a plain copy of the same size
  double bound_over_copy = 0.0;  // bandwidth of the bound's stream over that of the copy
  double foreign_load = 0.0;     // share of the cores that other processes used meanwhile
  double seconds = 0.0;          // wall-clock of the row
};

/// What `puffin bench kernel` measures. sizes: wanted numbers of cells; empty: 0.21, 1, 4 and 16 million, or with quick
/// the first alone. Every collision; the walls psm and ibm where there are fewer than half a million cells.
std::vector<KernelSetting> kernel_settings(bool quick, std::vector<double> sizes, const std::vector<int>& threads);

/// All rows of `puffin bench kernel`. quick: fewer settings, shorter turns. `row_done` is told of each
/// row.
std::vector<KernelRow> kernel_benchmark(bool quick, std::vector<double> sizes,
                                        const std::function<void(const KernelRow&)>& row_done);

/// One row: `repeats` turns of bound, whole steps, bare kernel and copy, at least `seconds` each; medians over the
/// turns. The bare kernel of psm and ibm, which compute more cells and act within the collision, is that of the same
/// fluid with halfway walls. Throws std::invalid_argument for an unknown collision or wall.
KernelRow measure_kernel(const KernelSetting& setting, double seconds, int repeats);

}  // namespace puffin::bench
