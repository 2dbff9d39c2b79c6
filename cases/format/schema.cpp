#include "cases/format/schema.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "cases/format/phrases.hpp"
#include "cases/generators/generators.hpp"

namespace puffin::cases::format {
namespace {

std::vector<Choice> generator_words() {
  std::vector<Choice> words;
  for (const std::string& kind : generator_kinds()) words.push_back({static_cast<int>(words.size()), kind, true});
  return words;
}

const Unit* unit_of_parameter(const std::string& kind, const std::string& name) {
  for (const ParameterInfo& info : parameters_of(kind)) {
    if (info.name != name) continue;
    if (info.unit == "m") return &unit::length;
    if (info.unit == "m^3") return &unit::volume;
    if (info.unit == "rad") return &unit::angle;
    if (info.unit.empty()) return &unit::number;
  }
  return nullptr;
}

/// Whether what stands in the file could be read; else that was told, and the value is no number.
bool was_read(const Parameter& value) {
  const auto number = [](double v) { return !std::isnan(v); };
  if (const auto* v = std::get_if<double>(&value)) return number(*v);
  if (const auto* list = std::get_if<std::vector<double>>(&value))
    return std::all_of(list->begin(), list->end(), number);
  return true;
}

void describe_generated(Fields& io, Generated& g) {
  const std::vector<Choice> words = generator_words();
  const auto held = std::find(generator_kinds().begin(), generator_kinds().end(), g.kind) - generator_kinds().begin();
  const int kind = io.pick("generator", words, static_cast<int>(held), required);
  if (kind < 0 || kind >= static_cast<int>(words.size())) {  // a misspelt kind: its table is no second mistake
    for (const std::string& k : generator_kinds()) io.has(k, false);
    return;
  }
  g.kind = words[kind].name;
  io.section(g.kind, [&](Fields& f) { describe_parameters(f, g.kind, g.parameters); });
}

void describe_stl(Fields& io, StlFile& s) {
  io.file("stl", s.file, {});
  if (const int word = io.word("unit", {"m", "cm", "mm", "um"}, -1, 2); word >= 0)
    s.unit = std::array{1.0, 1e-2, 1e-3, 1e-6}[word];
  else
    io.number("unit", s.unit, unit::length, Range::positive, required);
}

}  // namespace

void describe_parameters(Fields& io, const std::string& kind, std::map<std::string, Parameter>& parameters) {
  io.everything(
      parameters, [&](const std::string& name) { return unit_of_parameter(kind, name); }, false);
  if (!io.reading()) return;
  for (const ParameterProblem& p : check_parameters(kind, parameters)) {
    const auto value = parameters.find(p.parameter);
    const bool known = unit_of_parameter(kind, p.parameter) != nullptr;
    if (known && value != parameters.end() && !was_read(value->second)) continue;  // no second complaint
    io.problem(p.parameter, p.message);
  }
}

void describe(Fields& io, Geometry& g) {
  const bool stl = io.has("stl", std::holds_alternative<StlFile>(g.source));
  const bool generator = io.has("generator", std::holds_alternative<Generated>(g.source));
  if (stl && generator) io.problem("stl", "give either 'generator' or 'stl', not both");
  if (stl) {
    if (io.reading()) g.source = StlFile{};
    describe_stl(io, std::get<StlFile>(g.source));
  } else {
    describe_generated(io, std::get<Generated>(g.source));
  }
  io.list("patch", g.patches, [](Fields& f, Patch& p) {
    f.text("name", p.name, required);
    f.text("select", p.select, required);
    if (f.reading() && !p.select.empty()) try {
        p.select = canonical_selection(p.select);
      } catch (const std::invalid_argument& e) {
        f.problem("select", e.what());
      }
  });
}

void describe(Fields& io, Stop& s) {
  io.number("time", s.time, unit::time, Range::positive, required);
  io.flag("when_empty", s.when_empty, otherwise(true));
}

void describe(Fields& io, Case& c) {
  std::int64_t schema = 1;
  io.integer("schema", schema, Range::any, otherwise<std::int64_t>(1));
  if (schema != 1) io.problem("schema", "this version reads schema 1");
  io.text("name", c.name, required);
  io.section("geometry", [&](Fields& f) { describe(f, c.geometry); });
  io.section("air", [&](Fields& f) { describe(f, c.air); });
  io.section("numerics", [&](Fields& f) { describe(f, c.numerics, c.air.model); });
  if (io.has("carriers", c.carriers.has_value())) {
    if (io.reading()) c.carriers.emplace();
    io.section("carriers", [&](Fields& f) { describe(f, *c.carriers); });
  }
  if (io.has("fines", c.fines.has_value())) {
    if (io.reading()) c.fines.emplace();
    io.section("fines", [&](Fields& f) { describe(f, *c.fines, c.carriers); });
  }
  io.section("stop", [&](Fields& f) { describe(f, c.stop); });
  io.section("output", [&](Fields& f) { describe(f, c.output, c); });
  io.section("reference", [&](Fields& f) {
    f.everything(
        c.reference, [](const std::string&) { return nullptr; }, true);
  });
}

}  // namespace puffin::cases::format
