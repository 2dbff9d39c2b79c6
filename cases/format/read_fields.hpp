#pragma once
// A whole file of fields, in one call.

#include <filesystem>

#include "cases/case_error.hpp"
#include "cases/format/toml_fields.hpp"
#include "cases/format/toml_file.hpp"

namespace puffin::cases::format {

/// Reads a TOML file by describe(fields). Relative paths in it start from its own folder. Throws CaseError with every
/// problem at once: syntax, values, keys that nobody asked for; std::system_error if the file cannot be read.
template <class Describe>
void read_fields(const std::filesystem::path& file, const Describe& describe) {
  const std::string text = read_text(file);
  const toml::table root = parse_toml(text, file.string());
  Findings findings(file.string(), text);
  TomlFields fields(root, "", findings, file.parent_path());
  describe(fields);
  fields.finish();
  if (!findings.problems().empty()) throw CaseError(findings.sorted_problems());
}

}  // namespace puffin::cases::format
