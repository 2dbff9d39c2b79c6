#include "cases/read_case.hpp"

#include <stdexcept>

#include "cases/format/consistency.hpp"
#include "cases/format/inherit.hpp"
#include "cases/format/schema.hpp"
#include "cases/format/toml_edit.hpp"
#include "cases/format/toml_fields.hpp"
#include "cases/format/toml_file.hpp"

namespace puffin::cases {
namespace {

/// Taylor-Green vortices and shear layers without an amplitude move at the reference speed.
void complete_initial_speed(Case& c, format::Findings& findings) {
  const bool vortices = c.air.initial == InitialField::taylor_green || c.air.initial == InitialField::shear_layer;
  if (!vortices || !c.numerics.reference_speed || c.air.initial_velocity.norm() > 0.0) return;
  c.air.initial_velocity = Vec3(*c.numerics.reference_speed, 0.0, 0.0);
  findings.source("air.initial_velocity", {Origin::derived, "numerics.reference_speed"});
}

}  // namespace

Override parse_override(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw std::invalid_argument("'" + std::string(text) + "': --set takes key=value, like numerics.dx=0.4mm");
  std::string key(text.substr(0, equals)), value(text.substr(equals + 1));
  while (!key.empty() && key.back() == ' ') key.pop_back();
  value.erase(0, value.find_first_not_of(' '));
  return {key, value};
}

std::map<std::string, Parameter> parse_parameters(const std::string& kind, const std::vector<Override>& overrides) {
  toml::table root;
  format::Findings findings(kind, "");
  for (const Override& o : overrides) try {
      format::apply_override(root, o);
    } catch (const std::invalid_argument& e) {
      findings.problem(o.key, {"--set " + o.key, 0, 0}, e.what());
    }
  std::map<std::string, Parameter> parameters;
  format::TomlFields fields(root, "", findings, {});
  format::describe_parameters(fields, kind, parameters);
  if (!findings.problems().empty()) throw CaseError(findings.sorted_problems());
  return parameters;
}

Case parse_case(std::string_view toml_text, const std::filesystem::path& file, const std::vector<Override>& overrides,
                std::string_view preset) {
  const std::string name = file.string();
  toml::table root = format::parse_toml(toml_text, name);
  if (format::describes_study(root))
    throw CaseError({{name, 1, 1, "", "this is a study, not a case: it is for puffin batch and puffin plan"}});
  format::Findings findings(name, toml_text);
  format::inherit(root, file, findings);
  if (!findings.problems().empty()) throw CaseError(findings.sorted_problems());
  if (!preset.empty()) format::apply_preset(root, preset_of(preset));
  for (const Override& o : overrides) try {
      format::apply_override(root, o);
    } catch (const std::invalid_argument& e) {
      findings.problem(o.key, {"--set " + o.key, 0, 0}, e.what());
    }
  Case c;
  format::TomlFields fields(root, "", findings, file.parent_path());
  format::describe(fields, c);
  fields.finish();
  complete_initial_speed(c, findings);
  format::check_consistency(c, findings);
  if (!findings.problems().empty()) throw CaseError(findings.sorted_problems());
  c.provenance = findings.sources();
  for (const auto& [key, place] : findings.places()) c.places.of[key] = {place.file, place.line, place.column};
  return c;
}

Case read_case(const std::filesystem::path& file, const std::vector<Override>& overrides, std::string_view preset) {
  return parse_case(format::read_text(file), file, overrides, preset);
}

}  // namespace puffin::cases
