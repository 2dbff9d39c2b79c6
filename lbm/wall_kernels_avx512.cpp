// The wall kernels for avx512; the flags are set in lbm/CMakeLists.txt.
#define PUFFIN_ISA avx512
#include "lbm/wall_kernels.inc.hpp"
