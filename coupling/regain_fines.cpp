#include "coupling/regain_fines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/first_motion.hpp"
#include "coupling/stencil_loop.hpp"

namespace puffin::coupling {

double collection_efficiency(double slip, double carrier_diameter, double fine_diameter, double response_time) {
  const double k = 2.0 * response_time * slip / carrier_diameter, r = fine_diameter / carrier_diameter;
  const double impaction = k > 1.0 / 12.0 ? k * k / ((k + 0.5) * (k + 0.5)) : 0.0;
  return impaction + (1.0 + r) * (1.0 + r) - 1.0 / (1.0 + r);
}

void reattach(const Stencils& stencils, std::span<const double> slip, double duration, double dx,
              const dem::Carriers& carriers, const Regain& regain, Fines& fines, lbm::ScalarFields& fields) {
  if (!(regain.sticking > 0.0)) return;
  std::vector<std::array<double, mechanisms>> gained(carriers.size());
  for_each_by_tile(stencils, [&](int, const Stencil& stencil) {
    const auto p = static_cast<std::size_t>(stencil.carrier);
    gained[p].fill(0.0);
    const double diameter = 2.0 * carriers.single_radius[p];
    const double swept = regain.sticking *
                         collection_efficiency(slip[p], diameter, regain.fine_diameter, regain.response_time) * 0.25 *
                         std::numbers::pi * diameter * diameter * slip[p] * carriers.carriers[p];  // [m^3/s]
    for (const StencilEntry& e : stencils.entries(stencil)) {
      const double part = -std::expm1(-e.weight * swept * duration / (dx * dx * dx));
      for (int m = 0; m < mechanisms; ++m) {
        double& cell = fields.amount[scalar_index(0, static_cast<Mechanism>(m))][e.slot];
        const double before = cell;
        cell = before - part * before;
        gained[p][m] += before - cell;
      }
    }
  });
  for (const Stencil& stencil : stencils.stencils())
    for (int m = 0; m < mechanisms; ++m) {
      const double fines_gained = gained[stencil.carrier][m];
      if (fines_gained == 0.0) continue;
      fines.left[carriers.id[stencil.carrier]] += fines_gained;
      fines.regained[m].add(fines_gained);
    }
}

void pick_up_from_walls(std::span<const dem::ContactBegun> begun, const std::optional<double>& first_motion,
                        const dem::Carriers& carriers, const Regain& regain, Fines& fines) {
  if (!(regain.pick_up > 0.0) || !first_motion) return;
  for (const dem::ContactBegun& contact : begun) {
    if (contact.b >= 0 || contact.time < *first_motion || contact.triangle < 0) continue;
    const int place = place_of(carriers, contact.a);
    if (place < 0) continue;
    double& stuck = fines.stuck.at(contact.triangle);
    const double reach = 2.0 * std::numbers::pi * carriers.single_radius[place] * regain.fine_diameter *
                         carriers.carriers[place] / regain.area.at(contact.triangle);
    const double before = stuck;
    stuck = before - before * regain.pick_up * std::min(1.0, reach);
    const double picked = before - stuck;
    fines.left[contact.a] += picked;
    fines.picked_up.add(picked);
  }
}

}  // namespace puffin::coupling
