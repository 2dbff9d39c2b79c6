#include "cases/settle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "dem/advance.hpp"

namespace puffin::cases {
namespace {

using Vec3 = Eigen::Vector3d;
constexpr double longest = 0.3;  // [s]
constexpr double step = 2e-5;    // [s] between two looks at the whole bed
constexpr double still = 2e-3;   // [m/s] such a speed carries a sphere 0.2 um high
constexpr double give = 0.02;    // overlap that an impact may have, of the diameter
constexpr int looks = 100;       // that must find the whole bed still
constexpr double falls = 5.0;    // times a sphere needs to fall by its diameter: before, still means not yet fast

/// Soft, damped, without adhesion; friction as given, and enough rolling resistance for a heap to stand.
dem::Surfaces soft(const dem::Surfaces& surfaces) {
  dem::LinearContact law;
  std::visit(
      [&](const auto& contact) {
        law.max_overlap = give;
        law.restitution = std::min(contact.restitution, 0.3);
        law.friction = contact.friction;
        law.rolling_friction = std::max(contact.rolling_friction, 0.1);
      },
      surfaces.contact);
  return {law, dem::NoAdhesion{}};
}

/// Throws std::invalid_argument naming the first carrier outside the walls.
void require_inside(const dem::Walls& walls, const dem::Carriers& c, double largest) {
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (c.rest[i] == dem::Rest::asleep || walls.inside(c.position[i])) continue;
    char text[320];
    std::snprintf(
        text, sizeof text,
        "carriers.fill: the bed presses carrier %lld, of %.3g um, through a wall while it settles: the largest, "
        "of %.3g um, are so soft then that they may give by %.3g um. Give sizes nearer to each other (smallest "
        "over largest above %.2g), or places by shape = \"file\"",
        static_cast<long long>(c.id[i]), 2e6 * c.radius[i], 1e6 * largest, 1e6 * give * largest, 2.0 * give);
    throw std::invalid_argument(text);
  }
}

double lowest_of(const std::vector<dem::Carrier>& carriers, const Vec3& up) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& c : carriers) lowest = std::min(lowest, up.dot(c.position) - c.radius);
  return lowest;
}

}  // namespace

SettledBed settle(dem::Models models, const dem::Walls& walls, const std::vector<dem::Carrier>& carriers) {
  if (!(models.gravity.norm() > 0.0))
    throw std::invalid_argument("carriers.fill: a bed settles under gravity; give carriers.gravity");
  models.carrier = soft(models.carrier);
  models.wall = soft(models.wall);
  models.on_wall = dem::OnWall::bounce;
  models.integration.sleep = models.integration.free_flight = true;
  dem::State state;
  dem::add(carriers, state);
  const std::vector<dem::Load> loads(carriers.size());
  dem::Events events;
  SettledBed bed;
  int found_still = 0;
  double diameter = 0.0;
  for (const auto& c : carriers) diameter = std::max(diameter, 2.0 * c.radius);
  const double earliest = falls * std::sqrt(2.0 * diameter / models.gravity.norm());
  while (!bed.at_rest && state.time < longest + earliest) {
    dem::advance(step, models, walls, loads, state, events);
    events.clear();
    if (state.statistics.steps % looks == 0) require_inside(walls, state.carriers, diameter);
    double fastest = 0.0;
    for (const Vec3& v : state.carriers.velocity) fastest = std::max(fastest, v.norm());
    found_still = fastest < still ? found_still + 1 : 0;
    bed.at_rest = (found_still >= looks && state.time > earliest) || dem::count_asleep(state) == carriers.size();
  }
  bed.positions = state.carriers.position;
  bed.time = state.time;
  return bed;
}

double bulk_density(const std::vector<dem::Carrier>& carriers, const Vec3& up) {
  double mass = 0.0, width = 0.0;
  for (const auto& c : carriers) mass += c.mass, width += 2.0 * c.radius / static_cast<double>(carriers.size());
  const Vec3 first = up.unitOrthogonal(), second = up.cross(first);
  const double floor = lowest_of(carriers, up);
  std::map<std::pair<long, long>, double> top;
  for (const auto& c : carriers) {
    const std::pair column(std::lround(first.dot(c.position) / width), std::lround(second.dot(c.position) / width));
    double& height = top[column];
    height = std::max(height, up.dot(c.position) + c.radius - floor);
  }
  double volume = 0.0;
  for (const auto& [column, height] : top) volume += width * width * height;
  return mass / volume;
}

void loosen(double wanted, const Vec3& up, std::vector<dem::Carrier>& carriers) {
  const double settled = bulk_density(carriers, up);
  if (wanted > 1.02 * settled)
    throw std::invalid_argument("carriers.fill.bulk_density: the bed settles at " +
                                std::to_string(std::lround(settled)) +
                                " kg/m^3 with these contacts; give at most that");
  if (settled <= wanted) return;
  // The volume is linear in the factor on the heights: two values tell the factor.
  const double floor = lowest_of(carriers, up);
  const auto lifted = [&](double factor) {
    std::vector<dem::Carrier> bed = carriers;
    for (auto& c : bed) c.position += (factor - 1.0) * (up.dot(c.position) - c.radius - floor) * up;
    return bed;
  };
  const double one = 1.0 / settled, two = 1.0 / bulk_density(lifted(2.0), up);
  carriers = lifted(1.0 + (1.0 / wanted - one) / (two - one));
}

}  // namespace puffin::cases
