#pragma once
// A cluster: carriers that touch, or may touch, during one air step, on their own copies. Clusters know nothing of each
// other, so they run in parallel and can be thrown away and computed again.

#include <cstdint>
#include <functional>
#include <vector>

#include "dem/body.hpp"
#include "dem/contact.hpp"
#include "dem/events.hpp"
#include "dem/loads.hpp"
#include "dem/models.hpp"
#include "dem/springs.hpp"
#include "dem/surface_law.hpp"
#include "dem/wall_cache.hpp"

namespace puffin::dem {

/// The models, resolved once a step.
struct Rules {
  SurfaceLaw carrier, wall;
  Eigen::Vector3d gravity;
  bool rotation;
  OnWall on_wall;
  Integration integration;
  std::function<bool()> asked_to_stop;
  SpringLaw carrier_springs, wall_springs;  // the same laws, as the sub-steps ask for them
  explicit Rules(const Models& models);
  const SurfaceLaw& law(bool with_wall) const { return with_wall ? wall : carrier; }
  const SpringLaw& springs(bool with_wall) const { return with_wall ? wall_springs : carrier_springs; }
};

/// What the air step keeps of a body, beside what its contacts ask for (body.hpp).
struct BodyRecord {
  std::int32_t carrier = -1;                 // place in State
  std::int32_t first_wall = -1;              // chain of its wall touches, through Touch::next_wall
  bool fixed = false;                        // does not move: asleep, stuck or held
  bool sleeper = false;                      // fixed because asleep: watches the force on it
  bool disturbed = false;                    // a sleeper that must wake
  bool stuck = false;                        // came to hold to a wall in this step
  double drag = 0.0;                         // beta [kg/s]
  Eigen::Vector3d air_velocity, torque;      // of the load [m/s], [N m]
  Eigen::Vector3d steady;                    // load force and weight [N]
  Eigen::Vector3d acceleration, turning;     // of the last force evaluation [m/s^2], [rad/s^2]
  Eigen::Vector3d drag_force, drag_impulse;  // [N], [N s]
  Eigen::Vector3d start, course;             // position and velocity at the start of the air step
  double deviation2 = 0.0;                   // square of the largest distance from the straight course [m^2]
  std::int64_t id = -1;
  double mass = 0.0, single_mass = 0.0, single_radius = 0.0;
  double load_size = 0.0;     // |drag| + |steady| at the start [N]
  Eigen::Vector3d imbalance;  // of a sleeper: change of force by what is outside the cluster [N]
  double limit = 0.0;         // of a sleeper: largest change of force it sleeps through [N]

  Load load() const { return {air_velocity, drag, Eigen::Vector3d::Zero(), torque}; }  // without the steady force
};

/// A live contact of a cluster, or a pair or wall that may become one: what is asked for when it begins or ends. What
/// every sub-step asks for is in its lane of Cluster::springs.
struct Touch {
  Contact memory;               // phase, springs and extremes are those of the lane while the cluster moves
  std::int32_t a = -1, b = -1;  // bodies of the cluster; b = -1: a wall
  std::int32_t place = -1;      // in State::contacts; -1: none yet
  std::int32_t pair = -1;       // of Cluster::pairs
  std::int32_t next_wall = -1;
  double rolling_use = 0.0;                                  // part of the rolling resistance in use
  Eigen::Vector3d rolling_moment = Eigen::Vector3d::Zero();  // on a [N m]
  WallPlane plane;
};

/// The law of a pair, with what it was made from. What every sub-step asks for is in PairConstants.
struct PairNumbers {
  double radius_a = 0.0, radius_b = 0.0, single_a = 0.0, single_b = 0.0;  // [m]
  double inverse_mass = 0.0, strength = 0.0, lightest = 0.0;              // lightest: mass over radius
  bool wall = false;
  PairLaw law;
};

/// A share of a body in a touch, to sum up its forces.
struct Share {
  std::int32_t touch = -1;
  bool second = false;  // it is the b of the touch
};

struct Cluster {
  std::vector<Body> bodies;  // the moving ones first, in the order of their places; then the fixed ones
  std::vector<BodyRecord> records;
  std::vector<WallCache> walls;  // of the bodies; may be longer, to keep its memory
  std::vector<Touch> touches;
  std::vector<Springs> springs;           // touch i: lane i % Springs::lanes of block i / Springs::lanes
  std::vector<std::uint8_t> events;       // of each block: lanes where something begins or ends in this sub-step
  std::vector<std::uint8_t> alive;        // of each touch: it is a live contact, its pull counts
  std::vector<Pull> pulls;                // of each touch, and of the empty lanes of the last block
  std::vector<PairNumbers> pairs;         // each touch has its own, or that of a touch before it
  std::vector<PairConstants> constants;   // of each of the pairs
  std::vector<std::int32_t> share_begin;  // of each body, in `shares`
  std::vector<Share> shares;              // in touches of two bodies, ascending
  std::vector<ContactBegun> begun;
  std::vector<ContactEnded> ended;
  double fastest = 0.0;          // speed of the fastest body at the last evaluation [m/s]
  std::int64_t body_steps = 0;   // moving bodies times sub-steps
  double largest_overlap = 0.0;  // part of the (smaller) diameter
  bool disturbed = false;        // a sleeper must wake: the result is worthless
  std::vector<WallTouch> scratch;
  void clear();
  Springs& block(std::size_t touch) { return springs[touch / Springs::lanes]; }
  const Springs& block(std::size_t touch) const { return springs[touch / Springs::lanes]; }
  bool live(std::size_t touch) const { return block(touch).phase[touch % Springs::lanes] > lane::free; }
};

/// Adds a touch between bodies a and b (b = -1: a wall) with the numbers of the pair; it is a candidate.
std::int32_t add_touch(std::int32_t a, std::int32_t b, const Rules& rules, Cluster& cluster);

/// Makes touch `index`, a candidate, the live contact `memory`.
void restore_contact(std::int32_t index, const Contact& memory, const Rules& rules, Cluster& cluster);

/// Writes the lane of a live touch back to its memory, as it stands at the end of the air step.
void store_contact(std::size_t index, const Rules& rules, Cluster& cluster);

/// Stiffness-dependent numbers of a live touch.
void set_dashpots(std::size_t index, const Rules& rules, Cluster& cluster);

/// Lists the shares of every body, once all pairs have been added.
void list_shares(Cluster& cluster);

/// Makes the wall touches of body `b` those of its wall cache: each plane inherits the contact whose normal is nearest
/// to its own; a live contact that finds no plane ends.
void match_walls(std::int32_t b, double time, const Rules& rules, Cluster& cluster);

/// Time [s] until the first touch of anything, at most `horizon`, while nothing is live.
double time_of_flight(double horizon, const Cluster& cluster);

/// The longest sub-step [s] of a cluster in which nothing touches, where free flight is not taken in closed form
/// (Integration::free_flight): that of the impact on a wall which its bodies, with their present speeds, would have.
double step_in_flight(const Rules& rules, Cluster& cluster);

/// Moves the bodies over `duration` [s] from `time`. Velocity Verlet (kick, drift, kick) with forces at the predicted
/// end velocity (second order also with dashpots and drag); a contact that begins or ends within a sub-step counts for
/// its part of it; while nothing touches, the closed form of free flight up to the next touch. The sub-step is at most
/// t_c/steps_per_contact of each live contact. Stops early if a sleeper is disturbed. Throws
/// Failure for too many sub-steps, Interrupted.
void integrate(double time, double duration, const Rules& rules, const Walls& walls, Cluster& cluster);

}  // namespace puffin::dem
