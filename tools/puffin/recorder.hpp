#pragma once
// Writes what a run produces while it goes on: tables, histories, events, VTK series.

#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "cases/build.hpp"
#include "tools/output/csv_file.hpp"
#include "tools/output/events_file.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/stats_file.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/tables.hpp"
#include "tools/output/vtk_series.hpp"
#include "tools/puffin/sampling.hpp"

namespace puffin::tools {

/// A clock that is due every `interval` of simulated time, first at time 0.
struct Interval {
  double interval = 0.0;  // [s]
  double next = 0.0;      // [s]
  bool due(double t) const { return t >= next * (1.0 - 1e-12) - 1e-15; }
  void done(double t) {
    while (due(t)) next += interval;
  }
};

class Recorder {
 public:
  Recorder(const cases::Simulation& s, const output::OutputFolder& folder);

  /// The next time at which something is due [s].
  double next() const;
  /// Reads the contacts of the exchange that has just been done.
  void take_events(const cases::Simulation& s);
  /// Writes whatever is due.
  void record(const cases::Simulation& s);
  /// Writes what belongs to the end: last frames, lines, the wall map; flushes everything.
  void finish(const cases::Simulation& s);

  const std::vector<output::HistoryRow>& history() const { return history_; }
  const DropReader& drops() const { return drops_; }

 private:
  void record_statistics(const cases::Simulation& s);
  void sample_line(const cases::Simulation& s, std::size_t k);
  void record_carriers(const cases::Simulation& s);
  void record_fields(const cases::Simulation& s, std::size_t which);
  void write_lines(const cases::Simulation& s);
  void write_walls(const cases::Simulation& s);

  struct LineSums {
    std::vector<PointReading> sum;
    std::vector<std::int64_t> inside;  // per point: samples in the fluid
    std::int64_t samples = 0;
  };
  const output::OutputFolder& folder_;
  DropReader drops_;
  PointReader points_;
  Interval statistics_, carriers_;
  std::vector<Interval> fields_;
  std::vector<output::HistoryRow> history_;
  std::unique_ptr<output::CsvFile> history_csv_, probes_csv_, planes_csv_, forces_csv_, tracks_csv_;
  std::unique_ptr<output::StatsFile> stats_;
  std::unique_ptr<output::EventsFile> events_;
  std::unique_ptr<output::VtkSeries> fields_vtk_, carriers_vtk_, walls_vtk_;
  std::vector<LineSums> lines_;
  // Fines moved by contacts that are not over yet, by (a, b, triangle, start).
  std::map<std::tuple<std::int64_t, std::int64_t, int, double>, coupling::Taken> moved_;
};

/// Columns of stats.h5: those of history.csv, then the totals of the domain.
std::vector<output::StatsColumn> stats_columns();

/// One row of the history at this moment.
output::HistoryRow history_row(const cases::Simulation& s, const DropReader& drops);

}  // namespace puffin::tools
