#include "tools/puffin/summarize.hpp"
#include "tools/puffin/build_info.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "cases/air_assumption.hpp"
#include "cases/derived.hpp"
#include "cases/lift_off.hpp"
#include "coupling/statistics.hpp"

namespace puffin::tools {

namespace {

/// Model name of the processor, as the system calls it.
std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

output::TimeMean mean_of(const std::vector<output::HistoryRow>& history, double begin, double end,
                         double output::HistoryRow::*column) {
  std::vector<double> value, duration;
  for (std::size_t n = 1; n < history.size(); ++n)
    if (history[n].time >= begin && history[n].time <= end) {
      value.push_back(history[n].*column);
      duration.push_back(history[n].time - history[n - 1].time);
    }
  output::TimeMean result;
  if (value.empty()) return result;
  const coupling::TimeMean mean = coupling::batch_means(value, duration);
  result.mean = mean.mean;
  result.batches = mean.batches;
  if (std::isfinite(mean.half_width)) {
    result.ci_low = mean.mean - mean.half_width;
    result.ci_high = mean.mean + mean.half_width;
  }
  return result;
}

output::PressureSummary pressures(const cases::Simulation& s, const std::vector<output::HistoryRow>& history) {
  output::PressureSummary p;
  const double end = s.state.time;
  const auto window = s.description.output.pressure_window.value_or(std::array<double, 2>{0.9 * end, end});
  p.window_begin = window[0];
  p.window_end = window[1];
  p.static_drop = mean_of(history, window[0], window[1], &output::HistoryRow::static_drop);
  p.flow_rate = mean_of(history, window[0], window[1], &output::HistoryRow::flow_rate);
  p.total_to_static_drop = mean_of(history, window[0], window[1], &output::HistoryRow::total_to_static_drop);
  return p;
}

output::CarrierSummary carriers(const cases::Simulation& s) {
  output::CarrierSummary c;
  const auto& in = s.state.carriers.carriers;
  double left_inside = 0.0, left = 0.0, retained_mass = 0.0;
  for (std::size_t p = 0; p < in.size(); ++p) {
    left_inside += in.carriers[p];
    retained_mass += in.mass[p];
  }
  for (const auto& d : s.state.departures) {
    left += d.carriers;
    if (!c.first_emitted) c.first_emitted = d.time;
    c.last_emitted = d.time;
  }
  c.emitted = std::llround(left);
  c.retained = std::llround(left_inside);
  c.count = c.emitted + c.retained;
  if (c.count > 0) c.retained_fraction = static_cast<double>(c.retained) / static_cast<double>(c.count);
  c.first_motion = s.state.first_motion.time();
  const coupling::MomentumBooking& books = s.state.momentum;
  if (books.exchanged > 0.0) c.momentum_error = (books.given - books.taken).norm() / books.exchanged;
  if (s.description.carriers && s.dose_mass > 0.0) {
    // Mass still in the device: carriers, what is left on them, and what sticks to walls. A carrier's mass in the
    // dynamics is that of the loaded carrier; here the fines it lost are taken off. A fine weighs fine_mass_ratio of
    // its own carrier; on walls, where they are mixed, the mean of the dose.
    const cases::Carriers& given = *s.description.carriers;
    const double of_loaded = given.fine_mass_ratio / (1.0 + given.fines_each * given.fine_mass_ratio);
    double lost = 0.0;
    for (std::size_t p = 0; p < in.size(); ++p)
      lost += (s.state.fines.initial[in.id[p]] - s.state.fines.left[in.id[p]]) * of_loaded * in.single_mass(p);
    double on_walls = s.state.fines.to_wall.value() - s.state.fines.picked_up.value();
    if (s.description.fines &&
        s.state.scalars.scalars() > 0)  // what the air has brought there too, of the first scalar
      on_walls = coupling::ledger(s.state.fines, s.state.scalars, s.state.budget, 0).on_walls;
    const double fine = c.count > 0 ? of_loaded * s.dose_mass / static_cast<double>(c.count) : 0.0;
    c.RDF = (retained_mass - lost + on_walls * fine) / s.dose_mass;
  }
  return c;
}

std::vector<output::FinesSummary> fines(const cases::Simulation& s) {
  std::vector<output::FinesSummary> all;
  for (std::size_t k = 0; k < s.description.fines->scalars.size() && s.state.scalars.scalars() > 0; ++k) {
    const coupling::Ledger ledger =
        coupling::ledger(s.state.fines, s.state.scalars, s.state.budget, static_cast<int>(k));
    const auto& to_air = s.state.fines.to_air;
    all.push_back(fines_summary(s.description.fines->scalars[k].name, ledger,
                                {to_air[0].value(), to_air[1].value(), to_air[2].value()},
                                s.state.fines.to_wall.value()));
  }
  return all;
}

output::CollisionSummary collisions(const cases::Simulation& s) {
  output::CollisionSummary c;
  const auto& counted = s.state.collisions;
  c.wall = counted.wall;
  c.particle = counted.particle;
  c.median_per_carrier = coupling::median_contacts(counted);
  c.median_per_emitted_carrier = coupling::median_contacts(counted, s.state.fines.emitted);
  c.mean_wall_energy = coupling::mean_wall_energy(counted);
  c.mean_particle_energy = coupling::mean_particle_energy(counted);
  c.largest_overlap = s.state.carriers.statistics.largest_overlap;
  return c;
}

std::vector<output::SkippedWork> skipped(const cases::Simulation& s) {
  std::vector<output::SkippedWork> list;
  const auto& e = s.state.effort;
  if (s.state.air) {
    const double steps = static_cast<double>(s.state.air->steps);
    const double seconds_per_step = steps > 0.0 ? (e.air + e.links) / steps : 0.0;
    const double saved = e.steps_at_reference_dt - steps;
    // A followed ramp takes fewer steps than the fixed step of its fastest moment would.
    if (saved >= 1.0)
      list.push_back({"air steps by following the ramp", std::llround(saved), saved * seconds_per_step});
    const auto rows = s.state.air->rows.box();
    const double box = static_cast<double>(rows[0]) * rows[1] * rows[2];
    const double active = static_cast<double>(s.state.air->rows.active_cells());
    if (box > active)
      list.push_back({"solid cells of the bounding box", std::llround(box - active),
                      (box - active) / active * steps * seconds_per_step});
  }
  if (e.exchanges_saved > 0)
    list.push_back(
        {"exchanges with the air while every carrier sleeps", e.exchanges_saved,
         static_cast<double>(e.exchanges_saved) * (e.exchange + e.carriers) / static_cast<double>(e.exchanges)});
  const auto& d = s.state.carriers.statistics;
  if (d.sleeping_steps > 0) {
    const double moved = static_cast<double>(d.free_flights + d.contact_steps);
    list.push_back({"steps of sleeping carriers", d.sleeping_steps,
                    moved > 0.0 ? static_cast<double>(d.sleeping_steps) * e.carriers / moved : 0.0});
  }
  if (e.scalar_steps_off > 0)
    list.push_back({"transport of fines while next to none are airborne", e.scalar_steps_off,
                    e.scalar_steps > 0
                        ? static_cast<double>(e.scalar_steps_off) * e.scalars / static_cast<double>(e.scalar_steps)
                        : 0.0});
  const auto& b = s.state.budget;
  if (b.cells_skipped > 0 && b.cells_computed > 0)
    list.push_back({"transport in cells without fines", b.cells_skipped,
                    static_cast<double>(b.cells_skipped) * e.scalars / static_cast<double>(b.cells_computed)});
  return list;
}

std::vector<std::string> assumptions(const cases::Simulation& s) {
  std::vector<std::string> list;
  for (const auto& [key, source] : s.description.provenance)
    if (source.origin == cases::Origin::assumed) list.push_back(key + ": " + source.note);
  if (!s.dose.empty()) list.push_back("dose: " + s.dose);
  if (s.models.fines) list.push_back("micro-models: " + s.models.fines->source);
  if (s.description.carriers && s.description.carriers->parcel > 1)
    list.push_back("parcels: " + cases::parcel_bias(*s.description.carriers, s.models));
  if (std::string air = cases::air_assumption(s.description); !air.empty()) list.push_back(std::move(air));
  return list;
}

void add_reference(const cases::Simulation& s, output::Summary& summary) {
  std::vector<output::ReferenceValue> given;
  for (const auto& [name, value] : s.description.reference) {
    if (const auto* number = std::get_if<double>(&value)) given.push_back({name, *number, {}, {}});
    const auto* list = std::get_if<std::vector<double>>(&value);  // value, lowest, highest
    if (list && list->size() == 3) given.push_back({name, (*list)[0], (*list)[1], (*list)[2]});
  }
  output::compare_with_reference(summary, given);
}

}  // namespace

output::FinesSummary fines_summary(const std::string& name, const coupling::Ledger& ledger,
                                   const std::array<double, 3>& to_air, double to_wall) {
  output::FinesSummary f;
  f.name = name;
  f.FFE = ledger.FFE();
  f.FFW = ledger.FFW();
  f.FFCR = ledger.FFCR();
  f.FFCE = ledger.FFCE();
  f.in_air = ledger.air_fraction();
  f.ledger_error = ledger.error();
  const double wall = to_air[0] + to_wall, particle = to_air[1], drag = to_air[2];
  if (const double sum = wall + particle + drag; sum > 0.0) f.by_mechanism = {wall / sum, particle / sum, drag / sum};
  return f;
}

output::Summary summarize(const cases::Simulation& s, const Recorder& recorder, const RunFacts& facts) {
  output::Summary r;
  r.name = s.description.name;
  r.version = build_info().version + " (" + build_info().commit + ")";
  r.state = facts.state;
  r.message = facts.message;
  r.until = facts.until;
  r.preset = facts.preset;
  r.stop_time = s.description.stop.time;
  r.case_stop_time = facts.case_stop_time;
  r.warnings = facts.warnings;
  r.simulated_time = s.state.time;
  r.wall_clock = facts.wall_clock;
  r.threads = facts.threads;
  r.host = processor() + ", " + lbm::name(lbm::detect_isa());
  r.dx = s.dx;
  r.memory_peak = peak_memory();
  const auto& e = s.state.effort;
  r.phases = {{"set-up", facts.set_up}, {"air", e.air},     {"walls and openings", e.links}, {"exchange", e.exchange},
              {"carriers", e.carriers}, {"fines", e.fines}, {"transport", e.scalars},        {"output", facts.output}};
  double named = 0.0;
  for (const auto& p : r.phases) named += p.seconds;
  r.phases.push_back({"other", std::max(0.0, facts.wall_clock - named)});
  r.skipped = skipped(s);
  if (s.state.air) {
    const auto& air = *s.state.air;
    r.cells_fluid = static_cast<std::int64_t>(air.fluid_cells);
    r.cells_active = static_cast<std::int64_t>(air.rows.active_cells());
    r.steps = air.steps;
    const double seconds = e.air + e.links;
    r.mlups = seconds > 0.0 ? 1e-6 * static_cast<double>(r.cells_fluid) * static_cast<double>(r.steps) / seconds : 0.0;
    r.mlups_active =
        r.mlups * static_cast<double>(r.cells_active) / static_cast<double>(std::max<std::int64_t>(1, r.cells_fluid));
    const bool moved = s.state.extremes.max_dt > 0.0;  // the lattice of a frozen field only carries fines
    r.dt_min = moved ? s.state.extremes.min_dt : s.state.scale.dt;
    r.dt_max = moved ? s.state.extremes.max_dt : s.state.scale.dt;
    r.tau_min = moved ? s.state.extremes.min_tau : 0.0;
    r.limited = air.limited;
    r.backflow = air.backflow;
    r.mach_max = std::sqrt(3.0) * s.state.extremes.max_speed_lu;
    if (const lbm::MassBook& m = s.state.air_mass; m.cells > 0)
      r.air_mass = {m.lost_share(), m.returned_share(), m.missing_share(), m.corrections};
    if (recorder.drops().has_both()) r.pressure = pressures(s, recorder.history());
    for (const auto& patch : s.description.output.forces) {
      const coupling::Vec3 f = s.models.frozen_air ? coupling::Vec3::Zero() : recorder.forces().read(s, patch);
      r.forces.push_back({patch, f[0], f[1], f[2]});
    }
  } else {
    r.steps = s.state.carriers.statistics.steps;
    r.dt_min = r.dt_max = s.state.scale.dt;
  }
  if (s.description.carriers) {
    r.carriers = carriers(s);
    r.collisions = collisions(s);
  }
  if (s.description.fines) r.fines = fines(s);
  r.assumptions = assumptions(s);
  add_reference(s, r);
  return r;
}

}  // namespace puffin::tools
