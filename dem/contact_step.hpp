#pragma once
// One force evaluation of the touches of a cluster. What goes on is computed block by block, in parallel; what begins
// or ends changes velocities, so it follows in the order of the touches (contact_events.cpp).

#include "dem/cluster.hpp"

namespace puffin::dem {

/// The sub-step that ends with an evaluation.
struct Substep {
  double h = 0.0;        // [s]; 0: the forces of the present state
  double time = 0.0;     // its end [s]
  double horizon = 0.0;  // times beyond it need not be told apart [s]
};

/// What touches ask for.
struct Wish {
  double step = 0.0;  // the largest next sub-step [s]
  bool live = false;  // something touches
};

/// Evaluates the touches of one block at the bodies' positions and end velocities (v + kick): forces go to the lanes,
/// springs move. Lanes where something begins or ends are left alone and marked in Cluster::events.
Wish follow_block(std::size_t block, const Substep& substep, const Rules& rules, Cluster& cluster);

/// Makes the touch begin, bond or end, and evaluates it; impulses change the velocities of its bodies at once.
Wish meet_event(std::size_t index, const Substep& substep, const Rules& rules, Cluster& cluster);

/// Of one live touch that goes on, of which `share` [s] of the sub-step belong to this contact.
struct Followed {
  bool event = false;  // it ends or bonds: nothing was changed
  double step = 0.0;   // the largest next sub-step [s]
  double spring = 0.0, dashpot = 0.0;
  Eigen::Vector3d tangential = Eigen::Vector3d::Zero();  // on a [N]
};
Followed follow(std::size_t index, double h, double share, const Rules& rules, Cluster& cluster);

/// Largest sub-step [s] for an oscillation of `stiffness` [N/m]: a part of the contact time of an impact that ends at
/// it.
double allowed_step(const SpringLaw& law, const PairLaw& pair, double stiffness);

/// Keeps the largest overlap of the touch in the cluster's record.
void note_overlap(std::size_t index, Cluster& cluster);

/// Ends a live contact at `time` and logs it; the touch is a candidate again.
void end_contact(double time, std::size_t index, Cluster& cluster);

/// True if two surfaces this far apart [m] touch: a gap below this is rounding of the positions.
inline bool surfaces_meet(double overlap, double radius) { return overlap >= -1e-9 * radius; }

}  // namespace puffin::dem
