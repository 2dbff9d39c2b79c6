#pragma once
// What the recorder of a run must remember to go on where it was: the part of the outputs in a checkpoint.

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "coupling/release_fines.hpp"
#include "tools/output/tables.hpp"
#include "tools/puffin/sampling.hpp"

namespace puffin::tools {

struct LineSums {
  std::vector<PointReading> sum;
  std::vector<std::int64_t> inside;  // per point: samples in the fluid
  std::int64_t samples = 0;
};

/// What became of the fines at a contact that is not over yet.
struct OpenContact {
  coupling::Taken taken;
  coupling::ContactMark mark;
  double angle = 90.0;  // [degrees], 90: head on
  std::int64_t order = 0;
};

/// By (a, b, triangle, start).
using MovedFines = std::map<std::tuple<std::int64_t, std::int64_t, int, double>, OpenContact>;

struct RecorderState {
  double statistics_next = 0.0, carriers_next = 0.0;  // [s]
  std::vector<double> fields_next;                    // [s]
  std::vector<output::HistoryRow> history;
  std::vector<Totals> totals;                // one a row of the history
  std::vector<std::vector<double>> scalars;  // likewise: scalar_columns of each
  std::vector<LineSums> lines;
  MovedFines moved;
  std::int64_t begun = 0;  // contacts so far
  // How far the files were.
  std::array<std::uint64_t, 5> tables{0, 0, 0, 0, 0};  // [byte] history, probes, planes, forces, tracks
  std::int64_t events = 0;                             // records
  std::array<std::uint64_t, 3> series{0, 0, 0};        // frames of fields, carriers, walls
};

void save(const RecorderState& state, std::vector<std::byte>& bytes);
/// Throws coupling::CheckpointDamaged.
RecorderState restored(const std::vector<std::byte>& bytes);

}  // namespace puffin::tools
