#pragma once
// The same scene by LIGGGHTS (Kloss et al., Prog. Comput. Fluid Dyn. 12, 140 (2012)), if the program is installed.

#include "tools/bench/dem_scenes.hpp"

namespace puffin::bench {

/// True if `liggghts` is found on the path.
bool liggghts_installed();

/// Particle-steps a second of LIGGGHTS with Hertz contacts, tangential history and cohesion, by its own loop time: the
/// scene's carriers, box and contact step, as many processes as `processes` (more than one needs `mpirun`), in a run
/// of about `seconds`. 0 if it could not be run.
double liggghts_speed(const DemScene& scene, int processes, double seconds);

}  // namespace puffin::bench
