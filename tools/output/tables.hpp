#pragma once
// The tables of a run: one struct a row, columns exactly as the interface names them. SI units.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "tools/output/csv_file.hpp"

namespace puffin::output {

struct HistoryRow {
  double time = 0.0;                  // [s]
  double dt = 0.0;                    // time step of the air [s]
  double flow_rate = 0.0;             // [m^3/s]
  double static_drop = 0.0;           // inlet minus outlet, static [Pa]
  double total_to_static_drop = 0.0;  // total at the inlet minus static at the outlet [Pa]
  double carriers_in = 0.0;           // single carriers in the device
  double carriers_emitted = 0.0;      // single carriers that have left
  double carriers_asleep = 0.0;       // single carriers at rest
  double FFE = 0.0, FFW = 0.0, FFCR = 0.0, FFCE = 0.0, in_air = 0.0;  // of the fines loaded; first scalar
  double ledger_error = 0.0;                                          // of the fines loaded
};

struct ProbeRow {
  double time = 0.0;  // [s]
  std::string probe;
  double u = 0.0, v = 0.0, w = 0.0;  // [m/s]
  double p = 0.0;                    // [Pa]
};

struct LineRow {
  std::string line;
  double s = 0.0;                    // distance from the first point [m]
  double x = 0.0, y = 0.0, z = 0.0;  // [m]
  double u = 0.0, v = 0.0, w = 0.0;  // mean [m/s]
  double p = 0.0;                    // mean [Pa]
  std::int64_t samples = 0;
};

struct PlaneRow {
  double time = 0.0;  // [s]
  std::string plane;
  double flow_rate = 0.0;        // [m^3/s]
  double static_pressure = 0.0;  // area mean [Pa]
  double total_pressure = 0.0;   // flux-weighted mean [Pa]
};

struct ForceRow {
  double time = 0.0;  // [s]
  std::string patch;
  std::array<double, 3> force{0, 0, 0};  // of the air on the patch [N]
};

struct TrackRow {
  double time = 0.0;  // [s]
  std::int64_t id = 0;
  std::array<double, 3> position{0, 0, 0};  // [m]
  std::array<double, 3> velocity{0, 0, 0};  // [m/s]
  std::array<double, 3> spin{0, 0, 0};      // [rad/s]
};

/// The column names of each table, in order.
const std::vector<std::string>& history_columns();
const std::vector<std::string>& probe_columns();
const std::vector<std::string>& line_columns();
const std::vector<std::string>& plane_columns();
const std::vector<std::string>& force_columns();
const std::vector<std::string>& track_columns();

/// Appends one row to a CsvFile opened with the columns above. Throws as CsvFile::append.
void append(CsvFile& file, const HistoryRow& row);
void append(CsvFile& file, const ProbeRow& row);
void append(CsvFile& file, const LineRow& row);
void append(CsvFile& file, const PlaneRow& row);
void append(CsvFile& file, const ForceRow& row);
void append(CsvFile& file, const TrackRow& row);

/// The numbers of a history row in the order of history_columns(); for stats.h5.
std::vector<double> values(const HistoryRow& row);
/// The units in the order of history_columns().
const std::vector<std::string>& history_units();

}  // namespace puffin::output
