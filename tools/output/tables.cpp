#include "tools/output/tables.hpp"

namespace puffin::output {

using Names = std::vector<std::string>;

const Names& history_columns() {
  static const Names names{"time",
                           "dt",
                           "flow_rate",
                           "static_drop",
                           "total_to_static_drop",
                           "carriers_in",
                           "carriers_emitted",
                           "carriers_asleep",
                           "FFE",
                           "FFW",
                           "FFCR",
                           "FFCE",
                           "in_air",
                           "ledger_error"};
  return names;
}

const Names& history_units() {
  static const Names units{"s", "s", "m^3/s", "Pa", "Pa", "1", "1", "1", "1", "1", "1", "1", "1", "1"};
  return units;
}

const Names& probe_columns() {
  static const Names names{"time", "probe", "u", "v", "w", "p"};
  return names;
}

const Names& line_columns() {
  static const Names names{"line", "s", "x", "y", "z", "u", "v", "w", "p", "samples"};
  return names;
}

const Names& plane_columns() {
  static const Names names{"time", "plane", "flow_rate", "static_pressure", "total_pressure"};
  return names;
}

const Names& force_columns() {
  static const Names names{"time", "patch", "fx", "fy", "fz"};
  return names;
}

const Names& track_columns() {
  static const Names names{"time", "id", "x", "y", "z", "u", "v", "w", "wx", "wy", "wz"};
  return names;
}

std::vector<double> values(const HistoryRow& r) {
  return {r.time,
          r.dt,
          r.flow_rate,
          r.static_drop,
          r.total_to_static_drop,
          r.carriers_in,
          r.carriers_emitted,
          r.carriers_asleep,
          r.FFE,
          r.FFW,
          r.FFCR,
          r.FFCE,
          r.in_air,
          r.ledger_error};
}

void append(CsvFile& file, const HistoryRow& row) {
  const std::vector<double> numbers = values(row);
  file.append(std::vector<CsvCell>(numbers.begin(), numbers.end()));
}

void append(CsvFile& file, const ProbeRow& r) { file.append({r.time, r.probe, r.u, r.v, r.w, r.p}); }

void append(CsvFile& file, const LineRow& r) {
  file.append({r.line, r.s, r.x, r.y, r.z, r.u, r.v, r.w, r.p, static_cast<double>(r.samples)});
}

void append(CsvFile& file, const PlaneRow& r) {
  file.append({r.time, r.plane, r.flow_rate, r.static_pressure, r.total_pressure});
}

void append(CsvFile& file, const ForceRow& r) { file.append({r.time, r.patch, r.force[0], r.force[1], r.force[2]}); }

void append(CsvFile& file, const TrackRow& r) {
  file.append({r.time, static_cast<double>(r.id), r.position[0], r.position[1], r.position[2], r.velocity[0],
               r.velocity[1], r.velocity[2], r.spin[0], r.spin[1], r.spin[2]});
}

}  // namespace puffin::output
