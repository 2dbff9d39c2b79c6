#include "cases/format/findings.hpp"

#include <algorithm>

namespace puffin::cases::format {
namespace {

std::string_view trim(std::string_view s) {
  const std::string_view blank = " \t\r";
  const std::size_t begin = s.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return s.substr(begin, s.find_last_not_of(blank) - begin + 1);
}

/// The part of a line from a column on; columns count characters, not bytes.
std::string_view from_column(std::string_view line, int column) {
  std::size_t at = 0;
  for (int c = 1; c < column && at < line.size(); ++c) {
    ++at;
    while (at < line.size() && (static_cast<unsigned char>(line[at]) & 0xC0) == 0x80) ++at;
  }
  return line.substr(at);
}

/// The comment of a rest of a line; quotes hide a '#'.
std::string_view comment_of(std::string_view rest) {
  char quote = '\0';
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (quote != '\0') {
      if (rest[i] == quote) quote = '\0';
    } else if (rest[i] == '"' || rest[i] == '\'') {
      quote = rest[i];
    } else if (rest[i] == '#') {
      return trim(rest.substr(i + 1));
    }
  }
  return {};
}

/// "assumed: why" -> "why"; nullopt-like empty `matched` otherwise.
bool after(std::string_view comment, std::string_view word, std::string& note) {
  if (!comment.starts_with(word)) return false;
  std::string_view rest = comment.substr(word.size());
  if (!rest.empty() && rest.front() != ':') return false;
  if (!rest.empty()) rest.remove_prefix(1);
  note = trim(rest);
  return true;
}

}  // namespace

Findings::Findings(std::string file, std::string_view text) : file_(std::move(file)) { add_text(file_, text); }

void Findings::add_text(const std::string& file, std::string_view text) {
  std::vector<std::string>& lines = lines_[file];
  lines.clear();
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

Place Findings::where(std::string key) const {
  while (true) {
    if (const auto found = places_.find(key); found != places_.end()) return found->second;
    const std::size_t cut = key.find_last_of(".[");
    if (cut == std::string::npos) return {file_, 0, 0};
    key.resize(cut);
  }
}

void Findings::problem(const std::string& key, Place where, std::string text) {
  problems_.push_back({std::move(where.file), where.line, where.column, key, std::move(text)});
}

bool Findings::broken(const std::string& key) const {
  return std::any_of(problems_.begin(), problems_.end(), [&](const Problem& p) {
    return p.key.starts_with(key) &&
           (p.key.size() == key.size() || p.key[key.size()] == '.' || p.key[key.size()] == '[');
  });
}

ValueSource Findings::comment(const std::string& file, int first, int line, int column) const {
  ValueSource s;
  const auto found = lines_.find(file);
  if (found == lines_.end() || line < 1 || line > static_cast<int>(found->second.size())) return s;
  const std::vector<std::string>& lines = found->second;
  const std::string_view text = comment_of(from_column(lines[line - 1], column));
  if (after(text, "assumed", s.note))
    s.origin = Origin::assumed;
  else if (after(text, "default", s.note))
    s.origin = Origin::defaulted;
  else if (after(text, "derived", s.note))
    s.origin = Origin::derived;
  if (s.origin != Origin::given || first < 2) return s;
  const std::string_view above = trim(lines[first - 2]);
  if (above.starts_with('#') && after(trim(above.substr(1)), "assumed", s.note)) s.origin = Origin::assumed;
  return s;
}

std::vector<Problem> Findings::sorted_problems() const {
  std::vector<Problem> sorted = problems_;
  const auto rank = [&](const Problem& p) { return std::tuple(p.file != file_, p.line, p.column); };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Problem& a, const Problem& b) { return rank(a) < rank(b); });
  return sorted;
}

}  // namespace puffin::cases::format
