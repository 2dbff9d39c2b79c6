// The search of a triangle tree for baseline; the flags are set in lbm/CMakeLists.txt.
#define PUFFIN_ISA baseline
#include "lbm/geometry/tree_search.inc.hpp"
