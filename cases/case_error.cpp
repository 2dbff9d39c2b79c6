#include "cases/case_error.hpp"

#include <algorithm>

namespace puffin::cases {
namespace {

/// What a hostile name would do to a terminal, it does not do here: no control characters, and an end.
std::string printable(std::string line) {
  constexpr std::size_t longest = 2000;
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 32 || c == 127; }, '?');
  if (line.size() > longest) line = line.substr(0, longest - 3) + "...";
  return line;
}

std::string all_lines(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) {
    if (!text.empty()) text += '\n';
    text += p.to_string();
  }
  return text;
}

}  // namespace

std::string Problem::to_string() const {
  std::string place = file;
  if (line > 0) place += ":" + std::to_string(line) + ":" + std::to_string(column);
  place += ": error: ";
  place += text;
  return printable(std::move(place));
}

CaseError::CaseError(std::vector<Problem> found) : std::runtime_error(all_lines(found)), problems(std::move(found)) {}

}  // namespace puffin::cases
