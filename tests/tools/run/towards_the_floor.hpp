#pragma once
// A carrier that meets the floor of a duct, without its place and speed.

#include <string>

namespace puffin::test {

/// Carriers in free flight in a duct of 6 x 2 x 2 mm; nothing but contacts acts on them; steps of 5 us. Hertz contacts
/// have no stiffness beyond their law: how soft the carrier is decides how far it goes in.
inline const std::string towards_the_floor = R"toml(
schema = 1
name = "towards-the-floor"
[geometry]
generator = "duct"
[geometry.duct]
length = "6 mm"
width = "2 mm"
height = "2 mm"
[air]
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = "1 L/min"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.25 mm"
time_step = "5 us"
[carriers]
drag = "none"
two_way = false
gravity = [0.0, 0.0, 0.0]
[carriers.contact]
model = "hertz"
restitution = 0.6
friction = 0.3
poisson = 0.3
)toml";

}  // namespace puffin::test
