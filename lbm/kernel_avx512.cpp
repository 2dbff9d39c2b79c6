// The kernel for avx512; the flags are set in lbm/CMakeLists.txt.
#include "lbm/arithmetic_avx512.hpp"
#define PUFFIN_ISA avx512
#include "lbm/kernel_isa.inc.hpp"
