#include "micromodels/derivation/grains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace puffin::micromodels::derivation {

double PairContact::normal_force(double overlap, double rate) const {
  if (overlap <= 0.0) {
    const double reach = 1.0 - overlap / gap;
    return -pull / (reach * reach);
  }
  const double root = std::sqrt(radius * overlap);
  return 4.0 / 3.0 * modulus * root * overlap - pull + damping * std::sqrt(2.0 * modulus * root * mass) * rate;
}

double PairContact::stiffness(double overlap) const {
  return overlap > 0.0 ? 2.0 * modulus * std::sqrt(radius * overlap) : 0.0;
}

NormalForce normal_force(const PairContact& c, double overlap, Flattened& f) {
  const double yields_at = std::pow(0.5 * std::numbers::pi * c.yield_pressure / c.modulus, 2) * c.radius;
  const bool yielding = overlap > std::max(f.deepest, yields_at);
  NormalForce n;
  if (yielding) {
    const double at_yield = 4.0 / 3.0 * c.modulus * std::sqrt(c.radius * yields_at) * yields_at;
    const double slope = std::numbers::pi * c.yield_pressure * c.radius;
    const double a2 = c.radius * std::min(overlap, c.radius);
    n.load = at_yield + slope * (std::min(overlap, c.radius) - yields_at);
    f.deepest = overlap;
    f.radius = std::max(c.radius, 4.0 / 3.0 * c.modulus * a2 * std::sqrt(a2) / n.load);
    f.offset = overlap - a2 / f.radius;
    n.overlap = overlap - f.offset;
    n.stiffness = std::max(slope, 2.0 * c.modulus * std::sqrt(a2));  // it may turn round in the next step
    n.adhesion = c.pull * f.radius / c.radius;
    return n;
  }
  const double radius = f.radius > 0.0 ? f.radius : c.radius;
  n.overlap = overlap - f.offset;
  n.adhesion = c.pull * radius / c.radius;
  if (n.overlap > 0.0) {
    const double root = std::sqrt(radius * n.overlap);
    n.load = 4.0 / 3.0 * c.modulus * root * n.overlap;
    n.stiffness = 2.0 * c.modulus * root;
  } else {
    const double reach = 1.0 - n.overlap / c.gap;
    n.adhesion /= reach * reach;
  }
  return n;
}

PairContact pair_contact(const Surface& s, double radius_a, double radius_b, double mass_a, double mass_b, bool wall,
                         double adhesion) {
  const auto compliance = [](const Material& m) { return (1.0 - m.poisson * m.poisson) / m.youngs_modulus; };
  const auto shear = [](const Material& m) { return 2.0 * (2.0 - m.poisson) * (1.0 + m.poisson) / m.youngs_modulus; };
  const Material& other = wall ? s.wall : s.grains;
  PairContact c;
  c.modulus = 1.0 / (compliance(s.grains) + compliance(other));
  c.shear = 1.0 / (shear(s.grains) + shear(other));
  c.radius = 1.0 / (1.0 / radius_a + 1.0 / radius_b);
  c.mass = 1.0 / (1.0 / mass_a + 1.0 / mass_b);
  c.pull = 4.0 * std::numbers::pi * s.surface_energy * c.radius * adhesion;
  c.gap = s.cutoff_gap;
  c.yield_pressure = std::min(s.grains.yield_pressure, other.yield_pressure);
  const double l = std::log(s.restitution);
  c.damping = -2.0 * std::sqrt(5.0 / 6.0) * l / std::sqrt(l * l + std::numbers::pi * std::numbers::pi);
  return c;
}

GrainSystem::GrainSystem(std::vector<Grain> grains, const Surface& surface, bool wall)
    : grains_(std::move(grains)), surface_(surface), wall_(wall), force_(grains_.size()), torque_(grains_.size()) {
  lightest_ = std::numeric_limits<double>::infinity();
  double smallest = lightest_;
  for (const Grain& g : grains_) lightest_ = std::min(lightest_, g.mass), smallest = std::min(smallest, g.radius);
  skin_ = 0.1 * smallest;
  find_pairs();
}

double GrainSystem::overlap(int a, int b) const {
  const Grain& ga = grains_[static_cast<std::size_t>(a)];
  if (b < 0) return ga.radius - ga.position.z();
  const Grain& gb = grains_[static_cast<std::size_t>(b)];
  return ga.radius + gb.radius - (ga.position - gb.position).norm();
}

double GrainSystem::dent(int a, int b) const {
  const auto key = b < 0 ? std::pair(a, b) : std::pair(std::min(a, b), std::max(a, b));
  const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), key,  // they are found in this order
                                      [](const Pair& x, const auto& k) { return std::pair(x.a, x.b) < k; });
  return found != pairs_.end() && std::pair(found->a, found->b) == key ? found->flattened.offset : 0.0;
}

/// Pairs that can meet before something has moved by half the skin; springs are kept.
void GrainSystem::find_pairs() {
  std::vector<Pair> old;
  old.swap(pairs_);
  const double infinite = std::numeric_limits<double>::infinity();
  const auto consider = [&](int a, int b) {
    if (overlap(a, b) < -skin_) return;
    const Grain& ga = grains_[static_cast<std::size_t>(a)];
    const Grain* gb = b < 0 ? nullptr : &grains_[static_cast<std::size_t>(b)];
    Pair pair{a, b,
              pair_contact(surface_, ga.radius, gb ? gb->radius : infinite, ga.mass, gb ? gb->mass : infinite, b < 0,
                           ga.adhesion * (gb ? gb->adhesion : 1.0))};
    const auto found = std::lower_bound(old.begin(), old.end(), std::pair(a, b),
                                        [](const Pair& x, const auto& key) { return std::pair(x.a, x.b) < key; });
    if (found != old.end() && found->a == a && found->b == b) {
      pair.spring = found->spring;
      pair.flattened = found->flattened;
    }
    pairs_.push_back(pair);
  };
  const int n = static_cast<int>(grains_.size());
  for (int a = 0; a < n; ++a) {
    if (wall_) consider(a, -1);
    for (int b = a + 1; b < n; ++b) consider(a, b);
  }
  slack_ = 0.5 * skin_;
}

void GrainSystem::add_forces(Pair& pair, double dt) {
  const std::size_t a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  const Grain& ga = grains_[a];
  const bool wall = pair.b < 0;
  Vector3d normal = Vector3d::UnitZ();  // towards a
  double depth = ga.radius - ga.position.z();
  Vector3d relative = ga.velocity, arms = ga.radius * ga.spin;
  if (!wall) {
    const Grain& gb = grains_[b];
    normal = ga.position - gb.position;
    const double distance = normal.norm();
    normal /= distance;
    depth = ga.radius + gb.radius - distance;
    relative -= gb.velocity;
    arms += gb.radius * gb.spin;
  }
  if (depth - pair.flattened.offset < -40.0 * pair.law.gap) {
    pair.spring.setZero();
    return;
  }
  relative -= arms.cross(normal);
  const double approach = -relative.dot(normal);
  const NormalForce n = normal_force(pair.law, depth, pair.flattened);
  Vector3d force = (n.load - n.adhesion) * normal;
  if (n.overlap > 0.0) {
    if (!ga.carrier || (!wall && !grains_[b].carrier)) deepest_ = std::max(deepest_, depth);
    force += pair.law.damping * std::sqrt(n.stiffness * pair.law.mass) * approach * normal;
    const Vector3d sliding = relative + approach * normal;
    const double contact_radius = 0.5 * n.stiffness / pair.law.modulus;  // of the elastic contact: S = 2 E* a
    const double k = 8.0 * pair.law.shear * contact_radius;
    pair.spring += sliding * dt;
    pair.spring -= pair.spring.dot(normal) * normal;
    Vector3d tangential = -k * pair.spring - pair.law.damping * std::sqrt(k * pair.law.mass) * sliding;
    const double limit = surface_.friction * n.load;
    if (const double size = tangential.norm(); size > limit) {
      tangential *= limit / size;
      pair.spring = -tangential / k;
    }
    force += tangential;
    const Vector3d moment = -normal.cross(tangential);
    torque_[a] += ga.radius * moment;
    if (!wall) torque_[b] += grains_[b].radius * moment;
    stiffest_ = std::max({stiffest_, n.stiffness / pair.law.mass, k / pair.law.mass});
  } else {
    pair.spring.setZero();
    // The fading adhesion has the slope 2 F0/d0 at contact.
    const double reach = 1.0 - n.overlap / pair.law.gap;
    stiffest_ = std::max(stiffest_, 2.0 * n.adhesion / (pair.law.gap * pair.law.mass) / reach);
  }
  force_[a] += force;
  if (!wall) force_[b] -= force;
}

double GrainSystem::step(double longest) {
  for (std::size_t i = 0; i < grains_.size(); ++i) force_[i].setZero(), torque_[i].setZero();
  stiffest_ = 0.0;
  for (Pair& pair : pairs_) add_forces(pair, last_dt_);
  // Several contacts share a fine: their stiffnesses add.
  double dt = std::min(longest, stiffest_ > 0.0 ? 0.2 / std::sqrt(2.0 * stiffest_) : longest);
  double fastest = 0.0;
  for (const Grain& g : grains_) fastest = std::max(fastest, g.velocity.norm());
  if (fastest > 0.0) dt = std::min(dt, 0.25 * skin_ / fastest);
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    Grain& g = grains_[i];
    g.velocity += force_[i] * (dt / g.mass);
    g.spin += torque_[i] * (dt / (0.4 * g.mass * g.radius * g.radius));
    g.position += g.velocity * dt;
  }
  slack_ -= fastest * dt;
  if (slack_ < 0.0) find_pairs();
  time_ += dt;
  last_dt_ = dt;
  return dt;
}

}  // namespace puffin::micromodels::derivation
