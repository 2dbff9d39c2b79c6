// puffin bench scaling: cost as the work grows, each size a run in a process of its own; log-log fits.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>

#include "cases/generators/generators.hpp"
#include "cases/search_path.hpp"
#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/geometry/voxelize.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/report/scatter.hpp"
#include "tools/output/report/svg.hpp"
#include "tools/puffin/bench/benches.hpp"
#include "tools/puffin/bench/child_run.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/signals.hpp"

namespace puffin::tools {
namespace {

using nlohmann::json;
namespace geometry = lbm::geometry;

/// One size of one kind of work.
struct ScalingRow {
  std::string work;      // cells | voxels | carriers | scalars | triangles
  double size = 0.0;     // how many
  double seconds = 0.0;  // for the work named in `unit`
  std::string unit;
  double memory_peak = 0.0;  // [byte] of the process; 0: not measured
  double foreign_load = 0.0;
  double exponent = 0.0;  // of the fit over all sizes of this work from `fit_from` on
};

double number(const cases::RunOutput& o, const std::string& key) {
  const auto found = o.numbers.find(key);
  return found == o.numbers.end() ? 0.0 : found->second;
}

/// Slope of log(seconds) over log(size) by least squares, over the sizes of the upper half of the decades: below, what
/// costs the same whatever the size hides the growth.
double fitted_exponent(const std::vector<ScalingRow>& rows) {
  const double top = std::log(rows.back().size), middle = 0.5 * (top + std::log(rows.front().size)) - 1e-9;
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const ScalingRow& r : rows) {
    const double x = std::log(r.size), y = std::log(r.seconds);
    if (x < middle) continue;
    n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

class ScalingBench {
 public:
  explicit ScalingBench(const BenchArguments& a) : a_(a), place_("puffin-bench") {}

  BenchRows rows() {
    const Signals signals;
    if (!a_.json) print("work           size     seconds  of");
    try {
      cells();
      carriers();
      scalars();
      triangles();
    } catch (const BenchStopped&) {
    }
    if (!a_.out.empty() && !all_.empty()) figure();
    json list = json::array();
    for (const ScalingRow& r : all_)
      list.push_back({{"work", r.work},
                      {"size", r.size},
                      {"seconds", r.seconds},
                      {"unit", r.unit},
                      {"exponent", r.exponent},
                      {"memory_peak", r.memory_peak},
                      {"foreign_load", r.foreign_load}});
    return {list, Signals::code()};
  }

 private:
  std::filesystem::path scene(const std::string& name) const { return cases::bench_directory() / "scaling" / name; }

  ChildRun child(const std::string& name, const std::vector<cases::Override>& sets) {
    ChildRun run = run_child(scene(name), sets, place_.fresh());
    if (!run.output) throw std::runtime_error("bench scaling, " + name + ": " + run.problem);
    return run;
  }

  /// Adds the sizes of one kind of work with their common exponent.
  void add(std::vector<ScalingRow> rows) {
    const double exponent = fitted_exponent(rows);
    for (ScalingRow& r : rows) {
      r.exponent = exponent;
      if (!a_.json) {
        char line[120];
        std::snprintf(line, sizeof line, "%-10s %9.3g  %10.4g  %s", r.work.c_str(), r.size, r.seconds, r.unit.c_str());
        print(line);
      }
      all_.push_back(r);
    }
    if (a_.json) return;
    char line[80];
    std::snprintf(line, sizeof line, "           cost ~ size^%.2f", exponent);
    print(line);
  }

  /// The air of the L-bend: seconds a step, and seconds to find the cells and lay them out.
  void cells() {
    std::vector<ScalingRow> step, set_up;
    for (const double n :
         a_.quick ? std::vector<double>{5e4, 2e5, 8e5} : std::vector<double>{5e4, 2e5, 1e6, 4e6, 16e6}) {
      // The step is lattice_speed dx / U with dx = cbrt(V/n), V about 2750 mm^3: as many steps as take about a second.
      const double dx = std::cbrt(2.75e-6 / n), steps = std::clamp(3e7 / n, 12.0, 400.0);
      const ChildRun run = child("flow.toml", {{"numerics.cells", std::to_string(std::llround(n))},
                                               {"stop.time", std::to_string(steps * 0.1 * dx / 57.14) + " s"}});
      const cases::RunOutput& o = *run.output;
      const double of_air = number(o, "phases.air") + number(o, "phases.walls and openings");
      step.push_back({"cells", number(o, "cells_fluid"), of_air / number(o, "steps"), "an air step",
                      number(o, "memory_peak"), run.foreign_load, 0.0});
      set_up.push_back({"voxels", number(o, "cells_fluid"), number(o, "phases.set-up"), "set-up from the surface",
                        number(o, "memory_peak"), run.foreign_load, 0.0});
    }
    add(step);
    add(set_up);
  }

  /// Carriers that fall on each other in a box without air: seconds of 60 steps of 5 us.
  void carriers() {
    std::vector<ScalingRow> rows;
    for (const double n :
         a_.quick ? std::vector<double>{1e2, 1e3, 1e4} : std::vector<double>{1e2, 1e3, 1e4, 1e5, 1e6}) {
      const double edge = 84e-6 * std::ceil(std::cbrt(n)) * 1.2;
      const std::string length = std::to_string(1e3 * edge) + " mm";
      const ChildRun run = child("carriers.toml", {{"carriers.count", std::to_string(std::llround(n))},
                                                   {"geometry.box.x", length},
                                                   {"geometry.box.y", length},
                                                   {"geometry.box.z", length}});
      rows.push_back({"carriers", n, number(*run.output, "phases.carriers"), "60 steps of 5 us",
                      number(*run.output, "memory_peak"), run.foreign_load, 0.0});
    }
    add(rows);
  }

  /// Clouds in uniform air: seconds of the transport.
  void scalars() {
    std::vector<ScalingRow> rows;
    for (const int n : a_.quick ? std::vector<int>{1, 4, 8} : std::vector<int>{1, 2, 4, 8, 16, 32}) {
      std::string list;
      for (int k = 0; k < n; ++k)
        list += std::string(k > 0 ? ", " : "") + "{ name = \"s" + std::to_string(k) +
                "\", diffusion = \"1e-6 kg/(m s)\", initial = { shape = \"gaussian\", center = [5e-4, 5e-4, 5e-4], "
                "sigma = 1e-4, amount = 1e6 } }";
      const ChildRun run = child("scalars.toml", {{"fines.scalar", "[" + list + "]"}});
      rows.push_back({"scalars", static_cast<double>(n), number(*run.output, "phases.transport"),
                      "1 ms in 125000 cells", number(*run.output, "memory_peak"), run.foreign_load, 0.0});
    }
    add(rows);
  }

  /// A pipe of ever finer facets into cells 1/50 of its diameter: seconds for tree and cells.
  void triangles() {
    std::vector<ScalingRow> rows;
    for (const double facet :
         a_.quick ? std::vector<double>{1.0, 0.33, 0.1} : std::vector<double>{1.0, 0.33, 0.1, 0.04}) {
      const auto mesh = std::make_shared<const geometry::TriangleMesh>(
          cases::generate("pipe", {{"diameter", 10.0}, {"length", 20.0}, {"facet_size", facet}}));
      const auto start = std::chrono::steady_clock::now();
      const geometry::TriangleTree tree(mesh);
      const auto voxels = geometry::voxelize(tree, 0.2);
      rows.push_back({"triangles", static_cast<double>(mesh->triangles.size()),
                      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                      "tree and 200000 cells", 0.0, 0.0, 0.0});
      if (Signals::received() != 0) throw BenchStopped{};
    }
    add(rows);
  }

  void figure() const {
    output::ScatterChart chart;
    chart.title = "Cost as the work grows";
    chart.x_label = "size";
    chart.y_label = "seconds";
    std::map<std::string, output::ScatterSeries> series;
    for (const ScalingRow& r : all_) {
      auto& s = series[r.work];
      char name[60];
      std::snprintf(name, sizeof name, "%s ^%.2f", r.work.c_str(), r.exponent);
      s.name = name;
      s.joined = true;
      s.points.push_back({r.size, r.seconds, {}, {}, "", false});
    }
    for (const auto& [work, s] : series) chart.series.push_back(s);
    output::write_whole(std::filesystem::path(a_.out) / "scaling.svg",
                        output::svg::standalone(output::scatter_chart(chart)));
  }

  const BenchArguments& a_;
  TemporaryFolder place_;
  std::vector<ScalingRow> all_;
};

}  // namespace

BenchRows bench_scaling(const BenchArguments& a) { return ScalingBench(a).rows(); }

}  // namespace puffin::tools
