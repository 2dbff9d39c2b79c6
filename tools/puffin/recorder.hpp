#pragma once
// Writes what a run produces while it goes on: tables, histories, events, VTK series.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cases/build.hpp"
#include "tools/output/csv_file.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/stats_file.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/tables.hpp"
#include "tools/output/vtk_series.hpp"
#include "tools/puffin/event_recorder.hpp"
#include "tools/puffin/recorder_state.hpp"

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

/// What one kind of output that comes again and again has cost so far.
struct RepeatedOutput {
  double interval = 0.0;   // [s] simulated
  std::int64_t times = 0;  // that it was written
  double seconds = 0.0;    // that this took, in all
};

class Recorder {
 public:
  /// resume: go on with the files in the folder from where they were then, and drop what came later. Throws OutputError
  /// if they are shorter.
  Recorder(const cases::Simulation& s, const output::OutputFolder& folder, const RecorderState* resume = nullptr);

  /// For a checkpoint: valid while no more is written.
  RecorderState state() const;
  /// Everything so far is on the disk. Renews stats.h5.
  void sync();

  /// The next time at which something is due [s].
  double next() const;
  /// Reads the contacts of the exchange that has just been done.
  void take_events(const cases::Simulation& s);
  /// Writes whatever is due.
  void record(const cases::Simulation& s);
  /// Writes what belongs to the end: last frames, lines, the wall map, events.h5; flushes everything.
  void finish(const cases::Simulation& s);
  /// Removes what only a resumed run would need.
  void forget_journal();

  const std::vector<output::HistoryRow>& history() const { return history_; }
  /// Statistics, carriers, then each kind of fields.
  const std::vector<RepeatedOutput>& repeated() const { return repeated_; }
  const DropReader& drops() const { return drops_; }
  const ForceReader& forces() const { return force_reader_; }

 private:
  void record_statistics(const cases::Simulation& s);
  void sample_line(const cases::Simulation& s, std::size_t k);
  void record_carriers(const cases::Simulation& s);
  void record_fields(const cases::Simulation& s, std::size_t which);
  void write_lines(const cases::Simulation& s);
  void write_walls(const cases::Simulation& s);
  void write_stats();
  void open_files(const cases::Simulation& s, const RecorderState* resume);

  const output::OutputFolder& folder_;
  DropReader drops_;
  ForceReader force_reader_;
  PointReader points_;
  Interval statistics_, carriers_;
  std::vector<Interval> fields_;
  std::vector<output::HistoryRow> history_;
  std::unique_ptr<output::CsvFile> history_csv_, probes_csv_, planes_csv_, forces_csv_, tracks_csv_;
  std::unique_ptr<EventRecorder> events_;
  std::unique_ptr<output::VtkSeries> fields_vtk_, carriers_vtk_, walls_vtk_;
  std::vector<LineSums> lines_;
  std::vector<Totals> totals_;                // one a row of the history
  std::vector<std::vector<double>> scalars_;  // likewise
  std::vector<std::string> scalar_names_;
  std::vector<RepeatedOutput> repeated_;
};

}  // namespace puffin::tools
