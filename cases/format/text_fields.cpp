#include "cases/format/text_fields.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "cases/toml_string.hpp"

namespace puffin::cases::format {
namespace {

/// Dots stay: dotted keys (reference values) are read back as the nested tables they came from.
std::string bare_or_quoted(std::string_view key) {
  const bool bare = !key.empty() && key.front() != '.' && key.back() != '.' && key.find("..") == key.npos &&
                    std::all_of(key.begin(), key.end(), [](unsigned char c) {
                      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                             c == '-' || c == '.';
                    });
  return bare ? std::string(key) : toml_string(key);
}

/// A TOML floating-point number: with a point or an exponent.
std::string number_text(double value) {
  const std::string s = shortest(value);
  return s.find_first_of(".en") == std::string::npos ? s + ".0" : s;
}

std::string list_text(const std::vector<double>& values) {
  std::string s = "[";
  for (std::size_t i = 0; i < values.size(); ++i) s += (i ? ", " : "") + number_text(values[i]);
  return s + "]";
}

std::string origin_text(const ValueSource& s) {
  static constexpr std::array names{"given", "default", "derived", "assumed"};
  const std::string name = names[static_cast<int>(s.origin)];
  return s.note.empty() ? name : name + ": " + s.note;
}

}  // namespace

void TextFields::line(std::string_view key, const std::string& value) {
  const auto source = sources_.find(path_.empty() ? std::string(key) : path_ + "." + std::string(key));
  simple_ += bare_or_quoted(key) + " = " + value;
  simple_ += "  # " + origin_text(source == sources_.end() ? ValueSource{} : source->second);
  simple_ += '\n';
}

void TextFields::number(std::string_view key, double& value, const Unit& u, Range, Fallback<double>) {
  line(key, u.symbol.empty() ? number_text(value) : toml_string(format_quantity(value, u)));
}

void TextFields::integer(std::string_view key, std::int64_t& value, Range, Fallback<std::int64_t>) {
  line(key, std::to_string(value));
}

void TextFields::flag(std::string_view key, bool& value, Fallback<bool>) { line(key, value ? "true" : "false"); }

void TextFields::text(std::string_view key, std::string& value, Fallback<std::string>) {
  line(key, toml_string(value));
}

/// Absolute: the copy in a run's folder must find what the case found from its own.
void TextFields::file(std::string_view key, std::string& path, std::span<const std::string>) {
  line(key, toml_string(std::filesystem::absolute(path).string()));
}

void TextFields::texts(std::string_view key, std::vector<std::string>& values, Fallback<std::vector<std::string>>) {
  std::string s = "[";
  for (std::size_t i = 0; i < values.size(); ++i) s += (i ? ", " : "") + toml_string(values[i]);
  line(key, s + "]");
}

void TextFields::numbers(std::string_view key, std::vector<double>& values, std::size_t, const Unit& u,
                         Fallback<std::vector<double>>) {
  std::string s = "[";
  for (std::size_t i = 0; i < values.size(); ++i)
    s += (i ? ", " : "") + (u.symbol.empty() ? number_text(values[i]) : toml_string(format_quantity(values[i], u)));
  line(key, s + "]");
}

void TextFields::time_table(std::string_view key, TimeTable& table, const Unit& u) {
  if (table.time.size() == 1 && table.time[0] == 0.0) return line(key, toml_string(format_quantity(table.value[0], u)));
  std::string s = "[";
  for (std::size_t i = 0; i < table.time.size(); ++i)
    s += (i ? ", [" : "[") + toml_string(format_quantity(table.time[i], unit::time)) + ", " +
         toml_string(format_quantity(table.value[i], u)) + "]";
  line(key, s + "]");
}

void TextFields::everything(std::map<std::string, Parameter>& values, const UnitOf&, bool) {
  for (const auto& [key, value] : values) {
    if (const auto* number = std::get_if<double>(&value)) line(key, number_text(*number));
    if (const auto* list = std::get_if<std::vector<double>>(&value)) line(key, list_text(*list));
    if (const auto* word = std::get_if<std::string>(&value)) line(key, toml_string(*word));
    if (const auto* flag = std::get_if<bool>(&value)) line(key, *flag ? "true" : "false");
  }
}

int TextFields::pick(std::string_view key, std::span<const Choice> words, int held, Fallback<int>) {
  for (const Choice& w : words)
    if (w.value == held) line(key, toml_string(w.name));
  return held;
}

int TextFields::word(std::string_view key, std::initializer_list<std::string_view> words, int held, int) {
  if (held >= 0) line(key, toml_string(*(words.begin() + held)));
  return held;
}

void TextFields::section(std::string_view key, const Body& body) {
  const std::string name(key), dot = header_.empty() ? "" : ".";
  TextFields inside(path_.empty() ? name : path_ + "." + name, header_ + dot + bare_or_quoted(key), sources_);
  body(inside);
  if (!inside.simple_.empty()) nested_ += "\n[" + inside.header_ + "]\n";
  nested_ += inside.text();
}

void TextFields::item(std::string_view key, std::size_t i, const Body& body) {
  const std::string name(key), dot = header_.empty() ? "" : ".";
  TextFields inside((path_.empty() ? name : path_ + "." + name) + "[" + std::to_string(i) + "]",
                    header_ + dot + bare_or_quoted(key), sources_);
  body(inside);
  nested_ += "\n[[" + inside.header_ + "]]\n" + inside.text();
}

}  // namespace puffin::cases::format
