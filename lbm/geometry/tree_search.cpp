#include "lbm/geometry/tree_search.hpp"

#include <cstdlib>
#include <string_view>

namespace puffin::lbm::geometry {

namespace {

bool has_avx2() {
  const char* asked = std::getenv("PUFFIN_ISA");
  if (asked && std::string_view(asked) == "baseline") return false;
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

}  // namespace

const TreeSearches& tree_searches() {
  static const TreeSearches chosen = has_avx2() ? avx2::tree_searches() : baseline::tree_searches();
  return chosen;
}

}  // namespace puffin::lbm::geometry
