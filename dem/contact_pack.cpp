#include "dem/contact_pack.hpp"

#include <cstdlib>
#include <string_view>

namespace puffin::dem {
namespace {

PairContacts* choose() {
  const char* asked = std::getenv("PUFFIN_ISA");
  const std::string_view most = asked ? asked : "avx512";
  if (most == "baseline" || !__builtin_cpu_supports("avx2")) return baseline::pair_contacts();
#if !defined(__clang__)  // as in lbm/isa.cpp: masked assignments are wrong there
  if (most != "avx2" && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return avx512::pair_contacts();
#endif
  return avx2::pair_contacts();
}

}  // namespace

PairContacts* pair_contacts() {
  static PairContacts* const chosen = choose();
  return chosen;
}

}  // namespace puffin::dem
