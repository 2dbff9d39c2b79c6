// The list of cases that share a flow, and how they ended. Called by puffin batch for share = ["one-way-flow"].

#include "tools/puffin/together.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cases/write_case.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/commands.hpp"

namespace puffin::tools {

std::string flow_key(const cases::Case& given) {
  if (given.air.model != cases::AirModel::lbm || !given.carriers) return "";
  cases::Case c = given;
  c.name = "flow";
  c.carriers.reset();
  c.fines.reset();
  c.reference.clear();
  c.provenance.clear();
  c.output = {};
  c.stop = {};
  c.numerics.seed = 1;  // of the carriers alone, unless an inlet is turbulent
  const bool turbulent = std::any_of(c.air.boundaries.begin(), c.air.boundaries.end(),
                                     [](const cases::Boundary& b) { return b.turbulence > 0.0; });
  if (turbulent) c.numerics.seed = given.numerics.seed;
  return cases::write_resolved(c);
}

std::string why_apart(const cases::Case& flow, const cases::Case& other) {
  if (flow_key(other).empty()) return "it has no carriers in air on a lattice";
  if (other.carriers->two_way) return "carriers.two_way is true";
  if (flow_key(other) != flow_key(flow)) return "geometry, air or numerics differ";
  return "";
}

std::vector<TogetherCase> read_together(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_array() || json.empty()) throw output::OutputError(file.string() + " holds no list of cases");
  std::vector<TogetherCase> list;
  for (const auto& item : json) {
    TogetherCase one{item.value("case", ""), item.value("out", ""), {}};
    for (const auto& set : item.value("set", nlohmann::json::array()))
      one.sets.push_back(cases::parse_override(set.get<std::string>()));
    list.push_back(one);
  }
  return list;
}

std::filesystem::path ends_file(const std::filesystem::path& list) { return list.string() + ".ends"; }

std::vector<TogetherEnd> read_ends(const std::filesystem::path& list) {
  std::ifstream stream(ends_file(list));
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  std::vector<TogetherEnd> ends;
  if (!json.is_array()) return ends;
  for (const auto& item : json)
    ends.push_back({item.value("out", ""), item.value("exit_code", 0), item.value("message", "")});
  return ends;
}

void write_ends(const std::vector<TogetherEnd>& ends, const std::filesystem::path& list) {
  auto json = nlohmann::json::array();
  for (const TogetherEnd& end : ends)
    json.push_back({{"out", end.out.string()}, {"exit_code", end.code}, {"message", end.message}});
  output::write_whole(ends_file(list), json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

namespace commands {
Command together() {
  return {"together", "one flow for several cases whose carriers do not act on the air; see puffin batch",
          [](CLI::App& app) -> Action {
            auto g = std::make_shared<TogetherOptions>();
            app.add_option("list", g->list, "the list of cases, as puffin batch writes it")
                ->required()
                ->type_name("LIST.json");
            app.add_option("--preset", g->preset, "for every case")->type_name("NAME");
            app.add_option("--threads", g->threads, "0: all")->check(CLI::Range(0, 4096));
            app.add_option("--beds", g->beds, "where settled beds are kept")->type_name("DIR");
            app.add_flag("--quiet", g->quiet, "warnings only");
            return [g] { return run_together(*g); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
