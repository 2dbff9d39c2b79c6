#include "cases/format/toml_fields.hpp"

#include <algorithm>
#include <cmath>

#include "cases/spelling.hpp"

namespace puffin::cases::format {
namespace {

constexpr std::size_t longest_name = 200;  // [byte]: it becomes part of the names of folders

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

std::vector<std::string> offered(std::span<const Choice> words) {
  std::vector<std::string> names;
  for (const Choice& w : words)
    if (w.offered) names.emplace_back(w.name);
  return names;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  const std::string best = nearest(word, candidates);
  return best.empty() ? "" : "; did you mean '" + best + "'?";
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

template <class T, class Convert>
void TomlFields::read(std::string_view key, T& value, const Fallback<T>& fallback, Convert convert) {
  const toml::node* node = find(key);
  if (!node) {
    if (!fallback.value) return missing(key);
    value = *fallback.value;
    findings_.source(full(key), {fallback.origin, fallback.note});
    return;
  }
  const std::optional<T> converted = convert(*node);
  if (!converted) return;
  value = *converted;
  given(key, *node);
  if (!fallback.value || *fallback.value != value) not_default(key);
}

Shape TomlFields::shape(std::string_view key, Shape) {
  const toml::node* node = find(key);
  if (!node) return Shape::absent;
  if (node->is_table()) return Shape::table;
  if (node->is_array()) return Shape::array;
  if (node->is_string()) return Shape::text;
  return node->is_boolean() ? Shape::boolean : Shape::number;
}

std::optional<double> TomlFields::to_number(std::string_view key, const toml::node& node, const Unit* u) {
  const std::string example = "\"" + std::string(u ? u->example : "0.2 mm") + "\"";
  const std::string kind = u ? std::string(u->kind) : "a quantity";
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  if (const auto* number = node.as_floating_point()) {
    if (std::isfinite(number->get())) return number->get();
    wrong(key, node, "must be finite");
    return std::nullopt;
  }
  const auto words = words_.find(key);
  std::string or_words;
  if (words != words_.end())
    for (const std::string& w : words->second) or_words += " or \"" + w + "\"";
  if (const auto* text = node.as_string()) try {
      return u ? parse_quantity(text->get(), *u) : parse_quantity(text->get()).value;
    } catch (const UnitError& e) {
      std::string hint;
      if (words != words_.end()) hint = did_you_mean(text->get(), words->second);
      wrong(key, node, e.what() + (or_words.empty() ? "" : "; give " + kind + or_words) + hint);
      return std::nullopt;
    }
  const bool pure = u && u->symbol.empty();
  wrong(key, node, "must be " + kind + (pure ? "" : " like " + example) + or_words);
  return std::nullopt;
}

bool TomlFields::in_range(std::string_view key, const toml::node& node, double value, Range range) {
  if (range == Range::positive && !(value > 0.0)) return wrong(key, node, "must be positive"), false;
  if (range == Range::non_negative && !(value >= 0.0)) return wrong(key, node, "must not be negative"), false;
  if (range == Range::fraction && !(value >= 0.0 && value <= 1.0))
    return wrong(key, node, "must lie between 0 and 1"), false;
  return true;
}

void TomlFields::number(std::string_view key, double& value, const Unit& u, Range range, Fallback<double> fallback) {
  read(key, value, fallback, [&](const toml::node& node) {
    std::optional<double> number = to_number(key, node, &u);
    if (number && !in_range(key, node, *number, range)) number.reset();
    return number;
  });
}

void TomlFields::integer(std::string_view key, std::int64_t& value, Range range, Fallback<std::int64_t> fallback) {
  read(key, value, fallback, [&](const toml::node& node) -> std::optional<std::int64_t> {
    std::optional<std::int64_t> whole;
    if (const auto* i = node.as_integer()) whole = i->get();
    if (const auto* d = node.as_floating_point())
      if (d->get() == std::floor(d->get()) && std::abs(d->get()) < 9e15) whole = static_cast<std::int64_t>(d->get());
    if (!whole) return wrong(key, node, "must be a whole number"), std::nullopt;
    if (!in_range(key, node, static_cast<double>(*whole), range)) return std::nullopt;
    return whole;
  });
}

void TomlFields::flag(std::string_view key, bool& value, Fallback<bool> fallback) {
  read(key, value, fallback, [&](const toml::node& node) -> std::optional<bool> {
    if (const auto* b = node.as_boolean()) return b->get();
    return wrong(key, node, "must be true or false"), std::nullopt;
  });
}

void TomlFields::text(std::string_view key, std::string& value, Fallback<std::string> fallback) {
  read(key, value, fallback, [&](const toml::node& node) -> std::optional<std::string> {
    const auto* s = node.as_string();
    if (!s) return wrong(key, node, "must be a text in quotes"), std::nullopt;
    if (s->get().empty()) return wrong(key, node, "must not be empty"), std::nullopt;
    const bool one_line = key == "name" || key == "patch" || key == "with" || key == "scalar";
    const auto control = [&](unsigned char c) {
      return c == 127 || (c < 32 && (one_line || (c != '\n' && c != '\t')));
    };
    if (std::any_of(s->get().begin(), s->get().end(), control))
      return wrong(key, node, "must not hold control characters"), std::nullopt;
    if (one_line && s->get().size() > longest_name)
      return wrong(key, node, "is " + std::to_string(s->get().size()) + " letters long; at most 200"), std::nullopt;
    return s->get();
  });
}

void TomlFields::texts(std::string_view key, std::vector<std::string>& values,
                       Fallback<std::vector<std::string>> fallback) {
  read(key, values, fallback, [&](const toml::node& node) -> std::optional<std::vector<std::string>> {
    std::vector<std::string> list;
    if (const auto* one = node.as_string()) list.push_back(one->get());
    if (const auto* array = node.as_array())
      for (const toml::node& element : *array) {
        if (!element.is_string()) return wrong(key, element, "must be a text in quotes"), std::nullopt;
        list.push_back(element.as_string()->get());
      }
    else if (list.empty())
      return wrong(key, node, "must be a list of texts, like [\"a\", \"b\"]"), std::nullopt;
    return list;
  });
}

void TomlFields::numbers(std::string_view key, std::vector<double>& values, std::size_t count, const Unit& u,
                         Fallback<std::vector<double>> fallback) {
  read(key, values, fallback, [&](const toml::node& node) -> std::optional<std::vector<double>> {
    const auto* array = node.as_array();
    if (!array || array->size() != count)
      return wrong(key, node, "must be a list of " + std::to_string(count) + " numbers"), std::nullopt;
    std::vector<double> list;
    for (const toml::node& element : *array)
      if (const std::optional<double> number = to_number(key, element, &u)) list.push_back(*number);
    if (list.size() != count) return std::nullopt;
    return list;
  });
}

void TomlFields::file(std::string_view key, std::string& path, std::span<const std::string> also) {
  read(key, path, Fallback<std::string>{}, [&](const toml::node& node) -> std::optional<std::string> {
    const auto* s = node.as_string();
    if (!s || s->get().empty()) return wrong(key, node, "must be the name of a file, in quotes"), std::nullopt;
    const auto& source = node.source().path;  // a value of a base case: relative to the base's own folder
    const bool from_file = source && !source->starts_with("--");
    const std::filesystem::path here = from_file ? std::filesystem::path(*source).parent_path() : base_;
    std::vector<std::string> folders{here.empty() ? "." : here.string()};
    folders.insert(folders.end(), also.begin(), also.end());
    for (const std::string& folder : folders) {
      const std::filesystem::path candidate = (std::filesystem::path(folder) / s->get()).lexically_normal();
      std::error_code error;
      if (std::filesystem::exists(candidate, error) && !error) return candidate.string();
    }
    return wrong(key, node, "there is no such file; looked in " + join(folders)), std::nullopt;
  });
}

void TomlFields::time_table(std::string_view key, TimeTable& table, const Unit& u) {
  read(key, table, Fallback<TimeTable>{}, [&](const toml::node& node) -> std::optional<TimeTable> {
    TimeTable rows;
    const auto* array = node.as_array();
    if (!array) {
      const std::optional<double> constant = to_number(key, node, &u);
      if (!constant) return std::nullopt;
      return TimeTable{{0.0}, {*constant}};
    }
    for (const toml::node& element : *array) {
      const auto* row = element.as_array();
      if (!row || row->size() != 2)
        return wrong(key, element,
                     "each row must be [time, value], like [\"240 ms\", \"" + std::string(u.example) + "\"]"),
               std::nullopt;
      const std::optional<double> time = to_number(key, (*row)[0], &unit::time);
      const std::optional<double> value = to_number(key, (*row)[1], &u);
      if (!time || !value) return std::nullopt;
      if (!rows.time.empty() && !(*time > rows.time.back()))
        return wrong(key, (*row)[0], "the times must increase from row to row"), std::nullopt;
      rows.time.push_back(*time);
      rows.value.push_back(*value);
    }
    if (rows.time.empty()) return wrong(key, node, "the table is empty"), std::nullopt;
    return rows;
  });
}

Parameter TomlFields::to_parameter(std::string_view key, const toml::node& node, const Unit* u) {
  if (const auto* b = node.as_boolean()) return b->get();
  const auto* s = node.as_string();
  const bool word = s && (u ? u->symbol.empty() : true) &&
                    (s->get().empty() || std::string_view("+-.0123456789").find(s->get()[0]) == std::string_view::npos);
  if (word) return s->get();
  if (const auto* array = node.as_array()) {
    std::vector<double> list;
    for (const toml::node& element : *array)
      if (const std::optional<double> number = to_number(key, element, u)) list.push_back(*number);
    return list;
  }
  return to_number(key, node, u).value_or(0.0);
}

void TomlFields::everything(std::map<std::string, Parameter>& values, const UnitOf& unit_of, bool nested) {
  for (auto&& [k, node] : table_) {
    const std::string key(k.str());
    find(key);
    if (nested && node.is_table()) {
      std::map<std::string, Parameter> inside;
      section(key, [&](Fields& f) { f.everything(inside, unit_of, true); });
      for (auto& [name, value] : inside) values[key + "." + name] = std::move(value);
      continue;
    }
    values[key] = to_parameter(key, node, unit_of(key));
    given(key, node);
  }
}

int TomlFields::pick(std::string_view key, std::span<const Choice> words, int held, Fallback<int> fallback) {
  int value = held;
  read(key, value, fallback, [&](const toml::node& node) -> std::optional<int> {
    const std::vector<std::string> names = offered(words);
    const auto* s = node.as_string();
    const auto found =
        std::find_if(words.begin(), words.end(), [&](const Choice& w) { return s && w.name == s->get(); });
    if (found == words.end())
      return wrong(key, node, "must be one of " + join(names) + (s ? did_you_mean(s->get(), names) : "")), std::nullopt;
    if (!found->offered) return wrong(key, node, "is not part of this version; it offers " + join(names)), std::nullopt;
    return found->value;
  });
  return value;
}

int TomlFields::word(std::string_view key, std::initializer_list<std::string_view> words, int, int absent) {
  const toml::node* node = find(key);
  if (!node) {
    findings_.source(full(key), {Origin::defaulted, ""});
    return absent;
  }
  words_[std::string(key)] = {words.begin(), words.end()};
  const auto* s = node->as_string();
  const auto found = std::find_if(words.begin(), words.end(), [&](std::string_view w) { return s && s->get() == w; });
  if (found == words.end()) return -1;
  given(key, *node);
  const int index = static_cast<int>(found - words.begin());
  if (index != absent) not_default(key);
  return index;
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
