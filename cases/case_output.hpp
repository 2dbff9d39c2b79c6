#pragma once
// [stop] and [output]: how long, and what is written.

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cases/case_values.hpp"

namespace puffin::cases {

struct Stop {
  double time = 0.0;  // [s]
  bool when_empty = true;
  bool operator==(const Stop&) const = default;
};
struct RegionAll {
  bool operator==(const RegionAll&) const = default;
};
struct RegionSlice {
  int axis = 2;
  double at = 0.0;  // [m]
  bool operator==(const RegionSlice&) const = default;
};
struct RegionBox {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();  // [m]
  bool operator==(const RegionBox&) const = default;
};
using Region = std::variant<RegionAll, RegionSlice, RegionBox>;
struct FieldOutput {
  bool velocity = false, pressure = false, fines = false;
  Region region;
  double every = 0.0;  // [s]
  bool operator==(const FieldOutput&) const = default;
};
struct Probe {
  std::string name;
  Vec3 at = Vec3::Zero();
  bool operator==(const Probe&) const = default;
};
struct Line {
  std::string name;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  int points = 0;
  double average_from = 0.0;  // [s]; stop.time: the end alone
  bool operator==(const Line&) const = default;
};
struct Plane {
  std::string name;
  int axis = 0;     // the normal
  double at = 0.0;  // [m]
  bool operator==(const Plane&) const = default;
};
struct Checkpoints {
  double wall = 0.0;  // [s] of wall-clock between checkpoints
  int keep = 0;
  bool operator==(const Checkpoints&) const = default;
};
/// An output interval [s]; infinity: never.
inline constexpr double never = std::numeric_limits<double>::infinity();
struct Output {
  double statistics = 0.0;  // [s]
  std::vector<FieldOutput> fields;
  double carriers = never;  // [s]
  bool wall_map = true;     // at the end of the run
  bool events = true;
  Checkpoints checkpoint;
  std::vector<Probe> probes;
  std::vector<Line> lines;
  std::vector<Plane> planes;
  std::vector<std::string> forces;                       // patches
  std::optional<std::array<double, 2>> pressure_window;  // [s]; empty: the last 10 % of the run
  bool operator==(const Output&) const = default;
};

}  // namespace puffin::cases
