#include "coupling/self_disturbance.hpp"

#include "coupling/lattice_answer.hpp"
#include "coupling/resting.hpp"
#include "coupling/stencil_loop.hpp"

namespace puffin::coupling {
namespace {

constexpr double too_small = 2e-3;  // a lambda that is not worth the while
constexpr double settled = 1e-4;    // a change of lambda after which the next would be a tenth of it

/// oseen_factor() from a table over R/(1 + R), linear between 512 places: within 1e-4.
double tabulated_oseen(double r) {
  constexpr int places = 512;
  static const std::array<double, places + 1> table = [] {
    std::array<double, places + 1> t{};
    for (int n = 0; n < places; ++n) {
      const double x = static_cast<double>(n) / places;
      t[n] = oseen_factor(x / (1.0 - x));
    }
    return t;
  }();
  if (!(r < 1e12)) return table[places];
  const double at = r / (1.0 + r) * places;
  const int n = std::min(static_cast<int>(at), places - 1);
  return table[n] + (at - n) * (table[n + 1] - table[n]);
}

}  // namespace

double self_disturbance(double beta, double slip, double width, double viscosity, double density, double answer) {
  const double psi = answer * tabulated_oseen(density * slip * width / viscosity);
  return std::min(0.8, beta * psi / (6.0 * std::pow(std::numbers::pi, 1.5) * viscosity * width));
}

void take_off_self(const Models& m, std::span<const double> solid, const State& s, std::vector<Vec3>& velocity,
                   std::vector<double>& beta) {
  const dem::Carriers& c = s.carriers.carriers;
  const double cell = s.scale.dx * s.scale.dx * s.scale.dx;
  const double tau = s.scale.relaxation_time(m.air.viscosity / m.air.density);
  for_each_stencil(s.stencils, [&](const Stencil& stencil) {
    const int p = stencil.carrier;
    const Vec3 motion = motion_of(c, p), read = velocity[p] - motion;
    const double slip = read.norm();
    if (stencil.count == 0 || !(slip > 0.0)) return;
    const double d = 2.0 * c.single_radius[p], phi = solid.empty() ? 0.0 : solid[p];
    double share = 1.0;
    if (phi > 0.0) {
      const double own = c.carriers[p] * std::numbers::pi / 6.0 * d * d * d * stencil.squares / cell;
      share = std::min(1.0, own / phi);
    }
    const double width = kernel_width(2.0 * c.radius[p], s.scale.dx);
    const double answer = lattice_answer(width / kernel_width(0.0, s.scale.dx), tau);
    double lambda = 0.0, single = beta[p] / c.carriers[p];
    for (int n = 0; n < 4; ++n) {  // each round leaves a tenth of the error: drag grows as slip^0.1 here
      const double last = lambda;
      lambda = share * self_disturbance(single, slip / (1.0 - lambda), width, m.air.viscosity, m.air.density, answer);
      if (lambda < too_small) return;
      if (std::abs(lambda - last) < settled) break;
      single = drag_coefficient(m.drag, m.air, d, slip / (1.0 - lambda), phi);
    }
    velocity[p] = motion + read / (1.0 - lambda);
    beta[p] = c.carriers[p] * single;
  });
}

}  // namespace puffin::coupling
