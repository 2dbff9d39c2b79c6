#include "cases/format/toml_fields.hpp"

#include <algorithm>

#include "cases/spelling.hpp"

namespace puffin::cases::format {
namespace {

/// Values of --set and --preset have no place in a file.
Place place_of(const toml::source_region& source, const std::string& file) {
  if (source.path && source.path->starts_with("--")) return {*source.path, 0, 0};
  return {source.path ? *source.path : file, static_cast<int>(source.begin.line),
          static_cast<int>(source.begin.column)};
}

/// The value as a message shows it: short, and without control characters.
std::string show(const toml::node& node) {
  std::string s;
  if (const auto* text = node.as_string())
    s = '"' + text->get() + '"';
  else if (const auto* number = node.as_floating_point())
    s = shortest(number->get());
  else if (const auto* whole = node.as_integer())
    s = std::to_string(whole->get());
  else if (const auto* flag = node.as_boolean())
    s = flag->get() ? "true" : "false";
  else if (node.is_table())
    s = "{...}";
  else if (node.is_array())
    s = "[...]";
  else
    s = "a date or time";
  std::replace_if(
      s.begin(), s.end(), [](unsigned char c) { return c < 32 || c == 127; }, '?');
  if (s.size() > 60) s = s.substr(0, 57) + "...";
  return s;
}

}  // namespace

TomlFields::TomlFields(const toml::table& table, std::string path, Findings& findings, std::filesystem::path base)
    : table_(table), path_(std::move(path)), findings_(findings), base_(std::move(base)) {
  if (table.source().begin) findings_.place(path_, place_of(table.source(), findings_.file()));
}

std::string TomlFields::full(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

const toml::node* TomlFields::find(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
  const auto found = table_.find(key);
  if (found == table_.end()) return nullptr;
  findings_.place(full(key), place_of(found->second.source(), findings_.file()));
  return &found->second;
}

void TomlFields::wrong(std::string_view key, const toml::node& node, const std::string& text) {
  findings_.problem(full(key), place_of(node.source(), findings_.file()), full(key) + " = " + show(node) + ": " + text);
}

void TomlFields::missing(std::string_view key) {
  findings_.problem(full(key), findings_.where(path_),
                    "missing key '" + std::string(key) + "'" + (path_.empty() ? "" : " in [" + path_ + "]"));
}

void TomlFields::given(std::string_view key, const toml::node& node) {
  const toml::source_region& s = node.source();
  ValueSource source;
  if (s.path && s.path->starts_with("--preset"))
    source = {Origin::derived, s.path->substr(2)};
  else
    source = findings_.comment(s.path ? *s.path : findings_.file(), s.begin.line, s.end.line, s.end.column);
  findings_.source(full(key), source);
}

void TomlFields::not_default(std::string_view key) {
  const auto found = findings_.sources().find(full(key));
  if (found != findings_.sources().end() && found->second.origin == Origin::defaulted) findings_.source(full(key), {});
}

Shape TomlFields::shape(std::string_view key, Shape) {
  const toml::node* node = find(key);
  if (!node) return Shape::absent;
  if (node->is_table()) return Shape::table;
  if (node->is_array()) return Shape::array;
  if (node->is_string()) return Shape::text;
  return node->is_boolean() ? Shape::boolean : Shape::number;
}

void TomlFields::sub_table(const toml::table* table, std::string path, const Body& body) {
  static const toml::table empty;
  TomlFields fields(table ? *table : empty, std::move(path), findings_, base_);
  body(fields);
  fields.finish();
}

void TomlFields::section(std::string_view key, const Body& body) {
  const toml::node* node = find(key);
  if (node && !node->is_table()) return wrong(key, *node, "must be a table, like [" + full(key) + "]");
  sub_table(node ? node->as_table() : nullptr, full(key), body);
}

std::size_t TomlFields::length(std::string_view key, std::size_t) {
  const toml::node* node = find(key);
  if (!node) return 0;
  const auto* array = node->as_array();
  const bool tables =
      array && std::all_of(array->begin(), array->end(), [](const toml::node& n) { return n.is_table(); });
  if (tables) return array->size();
  wrong(key, *node, "must be a list of tables, each under [[" + full(key) + "]]");
  return 0;
}

void TomlFields::item(std::string_view key, std::size_t i, const Body& body) {
  sub_table(table_.get(key)->as_array()->get(i)->as_table(), full(key) + "[" + std::to_string(i) + "]", body);
}

void TomlFields::problem(std::string_view key, const std::string& text) {
  const toml::node* node = find(key);
  if (node)
    wrong(key, *node, text);
  else
    findings_.problem(full(key), findings_.where(path_), (path_.empty() ? "" : "[" + path_ + "]: ") + text);
}

void TomlFields::finish() {
  for (auto&& [key, node] : table_) {
    const std::string name(key.str());
    if (std::find(asked_.begin(), asked_.end(), name) != asked_.end()) continue;
    std::string hint = did_you_mean(name, asked_);
    if (hint.empty() && !asked_.empty()) hint = "; known here: " + join(asked_);
    findings_.problem(full(name), place_of(key.source(), findings_.file()),
                      "unknown key '" + name.substr(0, 80) + "'" + (path_.empty() ? "" : " in [" + path_ + "]") + hint);
  }
}

}  // namespace puffin::cases::format
