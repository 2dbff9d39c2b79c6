// The flux kernels for avx512; the flags are set in lbm/CMakeLists.txt.
#define PUFFIN_ISA avx512
#include "lbm/flux_kernels.inc.hpp"
