// The kernel for avx512; the flags are set in lbm/CMakeLists.txt.
#define PUFFIN_ISA avx512
#include "lbm/kernel_isa.inc.hpp"
