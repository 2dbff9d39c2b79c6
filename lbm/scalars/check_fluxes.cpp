#include "lbm/scalars/check_fluxes.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "lbm/scalars/run_faces.hpp"

namespace puffin::lbm {

namespace {

std::string place(const Rows& rows, std::ptrdiff_t slot) {
  const auto c = rows.cell(slot);
  return "(" + std::to_string(c[0]) + ", " + std::to_string(c[1]) + ", " + std::to_string(c[2]) + ")";
}

[[noreturn]] void refuse(const Rows& rows, std::ptrdiff_t slot, int d, const std::string& what) {
  throw std::invalid_argument("face fluxes: " + what + " at cell " + place(rows, slot) + ", direction " + "xyz"[d]);
}

}  // namespace

void check_fluxes(const Rows& rows, const FaceFluxes& fluxes, const ScalarWork& work) {
  for (int d = 0; d < 3; ++d)
    if (fluxes.mass[d].size() != rows.slots() || fluxes.open[d].size() != rows.slots())
      throw std::invalid_argument("face fluxes: mass and open must have one value a slot, in each direction");
  if (fluxes.density.size() != rows.slots())
    throw std::invalid_argument("face fluxes: density must have one value a slot");
  for (const auto& eddy : fluxes.eddy)
    if (!eddy.empty() && eddy.size() != rows.slots())
      throw std::invalid_argument("face fluxes: eddy must have one value a slot, or none");
  for (const auto& drift : fluxes.drift)
    if (!drift.empty() && drift.size() != rows.slots())
      throw std::invalid_argument("face fluxes: drift must have one value a slot, or none");
  for (const Run& run : rows.runs())
    for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) {
      if (!(fluxes.density[s] > 0.0)) throw std::invalid_argument("face fluxes: no air in cell " + place(rows, s));
      for (int d = 0; d < 3; ++d)
        for (const bool high : {false, true}) {
          const std::ptrdiff_t beside = s + (high ? offset_high(run, d) : offset_low(run, d));
          const std::ptrdiff_t face = high ? s : beside;
          const auto open = fluxes.open[d][face];
          if (open > 2 && open != passed_over) refuse(rows, s, d, "open must be 0, 1, 2 or passed_over");
          if (open == passed_over && fluxes.mass[d][face] != 0.0) refuse(rows, s, d, "a face passed over has a flux");
          if (open == 0 || open == passed_over || rows.is_active(beside)) continue;
          if (!std::isfinite(fluxes.mass[d][face])) refuse(rows, s, d, "the mass flux is not a number");
          if (open == 2 && work.opening_patch[beside] < 0) refuse(rows, s, d, "an opening without a patch");
          const auto c = rows.cell(beside);
          if (open == 1 && work.opening_patch[beside] >= 0) refuse(rows, s, d, "an opening marked as an inner face");
          if (open == 1 && rows.active_slot(c[0], c[1], c[2]) < 0) refuse(rows, s, d, "open, but no cell behind it");
        }
    }
  for (int d = 0; d < 3; ++d)
    for (const auto& [ghost, cell] : work.periodic[d]) {
      // Only a ghost below the first cell holds a face: that of the cell it mirrors, seen from the other end.
      const auto c = rows.cell(ghost);
      if (c[d] >= 0) continue;
      if (fluxes.open[d][ghost] != fluxes.open[d][cell] || fluxes.mass[d][ghost] != fluxes.mass[d][cell])
        refuse(rows, cell, d, "the periodic face differs from its image");
    }
}

}  // namespace puffin::lbm
