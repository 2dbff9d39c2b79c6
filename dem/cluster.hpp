#pragma once
// A cluster: carriers that touch, or may touch, during one air step, on their own copies. Clusters know nothing of each
// other, so they run in parallel and can be thrown away and computed again.

#include <cstdint>
#include <vector>

#include "dem/contact.hpp"
#include "dem/events.hpp"
#include "dem/loads.hpp"
#include "dem/models.hpp"
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
  explicit Rules(const Models& models)
      : carrier(models.carrier),
        wall(models.wall),
        gravity(models.gravity),
        rotation(models.rotation),
        on_wall(models.on_wall),
        integration(models.integration) {}
};

/// One carrier of a cluster.
struct Body {
  std::int32_t carrier = -1;  // place in State
  std::int64_t id = -1;
  bool fixed = false;      // does not move: asleep, stuck or held
  bool sleeper = false;    // fixed because asleep: watches the force on it
  bool disturbed = false;  // a sleeper that must wake
  bool stuck = false;      // came to hold to a wall in this step
  double radius = 0.0, single_radius = 0.0, single_mass = 0.0, mass = 0.0;
  double inverse_mass = 0.0, inverse_inertia = 0.0;  // 0 if fixed (or without rotation)
  Eigen::Vector3d x, v, w;                           // [m], [m/s], [rad/s]
  Eigen::Vector3d acceleration, turning;             // of the last force evaluation [m/s^2], [rad/s^2]
  Eigen::Vector3d kick, twist;               // half-step changes, so that v + kick is the velocity at the step's end
  Eigen::Vector3d force, torque;             // of the contacts [N], [N m]
  Eigen::Vector3d drag_force, drag_impulse;  // [N], [N s]
  Eigen::Vector3d steady;                    // load force and weight [N]
  Load load;
  double load_size = 0.0;         // |drag| + |steady| at the start [N]
  Eigen::Vector3d start, course;  // position and velocity at the start of the air step
  double deviation = 0.0;         // largest distance from the straight course [m]
  Eigen::Vector3d imbalance;      // of a sleeper: change of force by what is outside the cluster [N]
  std::int32_t first_wall = -1;   // chain of its wall touches, through Touch::next_wall
  double limit = 0.0;             // of a sleeper: largest change of force it sleeps through [N]
};

/// A live contact of a cluster, or a pair or wall that may become one.
struct Touch {
  Contact memory;
  std::int32_t a = -1, b = -1;  // bodies of the cluster; b = -1: a wall
  std::int32_t place = -1;      // in State::contacts; -1: none yet
  bool lost = false;            // a wall place that is no more
  PairLaw pair;
  double reach = 0.0;                                    // R_a + R_b [m]
  double eta = 0.0, eta_pull = 0.0, eta_slip = 0.0;      // dashpots [kg/s]
  double spring_force = 0.0, dashpot_force = 0.0;        // normal, at the last evaluation [N]
  Eigen::Vector3d slip_force = Eigen::Vector3d::Zero();  // tangential, on a [N]
  WallPlane plane;
  std::int32_t next_wall = -1;
  double idle_until = 0.0, latest = 0.0;  // a candidate need not be looked at before, but must be by then [s]
};

struct Cluster {
  std::vector<Body> bodies;      // the moving ones first, in the order of their places; then the fixed ones
  std::vector<WallCache> walls;  // of the bodies; may be longer, to keep its memory
  std::vector<Touch> touches;
  std::vector<ContactBegun> begun;
  std::vector<ContactEnded> ended;
  double fastest = 0.0;          // speed of the fastest body at the last evaluation [m/s]
  std::int64_t body_steps = 0;   // moving bodies times sub-steps
  double largest_overlap = 0.0;  // part of the (smaller) diameter
  bool disturbed = false;        // a sleeper must wake: the result is worthless
  std::vector<WallTouch> scratch;
  void clear();
};

/// Adds a touch between bodies a and b (b = -1: a wall) with the numbers of the pair; memory stays empty.
Touch& add_touch(std::int32_t a, std::int32_t b, const Rules& rules, Cluster& cluster);

/// Stiffness-dependent numbers of a touch, after its memory has been set.
void set_dashpots(const Rules& rules, Touch& touch);

/// Makes the wall touches of body `b` those of its wall cache: each plane inherits the contact whose normal is nearest
/// to its own; a live contact that finds no plane ends.
void match_walls(std::int32_t b, double time, const Rules& rules, Cluster& cluster);

/// Moves the bodies over `duration` [s] from `time`. Velocity Verlet (kick, drift, kick) with forces at the predicted
/// end velocity (second order also with dashpots and drag); a contact that begins or ends within a sub-step counts for
/// its part of it; while nothing touches, the closed form of free flight up to the next touch. The sub-step is at most
/// t_c/steps_per_contact of each live contact. Stops early if a sleeper is disturbed.
void integrate(double time, double duration, const Rules& rules, const Walls& walls, Cluster& cluster);

}  // namespace puffin::dem
