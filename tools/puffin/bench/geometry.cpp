// puffin bench geometry: from an STL file to cells, and queries of the surface beside those of VTK.

#include "tools/bench/geometry_bench.hpp"
#include "tools/puffin/bench/benches.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {
namespace {

using nlohmann::json;

json row_json(const bench::GeometryRow& r) {
  return {{"what", r.what},
          {"where", r.where},
          {"triangles", r.triangles},
          {"count", r.count},
          {"threads", r.threads},
          {"seconds", r.seconds},
          {"per_second", r.per_second},
          {"vtk_per_second", r.vtk_per_second},
          {"ratio_to_vtk", r.ratio},
          {"difference_cells", r.difference},
          {"other_side", r.other_side},
          {"peak_memory", r.memory},
          {"foreign_load", r.foreign_load}};
}

}  // namespace

BenchRows bench_geometry(const BenchArguments& a) {
  json rows = json::array();
  if (!a.json)
    print(
        "what                  where triangles     count thr  seconds    per second   VTK/s  ratio   memory  foreign");
  bench::geometry_benchmark(a.quick, [&](const bench::GeometryRow& r) {
    rows.push_back(row_json(r));
    if (a.json) return;
    char line[220];
    std::snprintf(line, sizeof line, "%-21s %-5s %9lld %9lld %3d %8.3f %13.0f %7.0f %6.1f %5.0f MB  %4.0f %%",
                  r.what.c_str(), r.where.c_str(), r.triangles, r.count, r.threads, r.seconds, r.per_second,
                  r.vtk_per_second, r.ratio, 1e-6 * r.memory, 100.0 * r.foreign_load);
    print(line);
    if (r.ratio > 0.0) {
      std::snprintf(line, sizeof line, "%44s largest difference to VTK %.2g cells, %lld points on another side", "",
                    r.difference, r.other_side);
      print(line);
    }
  });
  return {rows};
}

}  // namespace puffin::tools
