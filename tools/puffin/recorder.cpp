#include "tools/puffin/recorder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "coupling/checkpoint/bytes.hpp"
#include "tools/output/stats_file.hpp"
#include "tools/puffin/frames_of.hpp"
#include "tools/puffin/history.hpp"

namespace puffin::tools {

using coupling::Vec3;

Recorder::Recorder(const cases::Simulation& s, const output::OutputFolder& folder, const RecorderState* resume)
    : folder_(folder), drops_(s), force_reader_(s), points_(s) {
  const cases::Output& out = s.description.output;
  statistics_.interval = out.statistics;
  carriers_.interval = s.description.carriers ? out.carriers : cases::never;
  carriers_.next = std::isfinite(carriers_.interval) ? 0.0 : cases::never;
  for (const auto& field : out.fields) fields_.push_back({field.every, 0.0});
  lines_.resize(out.lines.size());
  scalar_names_ = scalar_names(s);
  if (resume) {
    statistics_.next = resume->statistics_next;
    carriers_.next = resume->carriers_next;
    bool fits = resume->fields_next.size() == fields_.size() && resume->lines.size() == lines_.size() &&
                resume->totals.size() == resume->history.size() && resume->scalars.size() == resume->history.size();
    const std::size_t fates = fates_of_scalars(s).size();
    for (const auto& row : resume->scalars) fits = fits && row.size() == fates;
    for (std::size_t k = 0; fits && k < lines_.size(); ++k)
      fits = resume->lines[k].inside.size() == resume->lines[k].sum.size() &&
             (resume->lines[k].sum.empty() ||
              resume->lines[k].sum.size() == static_cast<std::size_t>(out.lines[k].points));
    if (!fits) throw coupling::CheckpointDamaged("its section 'outputs' does not fit the outputs of this case");
    for (std::size_t k = 0; k < fields_.size(); ++k) fields_[k].next = resume->fields_next[k];
    history_ = resume->history;
    totals_ = resume->totals;
    scalars_ = resume->scalars;
    lines_ = resume->lines;
  }
  open_files(s, resume);
  if (!resume) walls_vtk_->append(0.0, wall_frame(s));
}

void Recorder::open_files(const cases::Simulation& s, const RecorderState* resume) {
  const cases::Output& out = s.description.output;
  const auto table = [&](int which, const char* name, const std::vector<std::string>& columns) {
    return std::make_unique<output::CsvFile>(folder_.file(name), columns,
                                             resume ? std::optional(resume->tables[which]) : std::nullopt);
  };
  const auto series = [&](int which, const char* name) {
    return std::make_unique<output::VtkSeries>(
        folder_.file("vtk"), name,
        resume ? std::optional(static_cast<std::size_t>(resume->series[which])) : std::nullopt);
  };
  history_csv_ = table(0, "history.csv", output::history_columns());
  if (!out.probes.empty()) probes_csv_ = table(1, "probes.csv", output::probe_columns());
  if (!out.planes.empty()) planes_csv_ = table(2, "planes.csv", output::plane_columns());
  if (!out.forces.empty()) forces_csv_ = table(3, "forces.csv", output::force_columns());
  if (s.description.carriers) {
    if (!s.description.carriers->list.empty()) tracks_csv_ = table(4, "tracks.csv", output::track_columns());
    if (out.events) events_ = std::make_unique<EventRecorder>(folder_, resume);
    if (std::isfinite(carriers_.interval)) carriers_vtk_ = series(1, "carriers");
  }
  if (s.state.air && !out.fields.empty()) fields_vtk_ = series(0, "fields");
  walls_vtk_ = series(2, "walls");
}

RecorderState Recorder::state() const {
  RecorderState r;
  r.statistics_next = statistics_.next;
  r.carriers_next = carriers_.next;
  for (const auto& field : fields_) r.fields_next.push_back(field.next);
  r.history = history_;
  r.totals = totals_;
  r.scalars = scalars_;
  r.lines = lines_;
  const output::CsvFile* tables[] = {history_csv_.get(), probes_csv_.get(), planes_csv_.get(), forces_csv_.get(),
                                     tracks_csv_.get()};
  for (std::size_t n = 0; n < r.tables.size(); ++n) r.tables[n] = tables[n] ? tables[n]->bytes() : 0;
  if (events_) events_->save(r);
  const output::VtkSeries* series[] = {fields_vtk_.get(), carriers_vtk_.get(), walls_vtk_.get()};
  for (std::size_t n = 0; n < r.series.size(); ++n) r.series[n] = series[n] ? series[n]->entries().size() : 0;
  return r;
}

void Recorder::sync() {
  for (auto* csv : {&history_csv_, &probes_csv_, &planes_csv_, &forces_csv_, &tracks_csv_})
    if (*csv) (*csv)->sync();
  if (events_) events_->sync();
  for (auto* series : {&fields_vtk_, &carriers_vtk_, &walls_vtk_})
    if (*series) (*series)->sync();
  write_stats();
}

/// stats.h5 anew: a kill in the middle of HDF5's own writing would leave a file that nobody can read.
void Recorder::write_stats() {
  const auto file = folder_.file("stats.h5"), temporary = folder_.file("stats.h5.part");
  {
    output::StatsFile stats(temporary, stats_columns(scalar_names_));
    for (std::size_t n = 0; n < history_.size(); ++n) {
      std::vector<double> row = output::values(history_[n]);
      const Totals& t = totals_[n];
      row.push_back(t.kinetic_energy);
      row.insert(row.end(), t.air_momentum.begin(), t.air_momentum.end());
      row.insert(row.end(), t.carrier_momentum.begin(), t.carrier_momentum.end());
      row.insert(row.end(), scalars_[n].begin(), scalars_[n].end());
      stats.append(row);
    }
    stats.flush();
  }
  output::finish_file(temporary, file);
}

void Recorder::forget_journal() {
  if (events_) events_->forget_journal();
  events_.reset();
}

double Recorder::next() const {
  double t = std::min(statistics_.next, carriers_.next);
  for (const auto& f : fields_)
    if (fields_vtk_) t = std::min(t, f.next);
  return t;
}

void Recorder::take_events(const cases::Simulation& s) {
  if (events_) events_->take(s);
}

void Recorder::record(const cases::Simulation& s) {
  const double t = s.state.time;
  const auto record_if_due = [&](Interval& interval, RepeatedOutput& cost, const auto& write) {
    if (!interval.due(t)) return;
    const auto begin = std::chrono::steady_clock::now();
    write();
    interval.done(t);
    cost.interval = interval.interval;
    ++cost.times;
    cost.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  repeated_.resize(2 + fields_.size());
  record_if_due(statistics_, repeated_[0], [&] { record_statistics(s); });
  record_if_due(carriers_, repeated_[1], [&] { record_carriers(s); });
  if (!fields_vtk_) return;
  for (std::size_t k = 0; k < fields_.size(); ++k)
    record_if_due(fields_[k], repeated_[2 + k], [&] { record_fields(s, k); });
}

void Recorder::record_statistics(const cases::Simulation& s) {
  const output::HistoryRow row = history_row(s, drops_);
  history_.push_back(row);
  totals_.push_back(read_totals(s));
  scalars_.push_back(fates_of_scalars(s));
  output::append(*history_csv_, row);
  if (!s.state.air && !s.models.frozen_air) return;
  const cases::Output& out = s.description.output;
  const double t = s.state.time;
  for (const auto& probe : out.probes)
    if (const auto r = points_.read(s, probe.at))
      output::append(*probes_csv_,
                     output::ProbeRow{t, probe.name, r->velocity[0], r->velocity[1], r->velocity[2], r->pressure});
  for (const auto& plane : out.planes) {
    if (!s.state.air) break;  // a plane's flux is that of cells
    const auto r = read_plane(s, plane.axis, plane.at);
    if (r)
      output::append(*planes_csv_,
                     output::PlaneRow{t, plane.name, r->flow_rate, r->static_pressure, r->total_pressure});
  }
  for (const auto& patch : out.forces) {
    const Vec3 f = s.models.frozen_air ? Vec3::Zero() : force_reader_.read(s, patch);  // it acts on no wall
    output::append(*forces_csv_, output::ForceRow{t, patch, {f[0], f[1], f[2]}});
  }
  for (std::size_t k = 0; k < out.lines.size(); ++k)
    if (t >= out.lines[k].average_from * (1.0 - 1e-9)) sample_line(s, k);
}

void Recorder::sample_line(const cases::Simulation& s, std::size_t k) {
  const cases::Line& line = s.description.output.lines[k];
  LineSums& sums = lines_[k];
  sums.sum.resize(line.points);
  sums.inside.resize(line.points, 0);
  ++sums.samples;
  for (int n = 0; n < line.points; ++n) {
    const auto r = points_.read(s, place_on(line, n));
    if (!r) continue;
    ++sums.inside[n];
    sums.sum[n].velocity += r->velocity;
    sums.sum[n].pressure += r->pressure;
  }
}

void Recorder::record_carriers(const cases::Simulation& s) {
  if (carriers_vtk_) carriers_vtk_->append(s.state.time, carrier_frame(s));
  if (!tracks_csv_) return;
  const auto& c = s.state.carriers.carriers;
  for (std::size_t p = 0; p < c.size(); ++p)
    output::append(*tracks_csv_, output::TrackRow{s.state.time,
                                                  c.id[p],
                                                  {c.position[p][0], c.position[p][1], c.position[p][2]},
                                                  {c.velocity[p][0], c.velocity[p][1], c.velocity[p][2]},
                                                  {c.spin[p][0], c.spin[p][1], c.spin[p][2]}});
}

void Recorder::record_fields(const cases::Simulation& s, std::size_t which) {
  fields_vtk_->append(s.state.time, field_frame(s, s.description.output.fields[which]), static_cast<int>(which));
}

void Recorder::write_lines(const cases::Simulation& s) {
  const auto& lines = s.description.output.lines;
  if (lines.empty()) return;
  output::CsvFile csv(folder_.file("lines.csv"), output::line_columns());
  for (std::size_t k = 0; k < lines.size(); ++k)
    for (int n = 0; n < static_cast<int>(lines_[k].sum.size()); ++n) {
      if (lines_[k].inside[n] == 0) continue;  // outside the fluid
      const Vec3 x = place_on(lines[k], n);
      const double samples = static_cast<double>(lines_[k].inside[n]);
      const Vec3 u = lines_[k].sum[n].velocity / samples;
      output::append(csv, output::LineRow{lines[k].name, (x - lines[k].from).norm(), x[0], x[1], x[2], u[0], u[1], u[2],
                                          lines_[k].sum[n].pressure / samples, lines_[k].inside[n]});
    }
  csv.flush();
}

void Recorder::write_walls(const cases::Simulation& s) {
  if (s.description.output.wall_map && s.state.time > 0.0) walls_vtk_->append(s.state.time, wall_frame(s));
}

void Recorder::finish(const cases::Simulation& s) {
  if (history_.empty() || history_.back().time < s.state.time) record_statistics(s);
  if (carriers_vtk_ && (carriers_vtk_->entries().empty() || carriers_vtk_->entries().back().time < s.state.time))
    record_carriers(s);
  for (std::size_t k = 0; k < fields_.size(); ++k)
    if (fields_vtk_ && fields_[k].next - fields_[k].interval < s.state.time * (1.0 - 1e-9)) record_fields(s, k);
  for (std::size_t k = 0; k < lines_.size(); ++k)
    if (s.state.air && lines_[k].samples == 0) sample_line(s, k);  // stopped before its average began
  write_lines(s);
  write_walls(s);
  for (auto* csv : {&history_csv_, &probes_csv_, &planes_csv_, &forces_csv_, &tracks_csv_})
    if (*csv) (*csv)->flush();
  for (auto* series : {&fields_vtk_, &carriers_vtk_, &walls_vtk_})
    if (*series) (*series)->sync();
  write_stats();
  if (events_) events_->finish(s);
}

}  // namespace puffin::tools
