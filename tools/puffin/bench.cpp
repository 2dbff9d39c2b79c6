// puffin bench: speed, error and scaling of this build on this machine.

#include "tools/puffin/bench/benches.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tools/bench/machine.hpp"
#include "tools/puffin/build_info.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {

using nlohmann::json;

std::span<const Bench> benches() {
  static constexpr std::array list{
      Bench{"geometry", "STL to cells, distances beside VTK's", &bench_geometry},
      Bench{"kernel", "the air alone, beside the memory's bound", &bench_kernel},
      Bench{"stability", "what runs, is healed or diverges, over settings and speeds", &bench_stability},
      Bench{"dem", "carriers, beside LIGGGHTS where that is installed", &bench_dem},
      Bench{"pareto", "run time against error over many settings", &bench_pareto},
      Bench{"skip", "what is left out, put back in: time and change of the answer", &bench_skip},
      Bench{"scaling", "cost as cells, carriers, scalars and triangles grow", &bench_scaling},
  };
  return list;
}

namespace {

/// A field of a CSV file: in quotes where it holds a comma, a quote or a line's end; a number that is none as `nan`.
std::string field(const json& value) {
  if (value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()))) return "nan";
  if (!value.is_string()) return value.dump();
  const std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

void write_rows(const json& rows, const std::string& file) {
  std::ofstream out(file);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string header, line;
    for (const auto& [key, value] : rows[r].items()) {
      header += "," + key;
      line += "," + field(value);
    }
    if (r == 0) out << header.substr(1) << '\n';  // less the first comma
    out << line.substr(1) << '\n';
  }
  out.flush();
  if (!out) throw std::runtime_error("cannot write " + file);
}

namespace {

json machine_json() {
  const bench::Machine m = bench::describe_machine(build_info().commit);
  return {{"processor", m.processor}, {"isa", m.isa}, {"cores", m.cores}, {"commit", m.commit}};
}

int bench(const BenchArguments& a) {
  const auto found = std::find_if(benches().begin(), benches().end(), [&](const Bench& b) { return a.name == b.name; });
  if (!a.out.empty()) std::filesystem::create_directories(a.out);
  const auto [rows, code] = found->rows(a);
  const json result{{"machine", machine_json()}, {"rows", rows}};
  if (!a.out.empty()) {
    const std::filesystem::path folder(a.out);
    write_rows(rows, (folder / (a.name + ".csv")).string());
    std::ofstream(folder / (a.name + ".json")) << result.dump(2) << '\n';
  }
  if (a.json) print(result.dump(2));
  return code;
}

}  // namespace

namespace commands {
Command bench() {
  return {"bench", "speed, error and scaling of this build on this machine", [](CLI::App& app) -> Action {
            auto a = std::make_shared<BenchArguments>();
            std::vector<std::string> names;
            std::string what;
            for (const Bench& b : benches()) {
              names.emplace_back(b.name);
              what += (what.empty() ? "" : "; ") + std::string(b.name) + ": " + b.what;
            }
            app.add_option("name", a->name, what)->required()->check(CLI::IsMember(names));
            app.add_flag("--quick", a->quick, "a smaller set, in a minute or two");
            app.add_option("--cells", a->cells, "kernel: numbers of cells instead of the usual ones")
                ->check(CLI::Range(1e3, 4e9));
            app.add_option("--carriers", a->carriers, "dem: numbers of carriers instead of the usual ones")
                ->check(CLI::Range(1.0, 1e9));
            app.add_option("--only", a->only,
                           "pareto: this case alone, like P9; stability, skip: this scene; may be repeated")
                ->type_name("ID");
            app.add_option("--catalogue", a->catalogue,
                           "pareto: a folder of cases with pareto.toml, instead of Puffin's own")
                ->type_name("DIR");
            app.add_flag("--processor-time", a->processor_time,
                         "pareto: weigh processor time against the error, not run time: for a machine with other work");
            app.add_option("--repeats", a->repeats, "skip: rounds of interleaved runs instead of 3 (--quick: 1)")
                ->check(CLI::Range(1, 99));
            app.add_option("--out", a->out, "a folder for the rows as CSV and JSON, and for figures");
            app.add_flag("--json", a->json, "one JSON object on stdout");
            return [a] { return puffin::tools::bench(*a); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
