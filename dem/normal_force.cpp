#include "dem/normal_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/contact_step.hpp"
#include "dem/friction.hpp"

namespace puffin::dem {

single::Normal<double> elastic_force(double overlap, bool rotation, const SurfaceLaw& law, const SpringLaw& springs,
                                     const PairLaw& pair, double eta_pull, single::Spring<double>& c) {
  const bool bonded = c.phase == lane::bonded;
  single::Normal<double> n{};
  n.least = -std::numeric_limits<double>::infinity();
  const bool jkr = law.attraction == Attraction::jkr;
  const double a = jkr ? pair.jkr.contact_radius(overlap) : hertz_radius(pair.radius, overlap);
  n.tangent = hertz_stiffness(law.moduli.normal, a);
  n.eta = 2.0 * law.zeta * std::sqrt(pair.mass * n.tangent);
  if (jkr) {
    n.spring = pair.jkr.force(a);
    n.least = std::min(n.spring, -pair.jkr.pull_off);
    n.lean = 2.0 * pair.jkr.pull_off;
  } else if (bonded && overlap <= 0.0) {  // the spring of a bond in tension; it breaks at F0
    n.spring = pair.pull_stiffness * overlap;
    n.tangent = pair.pull_stiffness;
    n.eta = eta_pull;
    n.lean = pair.pull_off;
  } else {
    n.spring = hertz_force(law.moduli.normal, a, std::max(0.0, overlap)) - pair.constant_pull;
    if (!bonded) n.least = -pair.constant_pull;
    n.lean = pair.constant_pull + (bonded ? pair.pull_off : 0.0);
  }
  // A contact in tension by a bond has no radius; it holds sideways as it holds along the normal.
  const double slip_stiffness = law.tangential_ratio * (bonded ? std::max(n.tangent, pair.pull_stiffness) : n.tangent);
  if (slip_stiffness > c.slip_stiffness && c.slip_stiffness > 0.0)
    for (double& s : c.slip) s *= c.slip_stiffness / slip_stiffness;
  c.slip_stiffness = slip_stiffness;
  c.eta_slip = slip_dashpot(law, rotation, pair.mass, slip_stiffness);
  n.step = allowed_step(springs, pair, std::max(n.tangent, c.stiffness));
  return n;
}

}  // namespace puffin::dem
