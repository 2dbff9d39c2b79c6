#include "lbm/geometry/tree_search.hpp"

#include "lbm/isa.hpp"

namespace puffin::lbm::geometry {

const TreeSearches& tree_searches() {
  static const TreeSearches chosen = detect_isa() == Isa::baseline ? baseline::tree_searches() : avx2::tree_searches();
  return chosen;
}

}  // namespace puffin::lbm::geometry
