// puffin plan: what a case or a study will run, what it shares or leaves out, and why.

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cases/choices.hpp"
#include "cases/format/toml_file.hpp"
#include "cases/spelling.hpp"
#include "tools/puffin/arguments.hpp"
#include "tools/puffin/batch/jobs.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

using nlohmann::json;

struct Part {
  std::string name;
  bool runs = false;
  std::string why;
};

std::string air_of(const cases::Case& c) {
  if (c.air.model == cases::AirModel::frozen) return "a fixed field: no lattice is computed";
  return "lattice until " + as_time(c.stop.time) + ", collision " + std::string(cases::name_of(c.numerics.collision)) +
         ", walls " + std::string(cases::name_of(c.numerics.wall)) + ", eddies " +
         std::string(cases::name_of(c.numerics.les));
}

/// What a run leaves out without changing its answer, by the names that summary.json gives it, and what the case says
/// to compute all the same.
void add_skipped_work(const cases::Case& c, std::vector<Part>& parts) {
  const bool lattice = c.air.model == cases::AirModel::lbm;
  const auto unless = [&](const char* key, bool skip, const char* name, const char* why) {
    parts.push_back({name, !skip, skip ? std::string(why) : std::string("numerics.skip.") + key + " is false"});
  };
  if (lattice) {
    parts.push_back({"solid cells of the bounding box", false, "only cells that hold air are stored"});
    if (c.numerics.time_step == cases::TimeStepRule::follow_ramp)
      parts.push_back({"air steps by following the ramp", false,
                       "while the air is slower than at its fastest, the step is longer (numerics.time_step)"});
  }
  if (c.carriers) {
    unless("sleeping_carriers", c.numerics.skip.sleeping_carriers, "steps of sleeping carriers",
           "carriers at rest are not moved until something disturbs them");
    unless("free_flight", c.numerics.skip.free_flight, "contact steps of carriers in free flight",
           "what touches nothing is moved in closed form");
    if (lattice)
      unless("resting_exchange", c.numerics.skip.resting_exchange, "exchanges with the air while every carrier sleeps",
             "then there are fewer of them");
  }
  if (!c.fines || c.fines->scalars.empty() || c.air.model == cases::AirModel::none) return;
  unless("idle_transport", c.numerics.skip.idle_transport, "transport of fines while next to none are airborne",
         "a scalar of which next to nothing is airborne rests where it is");
  unless("empty_cells", c.numerics.skip.empty_cells, "transport in cells without fines",
         "only where fines are and next to it");
  unless("transport_steps", c.numerics.skip.transport_steps, "transport in every air step",
         "it takes longer steps of its own");
}

std::vector<Part> parts_of(const cases::Case& c) {
  std::vector<Part> parts;
  const bool lattice = c.air.model == cases::AirModel::lbm;
  parts.push_back({"air", c.air.model != cases::AirModel::none,
                   c.air.model == cases::AirModel::none ? "air.model is \"none\"" : air_of(c)});
  if (!c.carriers) {
    parts.push_back({"carriers", false, "the case has no [carriers]"});
  } else {
    const cases::Carriers& k = *c.carriers;
    parts.push_back({"carriers", true,
                     std::to_string(k.count / k.parcel) + (k.parcel > 1 ? " parcels" : " carriers") +
                         (k.start > 0.0 ? ", held until " + as_time(k.start) : "")});
    parts.push_back({"rotation", k.rotation, k.rotation ? "carriers spin" : "carriers.rotation is false"});
    parts.push_back({"reaction on the air", lattice && k.two_way,
                     !lattice    ? "there is no lattice to act on"
                     : k.two_way ? "carriers.two_way"
                                 : "carriers.two_way is false"});
    const bool sticky = k.adhesion.model != cases::AdhesionModel::none;
    parts.push_back({"adhesion", sticky,
                     sticky ? std::string(cases::name_of(k.adhesion.model)) + ", " +
                                  four_digits(1e3 * k.adhesion.surface_energy) + " mJ/m^2"
                            : "carriers.adhesion.model is \"none\""});
  }
  if (!c.fines) {
    parts.push_back({"fines", false, "the case has no [fines]"});
    return parts;
  }
  parts.push_back({"micro-models", !c.fines->micromodels.empty(),
                   c.fines->micromodels.empty() ? "fines.micromodels is not given" : c.fines->micromodels});
  for (const cases::Scalar& s : c.fines->scalars)
    parts.push_back({"scalar " + s.name, true, "transported once something is airborne"});
  return parts;
}

int plan_study(const CaseArguments& a);
bool is_study(const std::filesystem::path& file);

int plan(const CaseArguments& a) {
  if (is_study(a.file)) return plan_study(a);
  const cases::Case c = a.read();
  std::vector<Part> parts = parts_of(c);
  add_skipped_work(c, parts);
  if (a.json) {
    json j{{"name", c.name}, {"runs", json::array()}, {"skipped", json::array()}, {"shared", json::array()}};
    for (const Part& p : parts) j[p.runs ? "runs" : "skipped"].push_back({{"name", p.name}, {"why", p.why}});
    print(j.dump(2));
    return ok;
  }
  print(c.name + ":");
  for (const Part& p : parts) print((p.runs ? "  runs     " : "  skipped  ") + p.name + ": " + p.why);
  return ok;
}

bool is_study(const std::filesystem::path& file) {
  return cases::format::describes_study(cases::format::parse_toml(cases::format::read_text(file), file.string()));
}

int plan_study(const CaseArguments& a) {
  if (!a.sets.empty()) throw UsageError("--set: a study says itself what it sets");
  const cases::Study study = cases::read_study(a.file);
  const Jobs plan = plan_jobs(study, a.preset);
  json j{{"name", study.file.stem().string()},
         {"runs", json::array()},
         {"skipped", json::array()},
         {"shared", json::array()}};
  bool bad = false;
  for (const Job& job : plan.jobs) {
    std::vector<std::string> names;
    for (const Member& m : job.members) names.push_back(study.cases[m.which].name);
    json sets = json::object();
    for (const cases::Override& o : job.sets) sets[o.key] = o.value;
    j["runs"].push_back({{"name", job.id},
                         {"cases", names},
                         {"base", job.base.string()},
                         {"set", sets},
                         {"problem", job.problem},
                         {"why", ""}});
    if (!a.json) {
      print("  runs     " + job.id + (names.size() > 1 ? ": " + cases::join(names) : ""));
      for (const cases::Override& o : job.sets)
        if (o.key != "name") print("             " + o.key + " = " + o.value);
    }
    if (!job.problem.empty() && !a.json) print("  INVALID  " + job.problem);
    bad = bad || !job.problem.empty();
  }
  for (const Sharing& s : plan.sharings) {
    j[s.done ? "shared" : "skipped"].push_back({{"name", s.name}, {"why", s.what}, {"error", s.error}});
    if (!a.json)
      print((s.done ? "  shared   " : "  apart    ") + s.name + ": " + s.what +
            (s.error.empty() ? "" : "; " + s.error));
  }
  for (const std::string& text : plan.warnings) log_warning(text);
  j["warnings"] = plan.warnings;
  if (a.json) print(j.dump(2, ' ', false, json::error_handler_t::replace));
  return bad ? case_invalid : ok;
}

}  // namespace

namespace commands {
Command plan() {
  return {"plan", "what a case or a study will run, what it shares or leaves out, and why",
          [](CLI::App& app) -> Action {
            auto a = std::make_shared<CaseArguments>();
            a->add_to(app);
            return [a] { return puffin::tools::plan(*a); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
