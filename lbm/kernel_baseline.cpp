// The kernel for baseline; the flags are set in lbm/CMakeLists.txt.
#define PUFFIN_ISA baseline
#include "lbm/kernel_isa.inc.hpp"
