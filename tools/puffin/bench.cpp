// puffin bench: speed, error and scaling of this build on this machine.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tools/bench/kernel_bench.hpp"
#include "tools/bench/machine.hpp"
#include "tools/puffin/build_info.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

using nlohmann::json;

struct BenchArguments {
  std::string name;
  bool quick = false, json = false;
  std::vector<double> cells;
  std::string out;
};

json machine_json() {
  const bench::Machine m = bench::describe_machine(build_info().commit);
  return {{"processor", m.processor}, {"isa", m.isa}, {"cores", m.cores}, {"commit", m.commit}};
}

json row_json(const bench::KernelRow& r) {
  return {{"scene", r.setting.scene},
          {"cells", r.cells},
          {"threads", r.setting.threads},
          {"collision", r.setting.collision},
          {"precision", r.setting.precision},
          {"wall", r.setting.wall},
          {"mlups", r.mlups},
          {"bound_mlups", r.bound_mlups},
          {"fraction_of_bound", r.fraction_of_bound},
          {"mlups_bare", r.mlups_bare},
          {"copy_gb_per_s", 1e-9 * r.copy_bandwidth},
          {"bound_over_copy", r.bound_over_copy},
          {"foreign_load", r.foreign_load},
          {"seconds", r.seconds}};
}

/// One CSV with the names of the rows' fields as its header; strings hold no commas.
void write_csv(const json& rows, const std::filesystem::path& file) {
  std::ofstream out(file);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string header, line;
    for (const auto& [key, value] : rows[r].items()) {
      header += (header.empty() ? "" : ",") + key;
      line += (line.empty() ? "" : ",") + (value.is_string() ? value.get<std::string>() : value.dump());
    }
    if (r == 0) out << header << '\n';
    out << line << '\n';
  }
  out.flush();
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

int bench_kernel(const BenchArguments& a) {
  json rows = json::array();
  if (!a.json) print("scene     cells     thr collision precision wall       MLUPS   bare  bound  share  foreign");
  bench::kernel_benchmark(a.quick, a.cells, [&](const bench::KernelRow& r) {
    rows.push_back(row_json(r));
    if (a.json) return;
    char line[200];
    std::snprintf(line, sizeof line, "%-8s %9lld %3d  %-9s %-9s %-8s %7.1f %6.1f %6.1f  %4.0f %%  %4.0f %%",
                  r.setting.scene.c_str(), static_cast<long long>(r.cells), r.setting.threads,
                  r.setting.collision.c_str(), r.setting.precision.c_str(), r.setting.wall.c_str(), r.mlups,
                  r.mlups_bare, r.bound_mlups, 100.0 * r.fraction_of_bound, 100.0 * r.foreign_load);
    print(line);
  });
  const json result{{"machine", machine_json()}, {"rows", rows}};
  if (!a.out.empty()) {
    std::filesystem::create_directories(a.out);
    write_csv(rows, std::filesystem::path(a.out) / "kernel.csv");
    std::ofstream(std::filesystem::path(a.out) / "kernel.json") << result.dump(2) << '\n';
  }
  if (a.json) print(result.dump(2));
  return ok;
}

}  // namespace

namespace commands {
Command bench() {
  return {
      "bench", "speed of this build on this machine: kernel", [](CLI::App& app) -> Action {
        auto a = std::make_shared<BenchArguments>();
        app.add_option("name", a->name, "kernel")->required()->check(CLI::IsMember({"kernel"}));
        app.add_flag("--quick", a->quick, "a smaller set, in a minute");
        app.add_option("--cells", a->cells, "numbers of cells instead of the usual ones")->check(CLI::PositiveNumber);
        app.add_option("--out", a->out, "a folder for the rows as CSV and JSON");
        app.add_flag("--json", a->json, "one JSON object on stdout");
        return [a] { return bench_kernel(*a); };
      }};
}
}  // namespace commands

}  // namespace puffin::tools
