#include "cases/format/inherit.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <vector>

#include "cases/format/toml_file.hpp"

namespace puffin::cases::format {
namespace {

/// Of each pair a case gives one: who gives the other one does not mean both.
constexpr std::array<std::array<std::string_view, 2>, 5> alternatives{{{"stl", "generator"},
                                                                       {"dx", "cells"},
                                                                       {"fill", "list"},
                                                                       {"surface_energy", "hamaker"},
                                                                       {"flow_rate", "velocity"}}};

void drop_alternatives(std::string_view key, const toml::table& over, toml::table& under) {
  for (const auto& [a, b] : alternatives) {
    if (key == a && !over.contains(b)) under.erase(b);
    if (key == b && !over.contains(a)) under.erase(a);
  }
}

void lay_over(toml::table& over, toml::table& under) {
  for (auto&& [key, node] : over) {
    drop_alternatives(key.str(), over, under);
    toml::node* old = under.get(key.str());
    if (old && old->is_table() && node.is_table()) {
      lay_over(*node.as_table(), *old->as_table());
      continue;
    }
    under.erase(key.str());
    node.visit([&, k = key](auto& value) { under.insert_or_assign(k, std::move(value)); });  // moved: keeps its place
  }
}

using Chain = std::vector<std::filesystem::path>;

void inherit(toml::table& root, const std::filesystem::path& file, Chain chain, Findings& findings) {
  const toml::node* key = root.get("base");
  if (!key) return;
  const toml::source_position at = key->source().begin;
  const Place place{file.string(), static_cast<int>(at.line), static_cast<int>(at.column)};
  const auto name = key->value_exact<std::string>().value_or("");  // a copy: the key goes away
  const std::filesystem::path base = (file.parent_path() / name).lexically_normal();
  root.erase("base");
  if (name.empty()) return findings.problem("base", place, "base must be the name of a case file, in quotes");
  std::error_code error;
  if (!std::filesystem::is_regular_file(base, error))
    return findings.problem("base", place,
                            "base = \"" + name + "\": there is no such file; looked for " + base.string());
  chain.push_back(std::filesystem::weakly_canonical(file, error));
  if (std::find(chain.begin(), chain.end(), std::filesystem::weakly_canonical(base, error)) != chain.end())
    return findings.problem("base", place, "base = \"" + name + "\": the bases lead round in a circle");
  const std::string content = read_text(base);
  findings.add_text(base.string(), content);
  toml::table under = parse_toml(content, base.string());
  inherit(under, base, chain, findings);
  under.erase("name");
  under.erase("reference");
  lay_over(root, under);
  root = std::move(under);
}

}  // namespace

void inherit(toml::table& root, const std::filesystem::path& file, Findings& findings) {
  inherit(root, file, {}, findings);
}

}  // namespace puffin::cases::format
