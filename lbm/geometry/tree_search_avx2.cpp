// The search of a triangle tree for avx2; the flags are set in lbm/CMakeLists.txt.
#define PUFFIN_ISA avx2
#include "lbm/geometry/tree_search.inc.hpp"
