#include "coupling/drag_limit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>

#include "coupling/volume_fraction.hpp"

#include "tests/coupling/boxes.hpp"

namespace {
using namespace puffin;
using namespace puffin::coupling;
using namespace puffin::coupling::testing;

const Scale scale{2e-4, 4e-7, 1.2};

/// Air and carriers that exchange drag and nothing else: what one coupling step does to them.
struct Exchange {
  Exchange(int count, double drag, double carrier_mass, Eigen::Vector3d low, Eigen::Vector3d high)
      : rows(full_box({16, 16, 16}, scale.dx)),
        cells(rows),
        position(places(rows, count, low, high)),
        velocity(count),
        beta(count, drag),
        mass(carrier_mass),
        air(rows.slots(), Eigen::Vector3d::Zero()),
        spreader(rows.slots()) {
    stencils.build(cells, position, std::vector<double>(count, 0.5e-4), all(position.size()));
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-10.0, 10.0);
    for (auto& v : velocity) v = {uniform(random), uniform(random), uniform(random)};
  }
  /// Velocity of the air at the carriers [m/s].
  Eigen::Vector3d seen(const Stencil& s) const {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (const StencilEntry& e : stencils.entries(s)) u += e.weight * air[e.slot];
    return u;
  }
  void step(double interval, bool limited) {
    std::vector<double> b = beta, scratch(beta.size());
    if (limited) limit_drag(stencils, interval, scale, spreader, scratch, b);
    reduced = b;
    std::vector<Eigen::Vector3d> impulse(beta.size());
    for (const Stencil& s : stencils.stencils()) {
      const int p = s.carrier;
      const double a = interval * b[p] / mass;
      const Eigen::Vector3d v = (velocity[p] + a * seen(s)) / (1.0 + a);  // the mover's implicit drag
      impulse[p] = mass * (v - velocity[p]);
      velocity[p] = v;
    }
    for (const Stencil& s : stencils.stencils())
      for (const StencilEntry& e : stencils.entries(s))
        air[e.slot] -= e.weight * impulse[s.carrier] / scale.cell_mass();
  }
  double largest_slip() const {
    double largest = 0.0;
    for (const Stencil& s : stencils.stencils()) largest = std::max(largest, (seen(s) - velocity[s.carrier]).norm());
    return largest;
  }
  Eigen::Vector3d momentum() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& v : velocity) sum += mass * v;
    for (const auto& u : air) sum += scale.cell_mass() * u;
    return sum;
  }
  lbm::Rows rows;
  CellIndex cells;
  std::vector<Eigen::Vector3d> position, velocity;
  std::vector<double> beta, reduced;
  double mass;
  std::vector<Eigen::Vector3d> air;
  Spreader spreader;
  Stencils stencils;
};

/// sum_p b_p |s_p|^2: the norm in which the slips must decay.
double norm(const Exchange& x) {
  double sum = 0.0;
  for (const Stencil& s : x.stencils.stencils())
    sum += x.reduced[s.carrier] * (x.seen(s) - x.velocity[s.carrier]).squaredNorm();
  return sum;
}

TEST(DragLimit, OneHeavyCarrierUnderAnyDragBringsItsAirToItsOwnSpeed) {
  // b = beta/G and K b D = 1 for one carrier: the sampled velocity becomes the carrier's in one step; rounding only.
  Exchange x(1, 1.0, 1e-6, {7, 7, 7}, {8, 8, 8});
  const double before = x.largest_slip();
  x.step(2 * scale.dt, true);
  EXPECT_LT(x.largest_slip(), 1e-6 * before);  // the carrier itself slows by 1/(K m) = 1e-13/1e-6
}

TEST(DragLimit, AThousandCarriersInAFewCellsNeverOvershoot) {
  // sum beta D / (rho dx^3) of a cell: 1,000 * 1e-7 * 8e-7 / 9.6e-15 / 27 = 0.3, and 30,000 with the larger drag. The
  // norm may not grow by more than rounding.
  for (const double drag : {1e-7, 1e-2}) {
    for (const double mass : {3e-10, 3e-3}) {
      Exchange x(1000, drag, mass, {6, 6, 6}, {8, 8, 8});
      const Eigen::Vector3d momentum = x.momentum();
      double exchanged = 0.0;
      for (const auto& v : x.velocity) exchanged += mass * v.norm();
      x.step(2 * scale.dt, true);
      double last = norm(x);
      for (int n = 0; n < 50; ++n) {
        x.step(2 * scale.dt, true);
        const double now = norm(x);
        EXPECT_LE(now, last * (1.0 + 1e-12)) << drag << ' ' << mass;
        last = now;
      }
      EXPECT_LT((x.momentum() - momentum).norm(), 1e-12 * exchanged) << drag << ' ' << mass;
    }
  }
}

TEST(DragLimit, WithoutItTheSameLoadBlowsUp) {
  Exchange x(1000, 1e-2, 3e-3, {6, 6, 6}, {8, 8, 8});  // heavy carriers: nothing but the air can give way
  const double first = x.largest_slip();
  for (int n = 0; n < 10; ++n) x.step(2 * scale.dt, false);
  EXPECT_GT(x.largest_slip(), 1e3 * first);
}

TEST(DragLimit, TheBoundIsNeverBelowTheLoad) {
  // Loads found by limit_drag itself (`scratch`), for carriers of unequal drag and volume; 1e-12 for rounding.
  Exchange x(1000, 1e-7, 3e-10, {6, 6, 6}, {8, 8, 8});
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  std::vector<double> volume, load(1000), fraction(1000);
  for (double& b : x.beta) {
    b *= uniform(random);
    volume.push_back(1.8e-13 * uniform(random));
  }
  const double largest = solid_fraction(x.stencils, volume, scale.dx, x.spreader, fraction);
  const double bound = load_bound(largest, x.beta, volume, scale.dt, scale);
  std::vector<double> beta = x.beta;
  limit_drag(x.stencils, scale.dt, scale, x.spreader, load, beta);
  EXPECT_LE(*std::max_element(load.begin(), load.end()), bound * (1.0 + 1e-12));
}

/// Largest growth an interval of N steps of a motion y' = mu (y + a), a = -load s/N, under the sample s of the interval
/// before, the mean of two instants as air_steps.cpp takes it: the larger root of the map of (y, s).
double growth(std::complex<double> mu, int steps, double load) {
  using Complex = std::complex<double>;
  const auto interval = [&](Complex y, Complex sample) {
    const Complex a = -load / steps * sample;
    Complex before = y;
    for (int n = 0; n < steps; ++n) before = y, y = mu * (y + a);
    const Complex at_step = before + 0.5 * a, other = (steps == 1 ? y : before / mu - a) + 0.5 * a;
    return std::array{y, 0.5 * (at_step + other)};
  };
  const auto one = interval(1.0, 0.0), two = interval(0.0, 1.0);
  const Complex half = 0.5 * (one[0] + two[1]), root = std::sqrt(half * half - one[0] * two[1] + one[1] * two[0]);
  return std::max(std::abs(half + root), std::abs(half - root));
}

// What the limits are chosen by (drag_limit.hpp). 1e-6: a double root of 1 is known to the root of the rounding.
TEST(DragLimit, NoMotionOfTheAirGrowsUnderTheLoadsThatNeedNoLimit) {
  for (int n = 0; n <= 720; ++n) {
    const double angle = M_PI * n / 720;
    EXPECT_LT(growth(std::polar(1.0, angle), 1, largest_load(1)), 1.0 + 1e-6) << "one step, undamped";
    // Sound of angular speed theta a step has the wave number theta/c_s; bulk viscosity 1/9 damps it by
    // exp(-k^2/18) a step, k^2 = 3 theta^2: 0.167 theta^2.
    const auto sound = std::polar(std::exp(-angle * angle / 6.0), angle);
    for (const int steps : {2, 3, 5, 8, 9, 16, 17, 32, 64})
      EXPECT_LT(growth(sound, steps, largest_load(steps)), 1.0 + 1e-6) << steps << ' ' << angle;
  }
  for (const int steps : {1, 2, 3, 5, 8, 16, 64}) {
    EXPECT_LT(growth(1.0, steps, largest_load(steps)), 0.9) << "what stays decays";
    EXPECT_LT(growth(-1.0, steps, largest_load(steps)), 1.0 + 1e-6) << "what changes sign from step to step";
  }
}

TEST(DragLimit, ABedBelowTheLimitKeepsItsDragExactly) {
  // G_p <= max_j g_j <= 1,000 * beta D / (rho dx^3) * (largest weight 8/27) = 0.25: no change of any bit.
  Exchange x(1000, 1e-11, 3e-10, {6, 6, 6}, {8, 8, 8});
  x.step(scale.dt, true);
  EXPECT_EQ(x.reduced, x.beta);
}
}  // namespace
