#pragma once
// What reading a case file brings to light besides the values: where each key stands, where each value comes from,
// and what is wrong.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.hpp"
#include "cases/case_error.hpp"

namespace puffin::cases::format {

struct Place {
  std::string file;
  int line = 0, column = 0;
};

class Findings {
 public:
  /// `file` is what messages call the text; the lines are searched for comments ("# assumed: why").
  Findings(std::string file, std::string_view text);

  /// Another file that the case is made of: its comments count too.
  void add_text(const std::string& file, std::string_view text);
  const std::string& file() const { return file_; }
  /// Remembers where a key (dotted, with [i] for lists) is written.
  void place(const std::string& key, Place where) { places_[key] = std::move(where); }
  const std::map<std::string, Place>& places() const { return places_; }
  /// The place of a key, or of the nearest table around it.
  Place where(std::string key) const;

  void problem(const std::string& key, Place where, std::string text);
  /// At the place of the key.
  void problem(const std::string& key, const std::string& text) { problem(key, where(key), text); }
  /// Whether a problem was found at the key or inside it.
  bool broken(const std::string& key) const;

  void source(const std::string& key, ValueSource s) { sources_[key] = std::move(s); }
  /// What the comment behind a value ending at line and column (1-based) of a file, or an "# assumed:" line above line
  /// `first`, says about its origin; given without one.
  ValueSource comment(const std::string& file, int first, int line, int column) const;

  const std::vector<Problem>& problems() const { return problems_; }
  /// The problems in the order of the file.
  std::vector<Problem> sorted_problems() const;
  const std::map<std::string, ValueSource>& sources() const { return sources_; }

 private:
  std::string file_;
  std::map<std::string, std::vector<std::string>> lines_;  // by file
  std::map<std::string, Place> places_;
  std::map<std::string, ValueSource> sources_;
  std::vector<Problem> problems_;
};

}  // namespace puffin::cases::format
