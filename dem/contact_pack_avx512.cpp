// Packs of contacts for avx512; the flags are set in dem/CMakeLists.txt.
#define PUFFIN_ISA avx512
#include "dem/contact_pack.inc.hpp"
