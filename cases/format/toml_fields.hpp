#pragma once
// Fields of a parsed TOML table.

#include <toml++/toml.h>

#include <filesystem>

#include "cases/format/fields.hpp"
#include "cases/format/findings.hpp"

namespace puffin::cases::format {

class TomlFields final : public Fields {
 public:
  /// `path` is the dotted name of the table ("" for the whole file); `base` the folder that relative paths start from.
  TomlFields(const toml::table& table, std::string path, Findings& findings, std::filesystem::path base);

  /// Reports the keys that nobody asked for.
  void finish();

  bool reading() const override { return true; }
  Shape shape(std::string_view key, Shape held) override;
  void number(std::string_view key, double& value, const Unit& u, Range range, Fallback<double> fallback) override;
  void integer(std::string_view key, std::int64_t& value, Range range, Fallback<std::int64_t> fallback) override;
  void flag(std::string_view key, bool& value, Fallback<bool> fallback) override;
  void text(std::string_view key, std::string& value, Fallback<std::string> fallback) override;
  void texts(std::string_view key, std::vector<std::string>& values,
             Fallback<std::vector<std::string>> fallback) override;
  void numbers(std::string_view key, std::vector<double>& values, std::size_t count, const Unit& u,
               Fallback<std::vector<double>> fallback) override;
  void file(std::string_view key, std::string& path, std::span<const std::string> also) override;
  void time_table(std::string_view key, TimeTable& table, const Unit& u) override;
  void everything(std::map<std::string, Parameter>& values, const UnitOf& unit_of, bool nested) override;
  int pick(std::string_view key, std::span<const Choice> words, int held, Fallback<int> fallback) override;
  int word(std::string_view key, std::initializer_list<std::string_view> words, int held, int absent) override;
  void section(std::string_view key, const Body& body) override;
  std::size_t length(std::string_view key, std::size_t held) override;
  void item(std::string_view key, std::size_t i, const Body& body) override;
  void problem(std::string_view key, const std::string& text) override;

 private:
  const toml::node* find(std::string_view key);  // and remembers that it was asked for, and where it stands
  std::string full(std::string_view key) const;
  void wrong(std::string_view key, const toml::node& node, const std::string& text);
  void missing(std::string_view key);
  void given(std::string_view key, const toml::node& node);
  /// The node's comment says "default", but the value is not the default any more.
  void not_default(std::string_view key);
  std::optional<double> to_number(std::string_view key, const toml::node& node, const Unit* u);
  bool in_range(std::string_view key, const toml::node& node, double value, Range range);
  void sub_table(const toml::table* table, std::string path, const Body& body);
  Parameter to_parameter(std::string_view key, const toml::node& node, const Unit* u);

  /// The common part of all scalar keys: absent -> fallback, present -> `convert` (nullopt: already reported).
  template <class T, class Convert>
  void read(std::string_view key, T& value, const Fallback<T>& fallback, Convert convert);

  const toml::table& table_;
  std::string path_;
  Findings& findings_;
  std::filesystem::path base_;
  std::vector<std::string> asked_;
  std::map<std::string, std::vector<std::string>, std::less<>> words_;  // words that a quantity's key also takes
};

}  // namespace puffin::cases::format
