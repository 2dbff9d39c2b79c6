#include "tools/puffin/recorder_state.hpp"

#include "coupling/checkpoint/bytes.hpp"

using puffin::coupling::Is;

// Found through the namespaces of what they store.

namespace puffin::coupling {
static void fields(auto& archive, Is<Taken> auto& taken) {
  auto& [air, wall] = taken;
  archive(air, wall);
}
static void fields(auto& archive, Is<ContactMark> auto& mark) {
  auto& [a_loses, b_loses, drag_a, drag_b] = mark;
  archive(a_loses, b_loses, drag_a, drag_b);
}
}  // namespace puffin::coupling

namespace puffin::output {
static void fields(auto& archive, Is<HistoryRow> auto& row) {
  auto& [time, dt, flow_rate, static_drop, total_drop, carriers_in, emitted, asleep, ffe, ffw, ffcr, ffce, in_air,
         error] = row;
  archive(time, dt, flow_rate, static_drop, total_drop, carriers_in, emitted, asleep, ffe, ffw, ffcr, ffce, in_air,
          error);
}
}  // namespace puffin::output

namespace puffin::tools {

static void fields(auto& archive, Is<PointReading> auto& reading) {
  auto& [velocity, pressure] = reading;
  archive(velocity, pressure);
}

static void fields(auto& archive, Is<Totals> auto& totals) {
  auto& [kinetic_energy, air_momentum, carrier_momentum] = totals;
  archive(kinetic_energy, air_momentum, carrier_momentum);
}

static void fields(auto& archive, Is<LineSums> auto& line) {
  auto& [sum, inside, samples] = line;
  archive(sum, inside, samples);
}

static void fields(auto& archive, Is<OpenContact> auto& contact) {
  auto& [taken, mark, angle, order] = contact;
  archive(taken, mark, angle, order);
}

static void fields(auto& archive, Is<RecorderState> auto& state) {
  auto& [statistics_next, carriers_next, fields_next, history, totals, scalars, lines, moved, begun, tables, events,
         series] = state;
  archive(statistics_next, carriers_next, fields_next, history, totals, scalars, lines, moved, begun, tables, events,
          series);
}

void save(const RecorderState& state, std::vector<std::byte>& bytes) { coupling::ByteWriter{bytes}(state); }

RecorderState restored(const std::vector<std::byte>& bytes) {
  RecorderState state;
  coupling::ByteReader reader(bytes, "outputs");
  reader(state);
  reader.finish();
  if (state.events < 0) reader.fail("counts fewer than no events");
  return state;
}

}  // namespace puffin::tools
