#pragma once
// A small coupled run in which everything that a checkpoint holds is alive within a millisecond: a stream that follows
// a ramp, carriers that hit walls and each other, stick and slide, fines in the air, two sets of scalars.

#include <memory>
#include <vector>

#include "cases/build.hpp"
#include "cases/read_case.hpp"

namespace puffin::coupling {

inline constexpr const char* coupled_scene = R"toml(
schema = 1
name = "coupled"
[geometry]
generator = "duct"
[geometry.duct]
length = "6 mm"
width = "2 mm"
height = "2 mm"
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = [["0 s", "1 L/min"], ["2 ms", "4 L/min"]]
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.25 mm"
[carriers]
diameter = "70 um"
density = "1520 kg/m^3"
fines_each = 2000
fine_mass_ratio = 2e-5
gravity = [0.0, 0.0, -9.81]
list = [
  { position = [1e-3, 1e-3, 36e-6], velocity = [0.5, 0, -1], spin = [10, 0, 0], diameter = 7e-5, density = 1520 },
  { position = [1.1e-3, 1e-3, 36e-6], velocity = [0, 0, 0], spin = [0, 0, 0], diameter = 7e-5, density = 1520 },
  { position = [1.3e-3, 1e-3, 35.5e-6], velocity = [0, 0, 0], spin = [0, 0, 0], diameter = 7e-5, density = 1520 },
  { position = [2e-3, 0.3e-3, 1e-3], velocity = [1, -2, 1], spin = [0, 0, 0], diameter = 7e-5, density = 1520 },
  { position = [3e-3, 1e-3, 1e-3], velocity = [-1, 0, 0], spin = [0, 0, 0], diameter = 7e-5, density = 1520 },
  { position = [2.8e-3, 1.01e-3, 1e-3], velocity = [2, 0, 0], spin = [0, 0, 0], diameter = 7e-5, density = 1520 },
  { position = [5.5e-3, 1e-3, 1e-3], velocity = [3, 0, 0], spin = [0, 0, 0], diameter = 7e-5, density = 1520 },
]
[carriers.contact]
restitution = 0.6
friction = 0.3
[carriers.adhesion]
model = "hamaker"
surface_energy = "3.6e-3 J/m^2"
cutoff_gap = "0.4 nm"
[fines]
micromodels = "lactose-3.6e-3.toml"
wall_deposition = "inertial"
[[fines.scalar]]
name = "one"
diffusion = "1e-6 kg/(m s)"
[[fines.scalar]]
name = "two"
diffusion = "1e-4 kg/(m s)"
wall = "absorb"
[stop]
time = "2 ms"
)toml";

inline std::unique_ptr<cases::Simulation> coupled_simulation(const std::vector<cases::Override>& changed = {}) {
  return cases::build(cases::parse_case(coupled_scene, PUFFIN_SOURCE_DIR "/cases/coupled.toml", changed));
}

}  // namespace puffin::coupling
