// puffin replay: the fines of a finished run with other micro-models; no flow, no carriers, seconds.

#include <CLI/CLI.hpp>
#include <chrono>
#include <nlohmann/json.hpp>

#include "cases/micromodel_file.hpp"
#include "cases/search_path.hpp"
#include "cases/write_micromodels.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/replay_record.hpp"

namespace puffin::tools {
namespace {

struct ReplayArguments {
  std::filesystem::path run, models;
  bool json = false;
};

int replay_run(const ReplayArguments& a) {
  const auto start = std::chrono::steady_clock::now();
  const micromodels::FinesModels models = cases::read_micromodels(cases::found_micromodels(a.models));
  const StoredRun run = read_stored_run(a.run);
  const coupling::Replayed replayed = coupling::replay(run.record, models);
  const auto fines = summaries(replayed, run.scalars);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (a.json) {
    nlohmann::json j{{"fines", nlohmann::json::parse(output::fines_json(fines))},
                     {"released",
                      {{"wall", replayed.to_air[0]},
                       {"particle", replayed.to_air[1]},
                       {"drag", replayed.to_air[2]},
                       {"attached", replayed.to_wall}}},
                     {"contacts", run.record.contacts.size()},
                     {"micromodels", a.models.string()},
                     {"label", cases::name(models.label)},
                     {"source", models.source},
                     {"seconds", seconds}};
    print(j.dump(2));
    return ok;
  }
  print("scalar               FFE      FFW     FFCR     FFCE   in air");
  char line[160];
  for (const auto& f : fines) {
    std::snprintf(line, sizeof line, "%-16s %8.5f %8.5f %8.5f %8.5f %8.5f", f.name.c_str(), f.FFE, f.FFW, f.FFCR,
                  f.FFCE, f.in_air);
    print(line);
  }
  std::snprintf(line, sizeof line, "fines: %.6g by walls, %.6g by carriers, %.6g by drag into the air; %.6g onto walls",
                replayed.to_air[0], replayed.to_air[1], replayed.to_air[2], replayed.to_wall);
  print(line);
  std::snprintf(line, sizeof line, "%zu contacts in %.2f s", run.record.contacts.size(), seconds);
  print(line);
  return ok;
}

}  // namespace

namespace commands {
Command replay() {
  return {"replay", "the fines of a finished run with other micro-models, without flow and carriers",
          [](CLI::App& app) -> Action {
            auto a = std::make_shared<ReplayArguments>();
            app.add_option("run", a->run, "the folder of a finished run")->required()->type_name("RUNDIR");
            app.add_option("--micromodels", a->models, "the laws to apply")->required()->type_name("FILE.toml");
            app.add_flag("--json", a->json, "one JSON object on stdout");
            return [a] { return replay_run(*a); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
