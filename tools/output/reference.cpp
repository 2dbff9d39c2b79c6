// Our value beside each one of [reference], found by name in the summary.

#include "tools/output/json_fields.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {
namespace {

/// Leaves called `name` below `json`, with a quantity that has a `mean` counted as a leaf.
std::optional<double> find_leaf(const Json& json, const std::string& name) {
  if (!json.is_object()) return {};
  if (json.contains(name)) {
    const Json& value = json[name];
    if (value.is_number()) return value.get<double>();
    if (value.is_object() && value.contains("mean") && value["mean"].is_number()) return value["mean"].get<double>();
  }
  for (const auto& [key, child] : json.items()) {
    if (const auto found = find_leaf(child, name)) return found;
  }
  return {};
}

/// Walks as far as the path's words are keys, longest key first (names of scalars may hold dots).
std::optional<double> find_path(const Json& json, const std::string& path) {
  if (json.is_object()) {
    for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1)) {
      const std::string head = path.substr(0, dot);
      if (json.contains(head)) {
        if (const auto found = find_path(json[head], path.substr(dot + 1))) return found;
      }
    }
  }
  return path.find('.') == std::string::npos ? find_leaf(json, path) : std::nullopt;
}

}  // namespace

std::optional<double> find_value(const Summary& summary, const std::string& name) {
  Json json = Json::parse(summary_json(summary));
  json.erase("reference");
  if (const auto found = find_path(json, name)) return found;
  if (!summary.fines.empty())  // the first scalar's: by_mechanism.wall
    if (const auto found = find_path(json["fines"][summary.fines[0].name], name)) return found;
  const auto [source, quantity] = source_of(name);
  return source == "reference" ? std::nullopt : find_value(summary, quantity);
}

std::pair<std::string, std::string> source_of(const std::string& name) {
  for (const std::string source : {"experiment", "thesis", "simulation"})
    if (name.starts_with(source + ".")) return {source, name.substr(source.size() + 1)};
  return {"reference", name};
}

void compare_with_reference(Summary& summary, const std::vector<ReferenceValue>& given) {
  std::vector<ReferenceRow> rows;
  for (const auto& value : given) {
    ReferenceRow row{value.name, value.given, value.low, value.high, find_value(summary, value.name), {}};
    if (row.ours) row.difference = *row.ours - row.given;
    rows.push_back(row);
  }
  summary.reference = std::move(rows);
}

}  // namespace puffin::output
