#pragma once
// Lists of "key=value" in the files of verifications and benchmarks.

#include <stdexcept>
#include <string_view>
#include <vector>

#include "cases/format/fields.hpp"
#include "cases/read_case.hpp"

namespace puffin::cases {

inline std::vector<Override> overrides(format::Fields& io, std::string_view key) {
  std::vector<std::string> texts;
  io.texts(key, texts, format::otherwise(texts));
  std::vector<Override> sets;
  for (const std::string& text : texts) try {
      sets.push_back(parse_override(text));
    } catch (const std::invalid_argument& e) {
      io.problem(key, e.what());
    }
  return sets;
}

}  // namespace puffin::cases
