#include "tools/puffin/replay_record.hpp"

#include <algorithm>

#include "tools/output/events_file.hpp"
#include "tools/output/output_error.hpp"
#include "tools/puffin/sound_record.hpp"
#include "tools/puffin/summarize.hpp"

namespace puffin::tools {
namespace {

using output::ReplayTables;

void add_carriers(const coupling::Fines& fines, ReplayTables& tables) {
  constexpr int classes = coupling::SlipHistory::classes;
  for (std::size_t id = 0; id < fines.initial.size(); ++id) {
    tables.carriers.push_back(
        {fines.initial[id], fines.slip.asked[id], static_cast<std::int32_t>(id), fines.emitted[id]});
    for (int k = 0; k < classes; ++k)
      if (const std::size_t at = id * classes + static_cast<std::size_t>(k); fines.slip.seconds[at] > 0.0)
        tables.slip.push_back({fines.slip.seconds[at], fines.slip.metres[at], static_cast<std::int32_t>(id),
                               static_cast<std::int32_t>(k)});
  }
}

/// Fines in the air that no carrier lost: there at the start, or brought in through an opening. Nothing tells them
/// later from those that were released.
bool air_had_others(const coupling::Fines& fines, const lbm::ScalarBudget& budget) {
  const auto some = [](const lbm::CompensatedSum& sum) { return sum.value() != 0.0; };
  return std::any_of(fines.placed.begin(), fines.placed.end(), [](double placed) { return placed != 0.0; }) ||
         std::any_of(budget.entered.begin(), budget.entered.end(),
                     [&](const auto& patches) { return std::any_of(patches.begin(), patches.end(), some); });
}

}  // namespace

std::optional<ReplayTables> replay_tables(const cases::Simulation& s) {
  if (!s.models.fines || s.state.scalars.scalars() == 0) return {};
  if (s.models.regain) return {};  // what comes back depends on the concentrations on the way
  if (air_had_others(s.state.fines, s.state.budget)) return {};
  ReplayTables tables;
  tables.end = s.state.time;
  add_carriers(s.state.fines, tables);
  const int sets = s.state.scalars.scalars() / coupling::mechanisms;
  for (int set = 0; set < sets; ++set) {
    tables.scalars.push_back(s.description.fines->scalars.at(static_cast<std::size_t>(set)).name);
    const coupling::Ledger ledger = coupling::ledger(s.state.fines, s.state.scalars, s.state.budget, set);
    for (int m = 0; m < coupling::mechanisms; ++m) {
      const auto& share = ledger.by_mechanism[m];
      const int scalar = coupling::scalar_index(set, static_cast<coupling::Mechanism>(m));
      tables.air.push_back(
          {share.released, share.in_air, share.emitted, lbm::absorbed(s.state.budget, scalar), set, m});
    }
  }
  if (s.models.fines->drag_detach) tables.rates = coupling::sample_rates(*s.models.fines->drag_detach);
  return tables;
}

StoredRun read_stored_run(const std::filesystem::path& folder) {
  const auto file = folder / "events.h5";
  if (!std::filesystem::exists(file)) {
    const bool is_run = std::filesystem::exists(folder / "status.json");
    throw output::OutputError(
        "cannot read " + file.string() +
        (is_run ? ": the run has written no contacts; run it to its end, with output.events = true, to replay it"
                : "; is this the folder of a run?"));
  }
  const ReplayTables tables = output::read_replay_tables(file);
  std::vector<output::EventRecord> events = output::read_events(file);
  demand_sound(file, tables, events);
  std::sort(events.begin(), events.end(), [](const auto& x, const auto& y) { return x.order < y.order; });
  StoredRun run;
  run.scalars = tables.scalars;
  coupling::FinesRecord& r = run.record;
  r.end = tables.end;
  r.rates = tables.rates;
  for (const auto& e : events)
    r.contacts.push_back({e.a, e.b, e.time_start, e.normal_speed, e.tangential_speed, e.angle, e.a_loses != 0,
                          e.b_loses != 0, e.drag_a, e.drag_b});
  r.carriers.resize(tables.carriers.size());
  for (const auto& c : tables.carriers) r.carriers[c.id] = {c.initial, c.emitted != 0, c.drag_rest};
  for (const auto& s : tables.slip) r.slip.push_back({s.carrier, s.slip_class, s.seconds, s.metres});
  r.sets.resize(tables.scalars.size());
  for (const auto& a : tables.air) r.sets[a.set][a.mechanism] = {a.released, a.in_air, a.emitted, a.deposited};
  return run;
}

std::vector<output::FinesSummary> summaries(const coupling::Replayed& replayed,
                                            const std::vector<std::string>& scalars) {
  std::vector<output::FinesSummary> all;
  for (std::size_t k = 0; k < replayed.sets.size(); ++k)
    all.push_back(fines_summary(scalars.at(k), replayed.sets[k], replayed.to_air, replayed.to_wall));
  return all;
}

}  // namespace puffin::tools
