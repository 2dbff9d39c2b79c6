#include "micromodels/derivation/impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "micromodels/derivation/coat.hpp"
#include "micromodels/derivation/flight.hpp"
#include "micromodels/derivation/one_fine.hpp"

namespace puffin::micromodels::derivation {
namespace {

using std::numbers::pi;

struct CoatedCarrier {
  std::vector<Vector3d> direction;
  std::vector<double> adhesion;  // factor on the median
};

CoatedCarrier coat(const Scene& scene, std::uint64_t seed) {
  CoatedCarrier c;
  c.direction = place_fines(scene.fines, 0.5 * scene.fine_diameter, 0.5 * scene.carrier_diameter, scene.patches, seed);
  std::mt19937_64 random(seed ^ 0x9e3779b97f4a7c15U);
  std::normal_distribution<double> normal;
  for (int n = 0; n < scene.fines; ++n)
    c.adhesion.push_back(scene.spread > 0.0 ? std::exp(scene.spread * normal(random)) : 1.0);
  return c;
}

/// How far carrier and obstacle approach each other beyond first touch [m], generously: fines are softer than carriers.
double reach(const Scene& s, double speed) {
  const double fine = 0.5 * s.fine_diameter;
  const PairContact c =
      s.target == Partner::wall
          ? pair_contact(s.surface, fine, std::numeric_limits<double>::infinity(), 1.0, 1.0, true, 1.0)
          : pair_contact(s.surface, fine, fine, 1.0, 1.0, false, 1.0);
  const double mass = (s.target == Partner::wall ? 1.0 : 0.5) * (carrier_mass(s) + s.fines * fine_mass(s));
  const double one = std::pow(15.0 * mass * speed * speed / (16.0 * c.modulus * std::sqrt(c.radius)), 0.4);
  return std::min(1.5 * one, 2.0 * s.fine_diameter) + 0.3 * fine;
}

/// A carrier and those of its fines that are resolved. side: +1 above the contact, -1 below.
struct Body {
  CoatedCarrier coat;
  std::vector<int> resolved;  // indices of fines
  int first = 0;              // grain of the carrier; its fines follow
};

/// Adds the carrier at the origin with its fines; moved to its place later.
void add_body(const Scene& s, double side, double cap, const Vector3d& velocity, Body& body,
              std::vector<Grain>& grains) {
  const double radius = 0.5 * s.carrier_diameter, fine = 0.5 * s.fine_diameter, mf = fine_mass(s);
  body.first = static_cast<int>(grains.size());
  grains.push_back({Vector3d::Zero(), velocity, Vector3d::Zero(), radius, carrier_mass(s), 1.0, true});
  const Vector3d pole(0, 0, -side);
  for (int k = 0; k < s.fines; ++k) {
    const Vector3d& n = body.coat.direction[static_cast<std::size_t>(k)];
    if ((radius + fine) * (1.0 - n.dot(pole)) > cap) continue;
    const double adhesion = body.coat.adhesion[static_cast<std::size_t>(k)];
    const PairContact c = on_carrier(s, adhesion);
    const double rest = std::pow(0.75 * c.pull / (c.modulus * std::sqrt(c.radius)), 2.0 / 3.0);
    body.resolved.push_back(k);
    grains.push_back({(radius + fine - rest) * n, velocity, Vector3d::Zero(), fine, mf, adhesion, false});
  }
  grains[static_cast<std::size_t>(body.first)].mass += mf * (s.fines - static_cast<double>(body.resolved.size()));
}

/// Lifts grains [0, count) until nothing of them is nearer than 5 nm to the rest (or the wall).
void set_apart(std::vector<Grain>& grains, std::size_t count, bool wall, double high) {
  const auto clear = [&](double lift) {
    for (std::size_t a = 0; a < count; ++a) {
      const Vector3d x = grains[a].position + lift * Vector3d::UnitZ();
      if (wall && x.z() < grains[a].radius + 5e-9) return false;
      for (std::size_t b = count; b < grains.size(); ++b)
        if ((x - grains[b].position).norm() < grains[a].radius + grains[b].radius + 5e-9) return false;
    }
    return true;
  };
  double low = 0.0;
  for (int n = 0; n < 50; ++n) {
    const double middle = 0.5 * (low + high);
    (clear(middle) ? high : low) = middle;
  }
  for (std::size_t a = 0; a < count; ++a) grains[a].position.z() += high;
}

/// The fines that were not resolved, from the motion of their carrier.
void follow_the_rest(const Scene& s, const Body& body, const Motion& motion, const Flight& flight, Outcome& o) {
  const double arm = 0.5 * (s.carrier_diameter + s.fine_diameter), mf = fine_mass(s);
  std::vector<char> resolved(body.coat.direction.size(), 0);
  for (const int k : body.resolved) resolved[static_cast<std::size_t>(k)] = 1;
  const PairContact median = on_carrier(s, 1.0);
  const double weakest = *std::min_element(body.coat.adhesion.begin(), body.coat.adhesion.end());
  double peak = 0.0;
  for (const auto& m : motion) peak = std::max(peak, m.acceleration.norm());
  if (mf * peak > 0.5 * median.pull * weakest) o.lift_off_ratio = lift_off_ratio(median, mf, motion);
  const Vector3d change = motion.back().velocity - motion.front().velocity;
  for (std::size_t k = 0; k < resolved.size(); ++k) {
    if (resolved[k]) continue;
    const Vector3d& n = body.coat.direction[k];
    const double hold = median.pull * body.coat.adhesion[k];
    const MotionSample* lift = nullptr;
    if (o.lift_off_ratio > 0.0)
      for (const auto& m : motion) {
        const double pull = mf * (-m.acceleration.dot(n) + arm * m.spin.cross(n).squaredNorm());
        if (pull > o.lift_off_ratio * hold) {
          lift = &m;
          break;
        }
      }
    if (lift) {
      flight.land((lift->velocity + arm * lift->spin.cross(n)).z(), lift->height + arm * n.z(), o);
      continue;
    }
    const Vector3d along = change + arm * motion.back().spin.cross(n);
    const double rolling = 5.0 / 7.0 * (along - along.dot(n) * n).norm();
    if (mf * rolling * rolling / arm > hold) {
      ++o.detached;
      ++o.rolled;
    } else {
      ++o.stayed;
    }
  }
}

/// The resolved fines of the first carrier, by what they touch at the end.
void count_resolved(const Scene& s, const GrainSystem& system, const Body& body, int other, const Flight& flight,
                    Outcome& o) {
  for (std::size_t k = 0; k < body.resolved.size(); ++k) {
    const int grain = body.first + 1 + static_cast<int>(k);
    if (system.touch(grain, body.first))
      ++o.stayed;
    else if (system.touch(grain, other))
      ++(s.target == Partner::wall ? o.to_wall : o.redeposited);
    else
      flight.land(system.grains()[static_cast<std::size_t>(grain)].velocity.z(),
                  system.grains()[static_cast<std::size_t>(grain)].position.z(), o);
  }
}

/// Whether carrier and obstacle have parted for good.
bool parted(const GrainSystem& system, int other) {
  const auto& g = system.grains();
  const double up = g[0].velocity.z() - (other < 0 ? 0.0 : g[static_cast<std::size_t>(other)].velocity.z());
  if (up <= 0.0 || system.touch(0, other)) return false;
  for (std::size_t k = 1; k < g.size(); ++k)
    if (!g[k].carrier && system.touch(static_cast<int>(k), 0) && system.touch(static_cast<int>(k), other)) return false;
  return true;
}

}  // namespace

double carrier_mass(const Scene& s) { return pi / 6.0 * s.carrier_density * std::pow(s.carrier_diameter, 3); }
PairContact on_carrier(const Scene& s, double adhesion) {
  return pair_contact(s.surface, 0.5 * s.fine_diameter, 0.5 * s.carrier_diameter, fine_mass(s), carrier_mass(s), false,
                      adhesion);
}
double fine_mass(const Scene& s) { return pi / 6.0 * s.fine_density * std::pow(s.fine_diameter, 3); }

void check(const Scene& s) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("derivation: ") + what);
  };
  const auto positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  require(positive(s.carrier_diameter) && positive(s.fine_diameter), "diameters must be > 0");
  require(s.fine_diameter < 0.5 * s.carrier_diameter, "fines must be less than half as large as their carrier");
  require(positive(s.carrier_density) && positive(s.fine_density), "densities must be > 0");
  require(s.fines >= 1, "fines must be 1 or more");
  require(s.patches >= 0, "patches must be 0 (uniform) or more");
  require(std::isfinite(s.spread) && s.spread >= 0.0, "spread must be >= 0");
  for (const Material& m : {s.surface.grains, s.surface.wall}) {
    require(positive(m.youngs_modulus), "Young's moduli must be > 0");
    require(m.poisson >= 0.0 && m.poisson <= 0.5, "Poisson's ratios must lie in [0, 0.5]");
    require(m.yield_pressure > 0.0, "yield pressures must be > 0");
  }
  require(positive(s.surface.surface_energy) && positive(s.surface.cutoff_gap),
          "surface_energy and cutoff_gap must be > 0");
  require(s.surface.restitution > 0.0 && s.surface.restitution <= 1.0, "restitution must lie in (0, 1]");
  require(std::isfinite(s.air_viscosity) && s.air_viscosity >= 0.0, "the air's viscosity must be >= 0");
  require(positive(s.mean_free_path), "the mean free path must be > 0");
  require(std::isfinite(s.surface.friction) && s.surface.friction >= 0.0, "friction must be >= 0");
}

Outcome impact(const Scene& s, double speed, double angle, std::uint64_t seed, Resolve resolve) {
  check(s);
  if (!(speed > 0.0) || !(angle > 0.0 && angle <= 90.0))
    throw std::invalid_argument("derivation: the speed must be > 0 and the angle in (0, 90] degrees");
  const bool wall = s.target == Partner::wall;
  const double a = angle * pi / 180.0;
  const double normal = wall ? speed : speed * std::sin(a);
  const double along = angle == 90.0 ? 0.0 : (wall ? speed / std::tan(a) : speed * std::cos(a));
  const double cap = resolve == Resolve::all ? 10.0 * s.carrier_diameter : reach(s, normal);
  const Vector3d velocity(wall ? along : 0.5 * along, 0.0, wall ? -normal : -0.5 * normal);
  std::vector<Grain> grains;
  Body first, second;
  first.coat = coat(s, 2 * seed);
  add_body(s, 1.0, cap, velocity, first, grains);
  const std::size_t count = grains.size();
  int other = -1;
  if (!wall) {
    second.coat = coat(s, 2 * seed + 1);
    add_body(s, -1.0, cap, -velocity, second, grains);
    other = second.first;
  }
  set_apart(grains, count, wall, 2.0 * (s.carrier_diameter + 2.0 * s.fine_diameter));

  GrainSystem system(std::move(grains), s.surface, wall);
  MotionRecorder recorder(4e-9);
  // Slower than this nothing rebounds in time; sticking carriers end here too.
  const double patience = 20.0 * s.fine_diameter / normal + 2e-6;
  double since_parted = 0.0;
  while (system.time() < patience && since_parted < 3e-8) {
    const double dt = system.step(2e-9);
    recorder.add(dt, system.acceleration(0), system.grains()[0]);
    since_parted = parted(system, other) ? since_parted + dt : 0.0;
  }
  const Motion motion = recorder.finish();
  Outcome o;
  const double up = system.grains()[0].velocity.z();
  const double other_up = wall ? 0.0 : system.grains()[static_cast<std::size_t>(other)].velocity.z();
  const Flight flight(s, up, other_up);
  count_resolved(s, system, first, other, flight, o);
  follow_the_rest(s, first, motion, flight, o);
  o.rebound = (up - other_up) / normal;
  o.deepest = system.deepest_fine_overlap() / (0.5 * s.fine_diameter);
  for (const auto& m : motion) o.peak = std::max(o.peak, m.acceleration.norm());
  return o;
}

HeldOutcome held_in_flow(const Scene& s, double slip, double density, double viscosity, std::uint64_t seed) {
  check(s);
  if (!(slip >= 0.0) || !(density > 0.0) || !(viscosity > 0.0))
    throw std::invalid_argument("derivation: slip must be >= 0, the air's density and viscosity > 0");
  const double radius = 0.5 * s.carrier_diameter, fine = 0.5 * s.fine_diameter;
  const double re = 2.0 * radius * slip * density / viscosity;
  const CoatedCarrier coated = coat(s, 2 * seed);
  HeldOutcome o;
  for (std::size_t k = 0; k < coated.direction.size(); ++k) {
    const double sine = std::hypot(coated.direction[k].x(), coated.direction[k].y());
    const double shear = 1.5 * slip / radius * (1.0 + 0.3 * std::sqrt(re)) * sine;
    const PairContact c = on_carrier(s, coated.adhesion[k]);
    const double force = 1.7009 * 6.0 * pi * viscosity * fine * fine * shear;
    const double moment = 0.944 * 4.0 * pi * viscosity * std::pow(fine, 3) * shear;
    const double lift = 9.22 * density * shear * shear * std::pow(fine, 4);
    const double patch = std::cbrt(0.75 * c.radius * c.pull / c.modulus);  // contact radius at rest
    if (lift > c.pull)
      ++o.lifted;
    else if (force > s.surface.friction * (c.pull - lift))
      ++o.sliding;
    else if (force * fine + moment > (c.pull - lift) * patch)
      ++o.rolling;
  }
  return o;
}

}  // namespace puffin::micromodels::derivation
