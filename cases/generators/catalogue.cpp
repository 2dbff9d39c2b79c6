#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "cases/generators/generators.hpp"
#include "cases/generators/kinds.hpp"
#include "cases/spelling.hpp"

namespace puffin::cases {
namespace {

using generators::Kind;
using generators::Problems;
using generators::Values;

const std::vector<Kind>& catalogue() {
  static const std::vector<Kind> kinds = {
      generators::l_bend_kind(), generators::omega_bend_kind(), generators::duct_kind(), generators::pipe_kind(),
      generators::bend_kind(),   generators::step_kind(),       generators::box_kind(),  generators::obstacle_kind()};
  return kinds;
}

const Kind& kind_named(const std::string& name) {
  for (const Kind& kind : catalogue())
    if (kind.name == name) return kind;
  throw std::invalid_argument("unknown generator '" + name + "'" + did_you_mean_or_known(name, generator_kinds()));
}

std::string type_name(const ParameterValue& value) {
  static const char* const names[] = {"a number", "a list of numbers", "a word", "true or false"};
  return names[value.index()];
}

std::string as_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

void check_range(const ParameterInfo& info, double number, Problems& problems) {
  if (!std::isfinite(number))
    problems.push_back({info.name, "must be a finite number"});
  else if (info.range == Range::positive && number <= 0.0)
    problems.push_back({info.name, "is " + as_text(number) + "; it must be greater than 0"});
  else if (info.range == Range::not_negative && number < 0.0)
    problems.push_back({info.name, "is " + as_text(number) + "; it must not be negative"});
}

void check_value(const ParameterInfo& info, const ParameterValue& value, Problems& problems) {
  if (value.index() != info.default_value.index()) {
    problems.push_back({info.name, "is " + type_name(value) + "; it must be " + type_name(info.default_value)});
  } else if (const auto* number = std::get_if<double>(&value)) {
    check_range(info, *number, problems);
  } else if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    for (const double one : *numbers) check_range(info, one, problems);
  } else if (const auto* word = std::get_if<std::string>(&value);
             word != nullptr && std::find(info.choices.begin(), info.choices.end(), *word) == info.choices.end()) {
    problems.push_back({info.name, "is '" + *word + "'" + did_you_mean_or_known(*word, info.choices)});
  }
}

/// Fills `complete` with defaults, the given values and what is derived from them; returns everything wrong.
Problems resolve(const Kind& kind, const Parameters& given, Parameters& complete) {
  Problems problems;
  std::vector<std::string> names;
  for (const ParameterInfo& info : kind.parameters) {
    names.push_back(info.name);
    complete[info.name] = info.default_value;
  }
  for (const auto& [name, value] : given) {
    const auto info = std::find_if(kind.parameters.begin(), kind.parameters.end(),
                                   [&name = name](const ParameterInfo& p) { return p.name == name; });
    if (info == kind.parameters.end()) {
      problems.push_back({name, "is not a parameter of " + kind.name + did_you_mean_or_known(name, names)});
      continue;
    }
    check_value(*info, value, problems);
    complete[name] = value;
  }
  if (!problems.empty()) return problems;
  Values values(complete);
  try {
    kind.complete(values, problems);
    if (!problems.empty()) return problems;
    generators::Surface surface(values.number("facet_size"));
    kind.add_faces(values, surface);
  } catch (const std::length_error&) {  // thrown on the way, before they are all in memory
    problems.push_back({"facet_size",
                        "asks for more than 4 million triangles; raise it, or check the unit of the "
                        "lengths (a bare number is in metres)"});
  }
  return problems;
}

Parameters resolve_or_throw(const Kind& kind, const Parameters& given) {
  Parameters complete;
  if (Problems problems = resolve(kind, given, complete); !problems.empty())
    throw GeneratorError(kind.name, std::move(problems));
  return complete;
}

std::string describe(const std::string& kind, const Problems& problems) {
  std::string text;
  for (const ParameterProblem& p : problems) {
    if (!text.empty()) text += '\n';
    text += kind + ": " + p.parameter + " " + p.message;
  }
  return text;
}

}  // namespace

GeneratorError::GeneratorError(const std::string& kind, std::vector<ParameterProblem> problems)
    : std::invalid_argument(describe(kind, problems)), problems_(std::move(problems)) {}

const std::vector<std::string>& generator_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Kind& kind : catalogue()) list.push_back(kind.name);
    return list;
  }();
  return names;
}

const std::string& summary_of(const std::string& kind) { return kind_named(kind).summary; }

const std::vector<ParameterInfo>& parameters_of(const std::string& kind) { return kind_named(kind).parameters; }

std::vector<ParameterProblem> check_parameters(const std::string& kind, const Parameters& parameters) {
  Parameters complete;
  return resolve(kind_named(kind), parameters, complete);
}

Parameters resolve_parameters(const std::string& kind, const Parameters& parameters) {
  return resolve_or_throw(kind_named(kind), parameters);
}

lbm::geometry::TriangleMesh generate(const std::string& kind, const Parameters& parameters) {
  const Kind& shape = kind_named(kind);
  Parameters complete = resolve_or_throw(shape, parameters);
  const Values values(complete);
  generators::Surface surface;
  shape.add_faces(values, surface);
  return surface.close(values.number("facet_size"));
}

std::vector<std::string> solids_of(const std::string& kind, const Parameters& parameters) {
  const Kind& shape = kind_named(kind);
  Parameters complete = resolve_or_throw(shape, parameters);
  generators::Surface surface;
  shape.add_faces(Values(complete), surface);
  return surface.solids();
}

KeyPoints key_points(const std::string& kind, const Parameters& parameters) {
  const Kind& shape = kind_named(kind);
  Parameters complete = resolve_or_throw(shape, parameters);
  return shape.key_points(Values(complete));
}

namespace generators {

ParameterInfo facet_size_info(double default_value) {
  return {"facet_size",        default_value,      "m", "longest edge of a triangle; 0: chosen from the shape",
          Provenance::assumed, Range::not_negative};
}

void choose_facet_size(Values& values, double automatic) {
  if (values.number("facet_size") == 0.0) values.set("facet_size", automatic);
}

std::string millimetres(double length) { return as_text(length * 1e3) + " mm"; }

}  // namespace generators
}  // namespace puffin::cases
