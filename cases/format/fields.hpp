#pragma once
// One table of the case file, seen from the schema. The schema (schema_*.cpp) names every key once, with its unit,
// range and default; a reader fills the members from TOML and a writer prints them, through the same calls.

#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.hpp"
#include "cases/choices.hpp"
#include "cases/units.hpp"

namespace puffin::cases::format {

enum class Range { any, positive, non_negative, fraction };  // fraction: in [0, 1]

/// What stands in for an absent key. Empty value: the key is required.
template <class T>
struct Fallback {
  std::optional<T> value;
  Origin origin = Origin::defaulted;
  std::string note;  // derived: how
};
struct Required {
  template <class T>
  operator Fallback<T>() const {
    return {};
  }
};
inline constexpr Required required{};
template <class T>
Fallback<T> otherwise(T value) {
  return {value, Origin::defaulted, ""};
}
template <class T>
Fallback<T> derived(T value, std::string how) {
  return {value, Origin::derived, std::move(how)};
}

/// The shape of a value, for keys that take several.
enum class Shape { absent, boolean, number, text, array, table };

class Fields {
 public:
  using Body = std::function<void(Fields&)>;
  virtual ~Fields() = default;

  /// True when members are being filled, false when they are printed.
  virtual bool reading() const = 0;
  /// The shape in the file (reader), or `held` (writer).
  virtual Shape shape(std::string_view key, Shape held) = 0;
  /// Whether the key is in the file (reader), or `held` (writer).
  bool has(std::string_view key, bool held) { return shape(key, held ? Shape::table : Shape::absent) != Shape::absent; }

  virtual void number(std::string_view key, double& value, const Unit& u, Range range, Fallback<double> fallback) = 0;
  virtual void integer(std::string_view key, std::int64_t& value, Range range, Fallback<std::int64_t> fallback) = 0;
  virtual void flag(std::string_view key, bool& value, Fallback<bool> fallback) = 0;
  virtual void text(std::string_view key, std::string& value, Fallback<std::string> fallback) = 0;
  virtual void texts(std::string_view key, std::vector<std::string>& values,
                     Fallback<std::vector<std::string>> fallback) = 0;
  virtual void numbers(std::string_view key, std::vector<double>& values, std::size_t count, const Unit& u,
                       Fallback<std::vector<double>> fallback) = 0;
  /// A path, relative to the case file or to one of `also`; must exist. Read as a path that can be opened.
  virtual void file(std::string_view key, std::string& path, std::span<const std::string> also) = 0;
  /// One value or [[time, value], ...].
  virtual void time_table(std::string_view key, TimeTable& table, const Unit& u) = 0;
  /// All keys of this table: numbers, lists of numbers, words and flags. `unit_of` gives the unit of a key, or nullptr
  /// where any will do. nested: tables too, their keys joined by dots.
  using UnitOf = std::function<const Unit*(const std::string&)>;
  virtual void everything(std::map<std::string, Parameter>& values, const UnitOf& unit_of, bool nested) = 0;

  /// One of the words: returns its value (held, when writing).
  virtual int pick(std::string_view key, std::span<const Choice> words, int held, Fallback<int> fallback) = 0;
  /// For a key that holds a word or something else: the index of the word, -1 if it is something else. `held`
  /// (writer) and `absent` (reader, key not there) are such indices too.
  virtual int word(std::string_view key, std::initializer_list<std::string_view> words, int held, int absent) = 0;

  /// A sub-table; an absent one is read as an empty one.
  virtual void section(std::string_view key, const Body& body) = 0;
  /// The number of tables in a list of tables (reader), or `held` (writer).
  virtual std::size_t length(std::string_view key, std::size_t held) = 0;
  virtual void item(std::string_view key, std::size_t i, const Body& body) = 0;

  /// Reader: reports a mistake at the key. Writer: does nothing.
  virtual void problem(std::string_view key, const std::string& text) = 0;

  void vector(std::string_view key, Vec3& value, const Unit& u, Fallback<Vec3> fallback) {
    std::vector<double> v{value.x(), value.y(), value.z()};
    Fallback<std::vector<double>> f{std::nullopt, fallback.origin, fallback.note};
    if (fallback.value) f.value = {fallback.value->x(), fallback.value->y(), fallback.value->z()};
    numbers(key, v, 3, u, f);
    if (v.size() == 3) value = Vec3(v[0], v[1], v[2]);
  }
  template <class Enum>
  void choice(std::string_view key, Enum& value, Fallback<Enum> fallback) {
    Fallback<int> f{std::nullopt, fallback.origin, fallback.note};
    if (fallback.value) f.value = static_cast<int>(*fallback.value);
    value = static_cast<Enum>(pick(key, choices<Enum>(), static_cast<int>(value), f));
  }
  template <class T, class F>
  void list(std::string_view key, std::vector<T>& items, F describe) {
    items.resize(length(key, items.size()));
    for (std::size_t i = 0; i < items.size(); ++i) item(key, i, [&](Fields& fields) { describe(fields, items[i]); });
  }
};

}  // namespace puffin::cases::format
