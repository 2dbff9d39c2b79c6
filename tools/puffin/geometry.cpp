// puffin geometry KIND --out FILE.stl: parametric devices and test shapes.

#include <CLI/CLI.hpp>

#include "cases/generators/generators.hpp"
#include "cases/read_case.hpp"
#include "lbm/geometry/stl.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

constexpr double millimetre = 1e-3;

std::string text_of(const cases::ParameterValue& value, const std::string& unit) {
  const auto number = [&](double v) {
    if (unit == "m") return as_length(v);
    if (unit == "m^3") return as_volume(v);
    return four_digits(v) + (unit.empty() ? "" : " " + unit);
  };
  if (const auto* v = std::get_if<double>(&value)) return number(*v);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  std::string list;
  for (const double v : std::get<std::vector<double>>(value)) list += (list.empty() ? "" : ", ") + number(v);
  return "[" + list + "]";
}

std::string parameter_help(const std::string& kind) {
  std::string text = "Parameters (--set key=value; SI, or with a unit):\n";
  for (const cases::ParameterInfo& p : cases::parameters_of(kind)) {
    text += "  " + p.name + std::string(p.name.size() < 24 ? 24 - p.name.size() : 1, ' ') + p.meaning + " [" +
            text_of(p.default_value, p.unit) + "]" + (p.provenance == cases::Provenance::given ? " (thesis)" : "") +
            "\n";
  }
  return text;
}

struct GeometryArguments {
  std::string kind;
  std::vector<std::string> sets;
  std::string out;
  bool binary = false;
};

cases::Parameters parameters_of(const GeometryArguments& a) {
  try {
    std::vector<cases::Override> overrides;
    for (const std::string& set : a.sets) overrides.push_back(cases::parse_override(set));
    return cases::parse_parameters(a.kind, overrides);
  } catch (const cases::CaseError& e) {
    std::string text = a.kind + ":";
    for (const cases::Problem& p : e.problems)  // a parameter that was not given is not named in the text
      text += "\n  " + (p.text.starts_with(p.key) ? "" : p.key + " ") + p.text;
    throw UsageError(text);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

int make_geometry(const GeometryArguments& a) {
  const cases::Parameters parameters = parameters_of(a);
  const lbm::geometry::TriangleMesh mesh = cases::generate(a.kind, parameters);
  lbm::geometry::write_stl(a.out, mesh, a.binary, millimetre);
  const cases::KeyPoints points = cases::key_points(a.kind, parameters);
  std::string text = a.out + ": " + a.kind + ", " + as_volume(lbm::geometry::enclosed_volume(mesh)) + ", " +
                     std::to_string(mesh.triangles.size()) + " triangles, unit mm, solids";
  for (const std::string& solid : mesh.solids) text += " " + solid;
  if (points.path_length > 0.0) text += ", " + as_length(points.path_length) + " long";
  print(text);
  return ok;
}

}  // namespace

namespace commands {
Command geometry() {
  return {"geometry", "a parametric device or test shape as STL, one named solid a patch", [](CLI::App& app) -> Action {
            auto a = std::make_shared<GeometryArguments>();
            app.require_subcommand(1);
            for (const std::string& kind : cases::generator_kinds()) {
              CLI::App* sub = app.add_subcommand(kind, cases::summary_of(kind));
              sub->add_option("--set", a->sets, "a parameter; may be repeated")
                  ->type_name("KEY=VALUE")
                  ->expected(1)
                  ->take_all();
              sub->add_option("--out", a->out, "the file to write")->required()->type_name("FILE.stl");
              sub->add_flag("--binary", a->binary, "binary STL (loses the names of the solids)");
              sub->footer(parameter_help(kind));
              sub->callback([a, kind] { a->kind = kind; });
            }
            return [a] { return make_geometry(*a); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
