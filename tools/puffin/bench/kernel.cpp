// puffin bench kernel: the air's speed beside what the memory of this machine allows.

#include "tools/bench/kernel_bench.hpp"
#include "tools/puffin/bench/benches.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {
namespace {

using nlohmann::json;

json row_json(const bench::KernelRow& r) {
  return {{"scene", r.setting.scene},
          {"cells", r.cells},
          {"cells_active", r.cells_active},
          {"threads", r.setting.threads},
          {"collision", r.setting.collision},
          {"precision", r.setting.precision},
          {"wall", r.setting.wall},
          {"mlups", r.mlups},
          {"bound_mlups", r.bound_mlups},
          {"fraction_of_bound", r.fraction_of_bound},
          {"bare_fraction_of_bound", r.bare_fraction_of_bound},
          {"mlups_bare", r.mlups_bare},
          {"added_percent", 100.0 * r.added},
          {"steps_per_second", r.steps_per_second},
          {"copy_gb_per_s", 1e-9 * r.copy_bandwidth},
          {"bound_over_copy", r.bound_over_copy},
          {"foreign_load", r.foreign_load},
          {"seconds", r.seconds}};
}

}  // namespace

BenchRows bench_kernel(const BenchArguments& a) {
  json rows = json::array();
  if (!a.json)
    print("scene     cells     thr collision       precision wall       MLUPS   bare   adds  bound  share  foreign");
  bench::kernel_benchmark(a.quick, a.cells, [&](const bench::KernelRow& r) {
    rows.push_back(row_json(r));
    if (a.json) return;
    char line[200];
    std::snprintf(line, sizeof line, "%-8s %9lld %3d  %-15s %-9s %-8s %7.1f %6.1f %4.0f %% %6.1f  %4.0f %%  %4.0f %%",
                  r.setting.scene.c_str(), static_cast<long long>(r.cells), r.setting.threads,
                  r.setting.collision.c_str(), r.setting.precision.c_str(), r.setting.wall.c_str(), r.mlups,
                  r.mlups_bare, 100.0 * r.added, r.bound_mlups, 100.0 * r.fraction_of_bound, 100.0 * r.foreign_load);
    print(line);
  });
  return {rows};
}

}  // namespace puffin::tools
