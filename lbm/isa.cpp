#include "lbm/isa.hpp"

#include <array>
#include <cstdlib>

namespace puffin::lbm {

Isa hardware_isa() {
#if !defined(__clang__)  // for clang, libstdc++ 12 takes a masked assignment all or none with AVX-512: decision 0010
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
    return Isa::avx512;
#endif
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Isa::avx2;
  return Isa::baseline;
}

Isa detect_isa() { return isa_for(std::getenv("PUFFIN_ISA")); }

const char* name(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return "avx512";
    case Isa::avx2:
      return "avx2";
    case Isa::baseline:
      break;
  }
  return "baseline";
}

std::optional<Isa> isa_named(std::string_view wanted) {
  for (const Isa isa : std::array{Isa::baseline, Isa::avx2, Isa::avx512})
    if (wanted == name(isa)) return isa;
  return std::nullopt;
}

Isa isa_for(const char* wanted) {
  const Isa best = hardware_isa();
  const std::optional<Isa> asked = wanted ? isa_named(wanted) : std::nullopt;
  return asked && *asked < best ? *asked : best;
}

std::string_view isa_problem(const char* wanted) {
  if (!wanted) return {};
  const std::optional<Isa> asked = isa_named(wanted);
  if (!asked) return "is no instruction set; baseline, avx2 and avx512 are";
  if (*asked > hardware_isa()) return "is not offered by this processor; unset it, or name a lesser one";
  return {};
}

}  // namespace puffin::lbm
