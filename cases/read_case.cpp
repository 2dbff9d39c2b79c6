#include "cases/read_case.hpp"

#include <stdexcept>

#include "cases/format/consistency.hpp"
#include "cases/format/schema.hpp"
#include "cases/format/toml_edit.hpp"
#include "cases/format/toml_fields.hpp"
#include "cases/format/toml_file.hpp"

namespace puffin::cases {

Override parse_override(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw std::invalid_argument("'" + std::string(text) + "': --set takes key=value, like numerics.dx=0.4mm");
  std::string key(text.substr(0, equals)), value(text.substr(equals + 1));
  while (!key.empty() && key.back() == ' ') key.pop_back();
  value.erase(0, value.find_first_not_of(' '));
  return {key, value};
}

Case parse_case(std::string_view toml_text, const std::filesystem::path& file, const std::vector<Override>& overrides,
                std::string_view preset) {
  const std::string name = file.string();
  toml::table root = format::parse_toml(toml_text, name);
  format::Findings findings(name, toml_text);
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
  format::check_consistency(c, findings);
  if (!findings.problems().empty()) throw CaseError(findings.sorted_problems());
  c.provenance = findings.sources();
  return c;
}

Case read_case(const std::filesystem::path& file, const std::vector<Override>& overrides, std::string_view preset) {
  return parse_case(format::read_text(file), file, overrides, preset);
}

}  // namespace puffin::cases
