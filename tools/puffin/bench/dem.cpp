// puffin bench dem: carriers a second, beside LIGGGHTS where that is installed.

#include "tools/bench/dem_bench.hpp"

#include "tools/puffin/bench/benches.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {
namespace {

using nlohmann::json;

json row_json(const bench::DemRow& r) {
  return {{"scene", r.setting.scene},
          {"carriers", r.setting.carriers},
          {"threads", r.setting.threads},
          {"particle_steps_per_second", r.particle_steps_per_second},
          {"liggghts_particle_steps_per_second", r.liggghts_particle_steps_per_second},
          {"ratio", r.ratio},
          {"substeps_per_second", r.substeps_per_second},
          {"contacts_per_second", r.contacts_per_second},
          {"contacts_per_carrier", r.contacts_per_carrier},
          {"nanoseconds_per_carrier", r.nanoseconds_per_carrier},
          {"foreign_load", r.foreign_load},
          {"seconds", r.seconds}};
}

}  // namespace

BenchRows bench_dem(const BenchArguments& a) {
  json rows = json::array();
  const std::vector<std::int64_t> sizes(a.carriers.begin(), a.carriers.end());
  if (!a.json) print("scene   carriers thr  million/s  LIGGGHTS  ratio  contacts/s  a carrier  ns a carrier  foreign");
  bench::dem_benchmark(a.quick, sizes, [&](const bench::DemRow& r) {
    rows.push_back(row_json(r));
    if (a.json) return;
    char line[200];
    std::snprintf(line, sizeof line, "%-8s %7lld %3d %10.2f %9.2f %6.2f %11.3g %10.2f %13.1f  %4.0f %%",
                  r.setting.scene.c_str(), static_cast<long long>(r.setting.carriers), r.setting.threads,
                  1e-6 * r.particle_steps_per_second, 1e-6 * r.liggghts_particle_steps_per_second, r.ratio,
                  r.contacts_per_second, r.contacts_per_carrier, r.nanoseconds_per_carrier, 100.0 * r.foreign_load);
    print(line);
  });
  return {rows};
}

}  // namespace puffin::tools
