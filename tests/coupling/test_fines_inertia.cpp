// Fines with inertia among carriers: what the carriers do to the air does not move the fines by itself.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cases/build.hpp"
#include "cases/read_case.hpp"

namespace puffin::cases {
namespace {

/// A duct of 3 x 0.5 x 0.5 mm, in its middle a bed of heavy carriers (a third of the volume) that air is blown through
/// or not, and within the bed a cloud of fines.
std::string bed(const std::string& ends, const std::string& carriers, const std::string& fines) {
  std::string list;
  for (int n = 0; n < 8 * 6 * 6; ++n) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "{ position = [%.6g, %.6g, %.6g], velocity = [0, 0, 0], spin = [0, 0, 0], diameter = 7e-5, "
                  "density = 1e7 },\n",
                  1e-3 + 83.3e-6 * (n % 8), 42e-6 + 83.2e-6 * (n / 8 % 6), 42e-6 + 83.2e-6 * (n / 48));
    list += text;
  }
  return R"(
schema = 1
name = "bed"
[geometry]
generator = "duct"
[geometry.duct]
length = "3 mm"
width = "0.5 mm"
height = "0.5 mm"
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
)" + ends +
         R"(
[numerics]
dx = "0.1 mm"
reference_speed = "20 m/s"
[carriers]
gravity = [0, 0, 0]
drag = "beetstra"
)" + carriers +
         "list = [\n" + list + R"(]
[fines]
diameter = "1.9 um"
density = 1520
)" + fines +
         R"(
[[fines.scalar]]
name = "cloud"
diffusion = 0
initial = { shape = "gaussian", center = [1.3e-3, 0.25e-3, 0.25e-3], sigma = "0.1 mm", amount = 1000 }
[stop]
time = "1.5 ms"
when_empty = false
)";
}

std::unique_ptr<Simulation> run(const std::string& text, double until) {
  auto sim = build(parse_case(text, "bed.toml"));
  while (sim->state.time < until * (1.0 - 1e-12)) coupling::advance(sim->models, until, sim->state);
  return sim;
}

/// Where the airborne fines are along the duct, on average [m].
double middle(const Simulation& sim) {
  const coupling::State& s = sim.state;
  double all = 0.0, moment = 0.0;
  for (const auto& run : s.air->rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot) {
      all += s.scalars.amount[0][slot];
      moment += s.scalars.amount[0][slot] * s.air->rows.centre(slot)[0];
    }
  return moment / all;
}

constexpr const char* averaged = "volume_fraction = \"averaged\"\n";
constexpr const char* closed =
    "[[air.boundary]]\npatch = \"inlet\"\ntype = \"wall\"\n[[air.boundary]]\npatch = \"outlet\"\ntype = \"wall\"\n";

/// Of the way that the air takes the cloud in 0.4 ms, what it takes it with inertia.
double part_of_the_way(const std::string& carriers) {
  const std::string blown =
      "[[air.boundary]]\npatch = \"inlet\"\ntype = \"velocity-inlet\"\nvelocity = \"2 m/s\"\n"
      "[[air.boundary]]\npatch = \"outlet\"\ntype = \"pressure-outlet\"\n";
  const auto without = run(bed(blown, carriers, "wall_deposition = \"none\""), 0.4e-3);
  const auto with = run(bed(blown, carriers, "wall_deposition = \"drift-only\""), 0.4e-3);
  return (middle(*with) - 1.3e-3) / (middle(*without) - 1.3e-3);
}

// The pressure falls by some kPa through the bed of 0.7 mm: tau grad p/rho is tens of m/s upstream, of air at 2 m/s
// that does not speed up. What is left is tau times its turning within a few cells of walls and the bed's ends,
// 18 us 2^2/0.3 mm = 0.2 m/s on a part of the way.
TEST(FinesInABed, TravelWithTheAirThatTheBedHoldsBack) { EXPECT_NEAR(part_of_the_way(""), 1.0, 0.1); }

// Where alpha changes, at the ends of the bed, the lattice's source of mass leaves a bump and a dip of the density of
// its own size, u grad alpha, over two cells: 1 m/s of drift there and back. In between the fines go with the air.
TEST(FinesInABed, TravelWithTheAirWhereTheBedsVolumeCounts) { EXPECT_NEAR(part_of_the_way(averaged), 1.0, 0.4); }

TEST(FinesInABed, StayInAirAtRest) {
  // What the bed leaves of the cells is no pressure. The air's density stays 1 to rounding of floats, 1e-7 in a cell:
  // tau 1e-7 (20 m/s/0.05)^2/(3 dx) at most, of that the way in 0.1 ms.
  const auto sim = run(bed(closed, averaged, "wall_deposition = \"inertial\""), 0.1e-3);
  const coupling::Ledger books = coupling::ledger(sim->state.fines, sim->state.scalars, sim->state.budget, 0);
  EXPECT_LT(books.on_walls, 1e-6 * books.loaded);
  EXPECT_NEAR(middle(*sim), 1.3e-3, 1e-7);
}

}  // namespace
}  // namespace puffin::cases
