#include <stdexcept>

#include "cases/format/phrases.hpp"
#include "cases/format/schema.hpp"

namespace puffin::cases::format {
namespace {

void describe(Fields& io, FieldOutput& field) {
  std::vector<std::string> what;
  if (field.velocity) what.push_back("velocity");
  if (field.pressure) what.push_back("pressure");
  if (field.fines) what.push_back("fines");
  io.texts("what", what, required);
  std::string region = format_region(field.region);
  io.text("region", region, otherwise<std::string>("all"));
  io.number("every", field.every, unit::time, Range::positive, required);
  if (!io.reading()) return;
  for (const std::string& word : what) {
    if (word == "velocity")
      field.velocity = true;
    else if (word == "pressure")
      field.pressure = true;
    else if (word == "fines")
      field.fines = true;
    else
      io.problem("what", "'" + word + "' is no field; give velocity, pressure or fines");
  }
  try {
    field.region = parse_region(region);
  } catch (const std::invalid_argument& e) {
    io.problem("region", e.what());
  }
}

void describe(Fields& io, Plane& plane) {
  io.text("name", plane.name, required);
  std::string normal{axis_name(plane.axis)};
  io.text("normal", normal, required);
  io.number("at", plane.at, unit::length, Range::any, required);
  if (io.reading() && !normal.empty()) try {
      plane.axis = parse_axis(normal);
    } catch (const std::invalid_argument& e) {
      io.problem("normal", e.what());
    }
}

void describe(Fields& io, Line& line, double end) {
  io.text("name", line.name, required);
  io.vector("from", line.from, unit::length, required);
  io.vector("to", line.to, unit::length, required);
  std::int64_t points = line.points;
  io.integer("points", points, Range::positive, otherwise<std::int64_t>(100));
  if (points < 2 || points > 1'000'000) io.problem("points", "a line has 2 to 1000000 points");
  line.points = static_cast<int>(points);
  if (io.reading() && line.from == line.to) io.problem("to", "is the place 'from' itself; a line needs a length");
  io.number("average_from", line.average_from, unit::time, Range::non_negative,
            derived(end, "stop.time: the end alone"));
  if (io.reading() && line.average_from > end) io.problem("average_from", "lies after stop.time: nothing is averaged");
}

void describe(Fields& io, Checkpoints& c) {
  io.number("wall", c.wall, unit::time, Range::positive, otherwise(600.0));
  std::int64_t keep = c.keep;
  io.integer("keep", keep, Range::positive, otherwise<std::int64_t>(2));
  if (keep > 1000) io.problem("keep", "at most 1000 checkpoints");
  c.keep = static_cast<int>(keep);
}

}  // namespace

void describe(Fields& io, Output& o, const Case& c) {
  io.number("statistics", o.statistics, unit::time, Range::positive, derived(c.stop.time / 500.0, "stop.time / 500"));
  io.list("fields", o.fields, [](Fields& f, FieldOutput& field) { describe(f, field); });
  const bool tracks = c.carriers && !c.carriers->list.empty();
  const bool given = io.shape("carriers", Shape::text) != Shape::absent;
  if (!tracks || given) {
    if (io.word("carriers", {"never"}, o.carriers == never ? 0 : -1, 0) < 0)
      io.number("carriers", o.carriers, unit::time, Range::positive, required);
  } else {
    io.number("carriers", o.carriers, unit::time, Range::positive, derived(o.statistics, "output.statistics"));
  }
  o.wall_map = io.word("wall_map", {"end", "none"}, o.wall_map ? 0 : 1, 0) != 1;
  if (io.reading() && io.word("wall_map", {"end", "none"}, 0, 0) < 0)
    io.problem("wall_map", "give \"end\" or \"none\"");
  io.flag("events", o.events, otherwise(true));
  io.section("checkpoint", [&](Fields& f) { describe(f, o.checkpoint); });
  io.list("probe", o.probes, [](Fields& f, Probe& probe) {
    f.text("name", probe.name, required);
    f.vector("at", probe.at, unit::length, required);
  });
  io.list("line", o.lines, [&](Fields& f, Line& line) { describe(f, line, c.stop.time); });
  io.list("plane", o.planes, [](Fields& f, Plane& plane) { describe(f, plane); });
  io.texts("force", o.forces, otherwise(std::vector<std::string>{}));
  if (io.has("pressure_window", o.pressure_window.has_value())) {
    std::vector<double> window;
    if (o.pressure_window) window.assign(o.pressure_window->begin(), o.pressure_window->end());
    io.numbers("pressure_window", window, 2, unit::time, required);
    if (window.size() == 2) {
      o.pressure_window = {window[0], window[1]};
      if (!(window[0] >= 0.0 && window[0] < window[1]))
        io.problem("pressure_window", "the window must begin at 0 or later and end after it began");
    }
  }
}

}  // namespace puffin::cases::format
