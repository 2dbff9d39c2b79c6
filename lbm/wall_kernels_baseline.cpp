// The wall kernels for baseline; the flags are set in lbm/CMakeLists.txt.
#define PUFFIN_ISA baseline
#include "lbm/wall_kernels.inc.hpp"
