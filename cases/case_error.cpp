#include "cases/case_error.hpp"

namespace puffin::cases {
namespace {

std::string all_lines(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) text += (text.empty() ? "" : "\n") + p.to_string();
  return text;
}

}  // namespace

std::string Problem::to_string() const {
  std::string place = file;
  if (line > 0) place += ":" + std::to_string(line) + ":" + std::to_string(column);
  return place + ": error: " + text;
}

CaseError::CaseError(std::vector<Problem> found) : std::runtime_error(all_lines(found)), problems(std::move(found)) {}

}  // namespace puffin::cases
