#pragma once
// Fields that print the members as TOML, each with where it came from.

#include "cases/format/fields.hpp"

namespace puffin::cases::format {

class TextFields final : public Fields {
 public:
  using Sources = std::map<std::string, ValueSource>;
  /// `path` as in Findings ("air.boundary[0]"), `header` as TOML writes it ("air.boundary").
  TextFields(std::string path, std::string header, const Sources& sources)
      : path_(std::move(path)), header_(std::move(header)), sources_(sources) {}

  /// The keys of this table, then the tables in it.
  std::string text() const { return simple_ + nested_; }

  bool reading() const override { return false; }
  Shape shape(std::string_view, Shape held) override { return held; }
  void number(std::string_view key, double& value, const Unit& u, Range, Fallback<double>) override;
  void integer(std::string_view key, std::int64_t& value, Range, Fallback<std::int64_t>) override;
  void flag(std::string_view key, bool& value, Fallback<bool>) override;
  void text(std::string_view key, std::string& value, Fallback<std::string>) override;
  void texts(std::string_view key, std::vector<std::string>& values, Fallback<std::vector<std::string>>) override;
  void numbers(std::string_view key, std::vector<double>& values, std::size_t, const Unit& u,
               Fallback<std::vector<double>>) override;
  void file(std::string_view key, std::string& path, std::span<const std::string>) override;
  void time_table(std::string_view key, TimeTable& table, const Unit& u) override;
  void everything(std::map<std::string, Parameter>& values, const UnitOf&, bool) override;
  int pick(std::string_view key, std::span<const Choice> words, int held, Fallback<int>) override;
  int word(std::string_view key, std::initializer_list<std::string_view> words, int held, int) override;
  void section(std::string_view key, const Body& body) override;
  std::size_t length(std::string_view, std::size_t held) override { return held; }
  void item(std::string_view key, std::size_t i, const Body& body) override;
  void problem(std::string_view, const std::string&) override {}

 private:
  void line(std::string_view key, const std::string& value);

  std::string path_, header_;
  const Sources& sources_;
  std::string simple_, nested_;
};

}  // namespace puffin::cases::format
