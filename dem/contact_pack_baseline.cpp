// Packs of contacts for baseline; the flags are set in dem/CMakeLists.txt.
#define PUFFIN_ISA baseline
#include "dem/contact_pack.inc.hpp"
