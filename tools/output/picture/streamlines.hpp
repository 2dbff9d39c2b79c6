#pragma once
// Lines along the velocity of one stored moment.

#include <vector>

#include "tools/output/frames.hpp"
#include "tools/output/picture/scene.hpp"

namespace puffin::output {

struct StreamPoint {
  Vec3 place;    // [m]
  double speed;  // [m/s]
};
using Streamline = std::vector<StreamPoint>;

/// Velocity [m/s] at a point: linear between the centres of the fluid cells around it, of those alone; false where
/// there is none, or the point's own cell is not fluid.
bool velocity_at(const FieldFrame& field, const Vec3& place, Vec3& velocity);

/// dx/ds = u/|u| through `seed` in both directions, by the midpoint rule with steps of 0.4 cells; ends at walls,
/// openings, where the air rests (|u| below `slowest`), and after `longest` [m] each way.
Streamline trace(const FieldFrame& field, const Vec3& seed, double slowest, double longest);

/// Lines that fill the fluid evenly: seeds are tried in a fixed scattered order, and one beside an earlier line is left
/// out (the idea of B. Jobard & W. Lefer, Visualization in Scientific Computing '97, 43 (1997), with cells of `apart`
/// [m] for their distances). The same field gives the same lines. Throws std::invalid_argument without velocity.
std::vector<Streamline> even_streamlines(const FieldFrame& field, double apart);

}  // namespace puffin::output
