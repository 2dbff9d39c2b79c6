#pragma once
// A small box of frozen air with fines that no carrier brings.

#include <memory>
#include <string>

#include "cases/build.hpp"
#include "cases/read_case.hpp"

namespace puffin::cases {

/// A box of 1.0 x 0.5 x 0.5 mm in cells of 0.1 mm with frozen air; `more` goes to the end, `fines` to [fines].
inline std::unique_ptr<Simulation> scene(const std::string& field, const std::string& sides, const std::string& more,
                                         const std::string& fines = "", const std::string& dx = "0.1 mm") {
  const std::string text = R"toml(
schema = 1
name = "scene"
[geometry]
generator = "box"
[geometry.box]
x = "1 mm"
y = "0.5 mm"
z = "0.5 mm"
[numerics]
dx = ")toml" + dx + R"toml("
[stop]
time = "1 ms"
when_empty = false
[air]
model = "frozen"
density = "1.2 kg/m^3"
viscosity = "1.8e-5 Pa s"
)toml" + field + sides + "\n[fines]\n" +
                           fines + "[[fines.scalar]]\nname = \"cloud\"\n" + more;
  return build(parse_case(text, "scene.toml"));
}

inline constexpr const char* uniform = "field = \"uniform\"\nvelocity = [2.0, 0.0, 0.0]\n";
inline constexpr const char* through =
    "[[air.boundary]]\npatch = \"x-min\"\ntype = \"velocity-inlet\"\nvelocity = \"2 m/s\"\n"
    "[[air.boundary]]\npatch = \"x-max\"\ntype = \"pressure-outlet\"\n";
inline constexpr const char* around = "[[air.boundary]]\npatch = \"x-min\"\ntype = \"periodic\"\nwith = \"x-max\"\n";
inline constexpr const char* cloud =
    "diffusion = \"1.2e-6 kg/(m s)\"\n[fines.scalar.initial]\nshape = \"gaussian\"\ncenter = [2e-4, 2.5e-4, 0.0]\n"
    "sigma = \"0.1 mm\"\namount = 1000.0\n";

inline double sum_of_parts(const coupling::Ledger& l) {
  return l.on_carriers + l.on_emitted_carriers + l.on_walls + l.in_air + l.emitted;
}

}  // namespace puffin::cases
