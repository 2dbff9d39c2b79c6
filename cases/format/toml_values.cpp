// The values of a TOML table: numbers with units, words, lists, files, tables over time.

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/format/toml_fields.hpp"
#include "cases/spelling.hpp"

namespace puffin::cases::format {
namespace {

/// In place of a number that could not be read, which was told: no file can hold it.
constexpr double unreadable = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t longest_name = 200;  // [byte]: it becomes part of the names of folders

std::vector<std::string> offered(std::span<const Choice> words) {
  std::vector<std::string> names;
  for (const Choice& w : words)
    if (w.offered) names.emplace_back(w.name);
  return names;
}

}  // namespace

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

std::optional<double> TomlFields::to_number(std::string_view key, const toml::node& node, const Unit* u) {
  std::string example = "\"";
  example.append(u ? u->example : "0.2 mm").append("\"");
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
    for (const toml::node& element : *array) list.push_back(to_number(key, element, u).value_or(unreadable));
    return list;
  }
  return to_number(key, node, u).value_or(unreadable);
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

}  // namespace puffin::cases::format
