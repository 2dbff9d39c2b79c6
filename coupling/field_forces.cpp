#include "coupling/field_forces.hpp"

#include <cmath>
#include <numbers>

#include "coupling/air_steps.hpp"
#include "coupling/near_wall.hpp"
#include "coupling/resting.hpp"

namespace puffin::coupling {
namespace {

using Eigen::Matrix3d;

// A wall is felt in full within 10 radii of a centre, beyond which what it adds fades, to nothing at 15, where it would
// be 4 % along the wall and 8 % across. (Reaching to 30 took four times the exchange's time in the L-bend.)
constexpr double full_reach = 10.0, wall_reach = 15.0;  // radii

double volume_of(const dem::Carriers& c, std::size_t p) {
  return 4.0 / 3.0 * std::numbers::pi * c.carriers[p] * std::pow(c.single_radius[p], 3);
}

/// (1 - e^-x)/x: the mean over an interval of what decays at the rate x in it.
double mean_of_decay(double x) { return x > 1e-8 ? -std::expm1(-x) / x : 1.0; }

/// Gradient of a frozen field, (a,b) = d u_a / d x_b [1/s]; exact for linear fields.
Matrix3d gradient_of(const std::function<Vec3(const Vec3&)>& field, const Vec3& x, double step) {
  Matrix3d gradient;
  for (int d = 0; d < 3; ++d)
    gradient.col(d) = (field(x + step * Vec3::Unit(d)) - field(x - step * Vec3::Unit(d))) / (2.0 * step);
  return gradient;
}

Vec3 curl(const Matrix3d& g) { return {g(2, 1) - g(1, 2), g(0, 2) - g(2, 0), g(1, 0) - g(0, 1)}; }

void add_lift(const Models& m, double interval, const Vec3& vorticity, std::size_t p, State& s) {
  const dem::Carriers& c = s.carriers.carriers;
  dem::Load& load = s.loads[p];
  const double d = 2.0 * c.single_radius[p];
  // The mean slip of the interval, as drag wears it off: the slip at its start would make lift first order in time.
  const Vec3 slip = mean_of_decay(load.drag * interval / c.mass[p]) * (load.air_velocity - motion_of(c, p));
  Vec3 lift = saffman_mei_lift(m.air, d, slip, vorticity);
  if (m.lift == Lift::saffman_magnus && m.carriers.rotation) {
    const Vec3 relative = 0.5 * vorticity - c.spin[p];
    const double k = spin_resistance(m.air, d, relative.norm());
    const double inertia = 0.1 * c.single_mass(p) * d * d;  // of a single carrier
    const double of_entry = 0.4 * c.mass[p] * c.radius[p] * c.radius[p];
    const Vec3 mean = mean_of_decay(k * interval / inertia) * relative;
    lift += magnus_lift(m.air, d, slip, mean);
    load.torque += k * of_entry / inertia * mean;
  }
  load.force += c.carriers[p] * lift;
}

WallFactors factors_at(const Models& m, const dem::Carriers& c, std::vector<dem::WallTouch>& touches, std::size_t p) {
  const double radius = c.single_radius[p];
  m.walls->near(c.position[p], c.radius[p] + (wall_reach - 1.0) * radius, touches);
  if (touches.empty() || !(touches.front().distance > 0.0)) return {};
  const dem::WallTouch* nearest = &touches.front();
  for (const auto& touch : touches)
    if (touch.distance < nearest->distance) nearest = &touch;
  const double gap = std::max(0.0, nearest->distance - c.radius[p]) / radius;  // of the parcel's surface
  const double felt = std::clamp((wall_reach - 1.0 - gap) / (wall_reach - full_reach), 0.0, 1.0);
  return {(c.position[p] - nearest->point) / nearest->distance, 1.0 + felt * (drag_along_wall(1.0 / (1.0 + gap)) - 1.0),
          1.0 + felt * (drag_towards_wall(gap) - 1.0)};
}

}  // namespace

std::vector<WallFactors> find_wall_factors(const Models& m, const State& s) {
  std::vector<WallFactors> factors;
  if (!m.near_wall) return factors;
  const dem::Carriers& c = s.carriers.carriers;
  std::vector<dem::WallTouch> touches;
  for (std::size_t p = 0; p < c.size(); ++p) factors.push_back(factors_at(m, c, touches, p));
  return factors;
}

void add_drag_across(std::span<const WallFactors> factors, std::span<const double> excess, double interval, State& s) {
  const dem::Carriers& c = s.carriers.carriers;
  for (std::size_t p = 0; p < factors.size(); ++p) {
    const Vec3& normal = factors[p].normal;
    dem::Load& load = s.loads[p];
    const double slip = normal.dot(load.air_velocity - motion_of(c, p));
    // The slip across wears off; that of a carrier which does not give way stays.
    const double lasting = rests(c, p) ? 1.0 : mean_of_decay(excess[p] * interval / c.mass[p]);
    load.force += excess[p] * lasting * slip * normal;
  }
}

void add_field_forces(const Models& m, double interval, State& s) {
  const bool averaged = m.volume_fraction == VolumeFraction::averaged;
  const bool pressure = m.pressure_gradient || averaged;
  const bool gradients = m.lift != Lift::none || pressure;
  if (averaged) s.pressure_forces.assign(s.carriers.carriers.size(), Vec3::Zero());
  if (!gradients || (!s.air && !m.frozen_air)) return;
  const dem::Carriers& c = s.carriers.carriers;
  // Of a frozen field that carries fines there are cells, but none was stepped: it is asked itself.
  const bool lattice = computes_air(m, s);
  if (lattice) interpolate_gradients(s.stencils, s.air->moments, c.size(), s.gradients);
  std::vector<std::uint8_t> outside(c.size(), 0);
  if (s.air)
    for (const int p : s.stencils.outside()) outside[p] = 1;
  for (std::size_t p = 0; p < c.size(); ++p) {
    if (outside[p]) continue;
    const Matrix3d gradient = lattice ? Matrix3d(s.gradients.velocity_lu[p] / s.scale.dt)
                                      : gradient_of(m.frozen_air, c.position[p], 0.5 * c.radius[p]);
    if (m.lift != Lift::none) add_lift(m, interval, curl(gradient), p, s);
    if (pressure) {
      const Vec3 slope = lattice
                             ? Vec3(s.gradients.density_excess_lu[p] * (s.scale.pressure_difference(1.0) / s.scale.dx))
                             : Vec3(-m.air.density * (gradient * s.loads[p].air_velocity));
      s.loads[p].force -= volume_of(c, p) * slope;
      if (averaged) s.pressure_forces[p] = -volume_of(c, p) * slope;
    }
  }
}

Vec3 force_beside_drag(std::size_t p, const State& s) {
  return p < s.pressure_forces.size() ? Vec3(s.loads[p].force - s.pressure_forces[p]) : s.loads[p].force;
}

}  // namespace puffin::coupling
