// The flux kernels for avx2; the flags are set in lbm/CMakeLists.txt.
#define PUFFIN_ISA avx2
#include "lbm/flux_kernels.inc.hpp"
