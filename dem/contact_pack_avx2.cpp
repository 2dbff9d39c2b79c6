// Packs of contacts for avx2; the flags are set in dem/CMakeLists.txt.
#define PUFFIN_ISA avx2
#include "dem/contact_pack.inc.hpp"
