#include "tools/puffin/history.hpp"

#include <array>

#include "coupling/fines.hpp"

namespace puffin::tools {

namespace {

/// Of the fines loaded, one scalar of the case: FFE, FFW, FFCR, FFCE, in the air, what the books are off by.
std::array<double, 6> fates_of(const cases::Simulation& s, int set) {
  const coupling::Ledger l = coupling::ledger(s.state.fines, s.state.scalars, s.state.budget, set);
  return {l.FFE(), l.FFW(), l.FFCR(), l.FFCE(), l.air_fraction(), l.error()};
}

}  // namespace

output::HistoryRow history_row(const cases::Simulation& s, const DropReader& drops) {
  output::HistoryRow row;
  const coupling::State& state = s.state;
  row.time = state.time;
  row.dt = state.scale.dt;
  const DropReading drop = drops.read(s);
  row.flow_rate = drop.flow_rate;
  row.static_drop = drop.static_drop;
  row.total_to_static_drop = drop.total_to_static_drop;
  const auto& c = state.carriers.carriers;
  for (std::size_t p = 0; p < c.size(); ++p) {
    row.carriers_in += c.carriers[p];
    if (c.rest[p] == dem::Rest::asleep) row.carriers_asleep += c.carriers[p];
  }
  for (const auto& d : state.departures) row.carriers_emitted += d.carriers;
  if (state.scalars.scalars() > 0) {
    const auto [ffe, ffw, ffcr, ffce, in_air, error] = fates_of(s, 0);
    row.FFE = ffe;
    row.FFW = ffw;
    row.FFCR = ffcr;
    row.FFCE = ffce;
    row.in_air = in_air;
    row.ledger_error = error;
  }
  return row;
}

std::vector<std::string> scalar_names(const cases::Simulation& s) {
  std::vector<std::string> names;
  if (s.state.scalars.scalars() > 0)
    for (const auto& scalar : s.description.fines->scalars) names.push_back(scalar.name);
  return names;
}

std::vector<double> fates_of_scalars(const cases::Simulation& s) {
  std::vector<double> all;
  for (std::size_t k = 0; k < scalar_names(s).size(); ++k) {
    const auto fates = fates_of(s, static_cast<int>(k));
    all.insert(all.end(), fates.begin(), fates.end());
  }
  return all;
}

std::vector<output::StatsColumn> stats_columns(const std::vector<std::string>& scalars) {
  std::vector<output::StatsColumn> columns;
  for (std::size_t k = 0; k < output::history_columns().size(); ++k)
    columns.push_back({output::history_columns()[k], output::history_units()[k]});
  columns.push_back({"kinetic_energy", "m^2/s^2"});
  for (const char* of : {"air_momentum_", "carrier_momentum_"})
    for (const char* axis : {"x", "y", "z"}) columns.push_back({std::string(of) + axis, "kg m/s"});
  for (const std::string& scalar : scalars)
    for (const char* fate : {"FFE_", "FFW_", "FFCR_", "FFCE_", "in_air_", "ledger_error_"})
      columns.push_back({fate + scalar, "1"});
  return columns;
}

}  // namespace puffin::tools
