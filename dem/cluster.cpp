// The sub-steps of a cluster.

#include "dem/cluster.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "dem/contact_step.hpp"
#include "dem/failure.hpp"
#include "dem/free_flight.hpp"
#include "dem/meeting.hpp"
#include "dem/parts.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;
constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::int64_t most_steps = 50'000'000;         // something must be wrong
constexpr std::int64_t body_steps_unasked = 1'000'000;  // between two questions whether to stop: a fifth of a second
constexpr double longest_way_near_walls = 0.2;          // in radii, between two looks
constexpr double longest_growth = 4.0;                  // of a sub-step against the one before

// A large cluster is shared among threads in parts of this size, some 20 us of work each.
constexpr std::size_t bodies_a_part = 256, blocks_a_part = 64;

/// What one part of the bodies says after an evaluation.
struct Said {
  double step = never;     // the largest next sub-step [s]
  double fastest2 = 0.0;   // square of the largest speed [m^2/s^2]
  double look = never;     // time until a body must look at the walls again [s]
  bool disturbed = false;  // a sleeper must wake
  bool ask_walls = false;  // a body is where its knowledge of the walls ends
  bool live = false;
};

Said merge(const std::vector<Said>& parts) {
  Said all;
  for (const Said& p : parts) {
    all.step = std::min(all.step, p.step), all.look = std::min(all.look, p.look);
    all.fastest2 = std::max(all.fastest2, p.fastest2);
    all.disturbed = all.disturbed || p.disturbed;
    all.ask_walls = all.ask_walls || p.ask_walls;
    all.live = all.live || p.live;
  }
  return all;
}

/// The motion of one cluster over one air step.
class Motion {
 public:
  Motion(double time, double duration, const Rules& rules, const Walls& walls, Cluster& cluster)
      : time_(time), duration_(duration), rules_(rules), walls_(walls), cluster_(cluster) {}
  void run();

 private:
  void evaluate(double h, double horizon);
  void sum_forces(std::size_t i);
  void close_step(std::size_t i, double h, Said& said);
  void kick_and_drift(double h);
  void fly(double h);
  void look_again();

  const double time_, duration_;
  const Rules& rules_;
  const Walls& walls_;
  Cluster& cluster_;
  double elapsed_ = 0.0;
  double step_ = 0.0;  // the largest next sub-step [s]
  double look_ = 0.0;  // time until a body must look at the walls again [s]
  bool live_ = false;  // something touches
  std::vector<Said> said_;
};

/// Contact forces on body i, in the order of its touches.
void Motion::sum_forces(std::size_t i) {
  Body& body = cluster_.bodies[i];
  double force[3] = {0.0, 0.0, 0.0}, torque[3] = {0.0, 0.0, 0.0};
  const bool rolling = rules_.rotation && (rules_.carrier.rolling > 0.0 || rules_.wall.rolling > 0.0);
  const auto add = [&](std::size_t touch, bool second) {
    if (!cluster_.alive[touch]) return;
    const Pull& pull = cluster_.pulls[touch];
    const double sign = second ? -1.0 : 1.0;
    for (int d = 0; d < 3; ++d) force[d] += sign * pull.force[d];
    if (!rules_.rotation) return;
    const double share = second ? 1.0 - pull.share : pull.share;
    for (int d = 0; d < 3; ++d) torque[d] -= share * pull.moment[d];
    if (rolling)
      for (int d = 0; d < 3; ++d) torque[d] += sign * cluster_.touches[touch].rolling_moment[d];
  };
  for (std::int32_t k = cluster_.share_begin[i]; k < cluster_.share_begin[i + 1]; ++k)
    add(cluster_.shares[k].touch, cluster_.shares[k].second);
  for (std::int32_t w = cluster_.records[i].first_wall; w >= 0; w = cluster_.touches[w].next_wall) add(w, false);
  for (int d = 0; d < 3; ++d) body.force[d] = force[d], body.torque[d] = torque[d];
}

/// After an evaluation: acceleration, the closing half kick of the sub-step h, and what the next may be.
void Motion::close_step(std::size_t i, double h, Said& said) {
  Body& body = cluster_.bodies[i];
  BodyRecord& r = cluster_.records[i];
  sum_forces(i);
  if (r.sleeper) {
    const Vector3d change = r.imbalance + vec(body.force);
    if (change.squaredNorm() > r.limit * r.limit) r.disturbed = said.disturbed = true;
  }
  if (r.stuck) r.deviation2 = std::max(r.deviation2, (vec(body.x) - r.start - elapsed_ * r.course).squaredNorm());
  if (r.fixed) return;
  r.drag_force = r.drag * (r.air_velocity - vec(body.v) - vec(body.kick));
  r.acceleration = (vec(body.force) + r.drag_force + r.steady) * body.inverse_mass;
  r.turning = (vec(body.torque) + r.torque) * body.inverse_inertia;
  if (r.drag > 0.0) said.step = std::min(said.step, 0.1 / (r.drag * body.inverse_mass));
  vec(body.v) += 0.5 * h * r.acceleration;
  vec(body.w) += 0.5 * h * r.turning;
  r.drag_impulse += 0.5 * h * r.drag_force;
  vec(body.kick).setZero(), vec(body.twist).setZero();
  r.deviation2 = std::max(r.deviation2, (vec(body.x) - r.start - elapsed_ * r.course).squaredNorm());
  const double speed2 = vec(body.v).squaredNorm();
  said.fastest2 = std::max(said.fastest2, speed2);
  // No body may go further without looking at the walls again.
  const WallCache& cache = cluster_.walls[i];
  double way = cache.clear - body.radius - (vec(body.x) - cache.asked_at).norm();
  if (!cache.planes.empty()) way = std::min(way, longest_way_near_walls * body.radius);
  way = std::max(way, 0.01 * body.radius);
  if (speed2 * said.look * said.look > way * way) said.look = way / std::sqrt(speed2);
}

/// Contact forces at the bodies' places, after a sub-step h (0: of the present state), and what follows from them.
void Motion::evaluate(double h, double horizon) {
  Cluster& c = cluster_;
  const Substep substep{h, time_ + elapsed_, horizon};
  c.events.assign(c.springs.size(), 0);
  said_.assign((c.springs.size() + blocks_a_part - 1) / blocks_a_part, Said{});
  in_parts(c.springs.size(), blocks_a_part, [&](std::size_t part, std::size_t first, std::size_t last) {
    Said& said = said_[part];
    for (std::size_t block = first; block < last; ++block) {
      const Wish wish = follow_block(block, substep, rules_, c);
      said.step = std::min(said.step, wish.step);
      said.live = said.live || wish.live;
    }
  });
  const Said touches = merge(said_);
  step_ = std::min(horizon, touches.step);
  live_ = touches.live;
  for (std::size_t block = 0; block < c.springs.size(); ++block)
    for (std::uint32_t bits = c.events[block], l = 0; bits >> l; ++l) {
      if (!(bits >> l & 1)) continue;
      const Wish wish = meet_event(block * Springs::lanes + l, substep, rules_, c);
      step_ = std::min(step_, wish.step);
      live_ = live_ || wish.live;
    }

  said_.assign((c.bodies.size() + bodies_a_part - 1) / bodies_a_part, Said{});
  in_parts(c.bodies.size(), bodies_a_part, [&](std::size_t part, std::size_t first, std::size_t last) {
    Said said;
    said.look = duration_;
    for (std::size_t i = first; i < last; ++i) close_step(i, h, said);
    said_[part] = said;
  });
  const Said bodies = merge(said_);
  step_ = std::min(step_, bodies.step);
  look_ = bodies.look;
  c.fastest = std::sqrt(bodies.fastest2);
  c.disturbed = c.disturbed || bodies.disturbed;
}

/// Sub-step h: opening half kick and drift. The closing half kick follows the forces.
void Motion::kick_and_drift(double h) {
  said_.assign((cluster_.bodies.size() + bodies_a_part - 1) / bodies_a_part, Said{});
  in_parts(cluster_.bodies.size(), bodies_a_part, [&](std::size_t part, std::size_t first, std::size_t last) {
    bool ask = false;
    for (std::size_t i = first; i < last; ++i) {
      BodyRecord& r = cluster_.records[i];
      if (r.fixed) continue;
      Body& body = cluster_.bodies[i];
      vec(body.kick) = 0.5 * h * r.acceleration;
      vec(body.twist) = 0.5 * h * r.turning;
      vec(body.v) += vec(body.kick);
      vec(body.w) += vec(body.twist);
      r.drag_impulse += 0.5 * h * r.drag_force;
      vec(body.x) += h * vec(body.v);
      ask = ask || beyond_trust(cluster_.walls[i], vec(body.x), body.radius);
    }
    said_[part].ask_walls = ask;
  });
}

/// All bodies in free flight for h.
void Motion::fly(double h) {
  bool ask = false;
  for (std::size_t i = 0; i < cluster_.bodies.size(); ++i) {
    BodyRecord& r = cluster_.records[i];
    if (r.fixed) continue;
    Body& body = cluster_.bodies[i];
    const double inertia = body.inverse_inertia > 0.0 ? 1.0 / body.inverse_inertia : never;
    const Flight end = free_flight(vec(body.x), vec(body.v), vec(body.w), r.mass, inertia, r.load(), r.steady, h);
    vec(body.x) = end.position, vec(body.v) = end.velocity, vec(body.w) = end.spin;
    r.drag_impulse += end.drag_impulse;
    vec(body.kick).setZero(), vec(body.twist).setZero();
    ask = ask || beyond_trust(cluster_.walls[i], vec(body.x), body.radius);
  }
  said_.assign(1, Said{});
  said_[0].ask_walls = ask;
}

void Motion::look_again() {
  if (!merge(said_).ask_walls) return;
  for (std::size_t i = 0; i < cluster_.bodies.size(); ++i) {
    const Body& body = cluster_.bodies[i];
    if (cluster_.records[i].fixed || !beyond_trust(cluster_.walls[i], vec(body.x), body.radius)) continue;
    look_at_walls(walls_, vec(body.x), body.radius, vec(body.v).norm() * (duration_ - elapsed_), cluster_.scratch,
                  cluster_.walls[i]);
    match_walls(static_cast<std::int32_t>(i), time_ + elapsed_, rules_, cluster_);
  }
}

void Motion::run() {
  Cluster& c = cluster_;
  const std::int64_t moving =
      std::count_if(c.records.begin(), c.records.end(), [](const BodyRecord& r) { return !r.fixed; });
  c.fastest = 0.0;
  for (const Body& body : c.bodies) c.fastest = std::max(c.fastest, vec(body.v).squaredNorm());
  c.fastest = std::sqrt(c.fastest);
  evaluate(0.0, duration_);
  const bool in_closed_form = rules_.integration.free_flight;
  const double in_flight = in_closed_form ? never : step_in_flight(rules_, c);
  std::int64_t unasked = 0;
  for (std::int64_t taken = 0; elapsed_ < duration_ && !c.disturbed;) {
    if (++taken > most_steps)
      throw Failure(c.records[0].id, "needs more than 50 million sub-steps in a step of", duration_,
                    "; give shorter steps or a larger max_overlap");
    if ((unasked += std::max<std::int64_t>(moving, 1)) > body_steps_unasked) {
      if (rules_.asked_to_stop && rules_.asked_to_stop()) throw Interrupted();
      unasked = 0;
    }
    const double remaining = duration_ - elapsed_;
    const bool flies = !live_ && in_closed_form;
    double h = std::min(remaining, look_);
    if (flies) {
      const double most = h;
      h = time_of_flight(h, c);
      fly(h);
      if (h < most)  // one of those that were left alone, as nothing was fast, may be the one that is met
        for (Springs& block : c.springs) block.idle_until = 0.0;
    } else {
      h = std::min({h, step_, live_ ? never : in_flight});
      h = remaining / std::ceil(remaining / h * (1.0 - 1e-12));
      kick_and_drift(h);
    }
    elapsed_ = h == remaining ? duration_ : elapsed_ + h;
    look_again();
    const double left = std::max(duration_ - elapsed_, h);
    if (flies)
      evaluate(0.0, left);
    else
      evaluate(h, std::min(left, longest_growth * h));
    c.body_steps += moving;
  }
  if (c.disturbed) return;
  for (std::size_t i = 0; i < c.touches.size(); ++i)
    if (c.alive[i]) note_overlap(i, c);
  in_parts(c.springs.size(), blocks_a_part, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first * Springs::lanes; i < std::min(c.touches.size(), last * Springs::lanes); ++i) {
      if (c.alive[i]) store_contact(i, rules_, c);
      if (!c.alive[i]) c.touches[i].memory.phase = ContactPhase::free;
    }
  });
}

}  // namespace

void integrate(double time, double duration, const Rules& rules, const Walls& walls, Cluster& cluster) {
  // Waiting for its own parts, a thread shall not begin another cluster.
  tbb::this_task_arena::isolate([&] { Motion(time, duration, rules, walls, cluster).run(); });
}

}  // namespace puffin::dem
