// The flux kernels for baseline; the flags are set in lbm/CMakeLists.txt.
#define PUFFIN_ISA baseline
#include "lbm/flux_kernels.inc.hpp"
