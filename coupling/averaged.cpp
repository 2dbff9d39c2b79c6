#include "coupling/averaged.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/volume_fraction.hpp"

namespace puffin::coupling {
namespace {

constexpr double nothing = 1e-7;  // a share of solid that is as good as none

}  // namespace

void follow_volume(const Models& models, int steps, State& s) {
  if (!s.air || !models.two_way || models.volume_fraction != VolumeFraction::averaged) return;
  lbm::PoreSpace& pores = s.pores;
  const bool first = pores.share.empty();
  if (first) pores = lbm::make_pore_space(*s.air);

  const dem::Carriers& c = s.carriers.carriers;
  std::vector<double> volume(c.size());
  for (std::size_t p = 0; p < c.size(); ++p)
    volume[p] = 4.0 / 3.0 * std::numbers::pi * c.carriers[p] * std::pow(c.single_radius[p], 3);
  std::vector<std::int32_t> slots;
  std::vector<double> solid;
  s.spreader.collect(s.stencils, volume, slots, solid);
  // Cells that carriers have left go back to 1.
  std::vector<char> listed(pores.share.size(), 0);
  for (const std::int32_t slot : slots) listed[slot] = 1;
  for (const std::int32_t slot : pores.cells)
    if (!listed[slot] && pores.share[slot] != 1.0) slots.push_back(slot), solid.push_back(0.0);

  const double cell = s.scale.dx * s.scale.dx * s.scale.dx;
  const double part = first ? 1.0 : std::min(1.0, static_cast<double>(steps) / ramp_steps);
  std::vector<double> change(slots.size());
  for (std::size_t n = 0; n < slots.size(); ++n) {
    const double target = 1.0 - std::min(solid[n] / cell, largest_solid_fraction);
    const double far = target - pores.share[slots[n]];
    change[n] = std::abs(far) < nothing ? far : part * far;
    if (!first) change[n] /= steps;
  }
  if (first) {
    for (std::size_t n = 0; n < slots.size(); ++n) pores.share[slots[n]] += change[n], change[n] = 0.0;
  }
  lbm::set_shared(slots, change, *s.air, pores);
}

void share_force(const lbm::PoreSpace& pores, lbm::BodyForce& force) {
  for (const std::int32_t slot : pores.cells) {
    const float by = static_cast<float>(1.0 / pores.share[slot]);
    force.x[slot] *= by, force.y[slot] *= by, force.z[slot] *= by;
  }
}

double least_share(const lbm::PoreSpace& pores) {
  double least = 1.0;
  for (const std::int32_t slot : pores.cells) least = std::min(least, pores.share[slot]);
  return least;
}

}  // namespace puffin::coupling
