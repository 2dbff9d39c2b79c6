// Fines with inertia: how they drift, and what walls take of it.

#include "coupling/fines_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/fines.hpp"
#include "lbm/scalars/advance_scalars.hpp"
#include "tests/coupling/boxes.hpp"

namespace {
using namespace puffin;
using namespace puffin::coupling;
using namespace puffin::coupling::testing;
using Eigen::Vector3d;

/// Faces between air cells are open, all others walls; air at rest.
lbm::FaceFluxes still_air(const lbm::Rows& rows) {
  lbm::FaceFluxes f;
  f.density.assign(rows.slots(), 1.0);
  for (int d = 0; d < 3; ++d) {
    f.mass[d].assign(rows.slots(), 0.0);
    f.open[d].assign(rows.slots(), 0);
    for (std::size_t s = 0; s < rows.slots(); ++s) {
      if (!rows.is_active(s)) continue;
      auto next = rows.cell(s);
      ++next[d];
      f.open[d][s] = rows.active_slot(next[0], next[1], next[2]) >= 0;
    }
  }
  return f;
}

/// A closed box as a mesh, turned about the y axis by `angle`, and the cells inside it.
struct TurnedBox {
  explicit TurnedBox(double angle, double dx) {
    lbm::geometry::TriangleMesh mesh;
    const Vector3d size(2e-3, 2e-3, 1e-3);
    const Eigen::AngleAxisd turn(angle, Vector3d::UnitY());
    for (int n = 0; n < 8; ++n) {
      const Vector3d corner(n & 1 ? size[0] : 0.0, n & 2 ? size[1] : 0.0, n & 4 ? size[2] : 0.0);
      mesh.vertices.push_back(turn * (corner - 0.5 * size));
    }
    const int corners[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int f = 0; f < 6; ++f)
      for (const auto& t : {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{0, 2, 3}}) {
        mesh.triangles.push_back({corners[f][t[0]], corners[f][t[1]], corners[f][t[2]]});
        mesh.solid.push_back(f);
      }
    tree = std::make_unique<lbm::geometry::TriangleTree>(mesh);
    lbm::geometry::Voxels v;
    v.dx = dx;
    const int n = static_cast<int>(3e-3 / dx);
    v.size = {n, n, n};
    v.origin = Vector3d::Constant(-0.5 * dx * (n - 1) + 0.013 * dx);
    v.fill([&](int i, int j, int k) { return tree->inside(v.centre(i, j, k)); });
    rows = lbm::Rows(v);
    fluxes = still_air(rows);
    walls = find_wall_cells(rows, fluxes, *tree, std::vector<char>(12, 0));
  }
  std::unique_ptr<lbm::geometry::TriangleTree> tree;
  lbm::Rows rows;
  lbm::FaceFluxes fluxes;
  std::vector<FinesDrift::WallCell> walls;
};

TEST(FinesDrift, responds_in_the_time_of_stokes_with_slip) {
  // 1520 (1.9e-6)^2 1.09/(18 1.82e-5) = 1.826e-5 s; C_c = 1.089.
  EXPECT_NEAR(response_time(1.9e-6, 1520.0, 1.82e-5), 1.825e-5, 0.01e-5);
  // Metres to micrometres: density ~ 1/length^3, viscosity ~ 1/length; but the mean free path is the air's own.
  EXPECT_NEAR(response_time(1e-4, 1520.0, 1.82e-5) / (1520.0 * 1e-8 / (18.0 * 1.82e-5)), 1.0, 0.002);
}

TEST(FinesDrift, approaches_the_pressure_gradient_with_its_delay) {
  // p = p0 + g x: the drift is tau (g/rho) (1 - exp(-t/tau)), in any pieces of t.
  const auto rows = full_box({12, 6, 6}, 1e-4);
  lbm::FaceFluxes f = still_air(rows);
  const Scale scale{1e-4, 1e-6, 1.2};
  const double gradient = 3e4;  // [Pa/m]
  for (std::size_t s = 0; s < rows.slots(); ++s)
    if (rows.is_active(s))
      f.density[s] =
          1.0 + scale.density_excess_lu(gradient * (rows.centre(s)[0] - rows.centre(rows.active_slot(0, 0, 0))[0]));
  FinesDrift drift;
  drift.response_time = 2e-5;
  DriftVelocity v;
  for (int n = 0; n < 10; ++n) update_drift(rows, f, {}, scale, drift, 3e-6, v);
  const auto s = static_cast<std::size_t>(rows.active_slot(0, 3, 3));  // beside a wall: one-sided, exact for this field
  // The density in the denominator is at most 1 + 3e-4 there.
  EXPECT_NEAR(v[0][s] / (2e-5 * gradient / 1.2 * -std::expm1(-1.5)), 1.0, 5e-4);
  EXPECT_NEAR(v[1][s], 0.0, 1e-12);
}

TEST(FinesDrift, stays_at_rest_where_pressure_holds_the_forces) {
  // A body force and that of carriers on two layers of cells, which the density answers through each face: the air does
  // not turn, so nothing drifts, beside the walls either. To rounding of the densities, some 1e-16 of 1.
  const auto rows = full_box({12, 6, 6}, 1e-4);
  lbm::FaceFluxes f = still_air(rows);
  lbm::BodyForce carriers;
  for (auto* v : {&carriers.x, &carriers.y, &carriers.z}) v->assign(rows.slots(), 0.0F);
  const double everywhere = 1e-4, on_carriers = 0.0078125;  // as floats
  const auto force = [&](int i) { return everywhere + (i == 4 || i == 5 ? on_carriers : 0.0); };
  for (int j = 0; j < 6; ++j)
    for (int k = 0; k < 6; ++k) {
      double density = 1.0;
      for (int i = 0; i < 12; ++i) {
        if (i > 0) density += 1.5 * (force(i - 1) + force(i));
        f.density[rows.active_slot(i, j, k)] = density;
        carriers.x[rows.active_slot(i, j, k)] = static_cast<float>(force(i) - everywhere);
      }
    }
  const Scale scale{1e-4, 1e-6, 1.2};
  FinesDrift drift;
  drift.response_time = 2e-5;
  DriftVelocity v;
  update_drift(rows, f, {{everywhere, 0, 0}, &carriers}, scale, drift, 1e-3, v);
  const double of_the_force = 2e-5 * on_carriers * 1e-4 / 1e-12;  // tau f/rho [m/s]
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(v[0][rows.active_slot(i, 3, 3)], 0.0, 1e-12 * of_the_force) << i;
}

TEST(FinesDrift, lags_behind_air_that_a_force_speeds_up) {
  // Without a pressure the air gains f/rho, and the fines are tau f/rho behind it.
  const auto rows = full_box({12, 6, 6}, 1e-4);
  const lbm::FaceFluxes f = still_air(rows);
  FinesDrift drift;
  drift.response_time = 2e-5;
  DriftVelocity v;
  const double acceleration = 300.0;  // [m/s^2]
  const Scale scale{1e-4, 1e-6, 1.2};
  update_drift(rows, f, {{0, scale.acceleration_lu(acceleration), 0}, nullptr}, scale, drift, 1e-3, v);
  EXPECT_NEAR(v[1][rows.active_slot(0, 3, 3)] / (-2e-5 * acceleration), 1.0, 1e-12);
}

TEST(FinesDrift, beside_a_wall_is_that_of_the_cells_inside) {
  // The layer of cells at the wall is 0.1 % too dense; the air is at rest, so nothing drifts there or into the wall.
  const auto rows = full_box({12, 6, 6}, 1e-4);
  lbm::FaceFluxes f = still_air(rows);
  for (int j = 0; j < 6; ++j)
    for (int k = 0; k < 6; ++k) f.density[rows.active_slot(0, j, k)] = 1.001;
  FinesDrift drift;
  drift.response_time = 2e-5;
  DriftVelocity v;
  update_drift(rows, f, {}, Scale{1e-4, 1e-6, 1.2}, drift, 1e-3, v);
  EXPECT_EQ(v[0][rows.active_slot(0, 3, 3)], 0.0);
  EXPECT_LT(v[0][rows.active_slot(1, 3, 3)], 0.0);  // the cell behind feels the step
}

TEST(FinesDrift, in_a_frozen_vortex_is_the_centrifugal_one) {
  // u = w x r: -(u . grad) u = w^2 r outwards; central differences are exact for a linear field.
  const auto rows = full_box({10, 10, 4}, 1e-4);
  FinesDrift drift;
  drift.response_time = 1e-5;
  const Vector3d w(0, 0, 300.0);
  DriftVelocity v;
  set_frozen_drift(
      rows, [&](const Vector3d& x) { return Vector3d(w.cross(x)); }, drift, v);
  const auto s = static_cast<std::size_t>(rows.active_slot(7, 2, 1));
  const Vector3d x = rows.centre(s);
  EXPECT_NEAR(v[0][s] / (1e-5 * 300.0 * 300.0 * x[0]), 1.0, 1e-9);
  EXPECT_NEAR(v[1][s] / (1e-5 * 300.0 * 300.0 * x[1]), 1.0, 1e-9);
}

TEST(FinesDrift, a_cloud_settles_at_tau_g_and_walls_that_hold_it_off_keep_it) {
  const auto rows = full_box({4, 4, 60}, 1e-4);
  lbm::FaceFluxes f = still_air(rows);
  const Scale scale{1e-4, 1e-3, 1.2};
  FinesDrift drift;
  drift.response_time = 1e-5;
  drift.gravity = {0, 0, -98.1};  // settles at 9.81e-4 m/s: 0.00981 cells a step
  DriftVelocity v;
  for (int n = 0; n < 40; ++n) update_drift(rows, f, {}, scale, drift, 1e-5, v);
  lbm::FluxRoutes routes;
  add_drift(rows, routes, scale, drift, v, f);
  EXPECT_TRUE(f.sinks.empty());
  lbm::ScalarFields fields(rows, 1);
  lbm::ScalarBudget budget(rows, 1, 1);
  for (int k = 35; k < 45; ++k) fields.amount[0][rows.active_slot(1, 1, k)] = 100.0;
  const auto height = [&] {
    double m0 = 0.0, m1 = 0.0;
    for (std::size_t s = 0; s < rows.slots(); ++s)
      if (rows.is_active(s)) m0 += fields.amount[0][s], m1 += fields.amount[0][s] * rows.cell(s)[2];
    return m1 / m0;
  };
  const double before = height();
  lbm::ScalarOptions options;
  options.scalar.resize(1);
  options.scalar[0].scheme = lbm::Scheme::upwind;  // limited slopes do not add up to nothing
  for (int n = 0; n < 100; ++n) lbm::advance_scalars(rows, f, 10.0, options, fields, budget);
  // Uniform speed: the first moment moves exactly with it (rounding); the delay has died out to exp(-40).
  EXPECT_NEAR(before - height(), 1000 * 0.00981, 1e-9);
  for (int n = 0; n < 2000; ++n) lbm::advance_scalars(rows, f, 10.0, options, fields, budget);
  EXPECT_NEAR(lbm::total(fields, 0), 1000.0, 1e-9);
  EXPECT_GT(fields.amount[0][rows.active_slot(1, 1, 0)], 900.0);  // on the floor, not through it
}

TEST(FinesDrift, settling_against_diffusion_ends_as_exp_of_minus_w_z_over_D) {
  // Between floor and lid, k = w dx/D = 0.075 over 40 cells. Drift and diffusion pass the faces together, so the
  // profile of the cells is exact, Y_next = exp(-k) Y_cell; what is left of the start after 4 h^2/D is exp(-40),
  // rounding of 4800 updates 1e-10. If the air moved with the drift, the floor's cells would hold 1 + 0.1 and 1 + 0.8
  // of it at the end of an update.
  const auto rows = full_box({2, 2, 40}, 1e-4);
  const Scale scale{1e-4, 1e-3, 1.2};
  FinesDrift drift;
  drift.response_time = 1e-5;
  drift.gravity = {0, 0, -98.1};  // 0.00981 cells a step
  lbm::FaceFluxes f = still_air(rows);
  DriftVelocity v;
  for (int n = 0; n < 40; ++n) update_drift(rows, f, {}, scale, drift, 1e-5, v);
  add_drift(rows, {}, scale, drift, v, f);
  lbm::ScalarOptions options;
  options.scalar.resize(1);
  constexpr double k = 0.075;
  options.scalar[0].diffusivity = 0.00981 / k;
  for (const int steps : {10, 80}) {
    lbm::ScalarFields fields(rows, 1);
    lbm::ScalarBudget budget(rows, 1, 1);
    for (int z = 0; z < 40; ++z) fields.amount[0][rows.active_slot(0, 0, z)] = 1.0;
    for (int n = 0; n < 48000 / steps; ++n) lbm::advance_scalars(rows, f, steps, options, fields, budget);  // 4 h^2/D
    double worst = 0.0;
    for (int z = 0; z < 40; ++z) {
      const double exact = 10.0 * std::exp(-k * z) * -std::expm1(-k) / -std::expm1(-40.0 * k);  // 40 over four columns
      worst = std::max(worst, std::abs(fields.amount[0][rows.active_slot(1, 1, z)] / exact - 1.0));
    }
    EXPECT_LT(worst, 1e-9) << steps;
  }
}

TEST(FinesDrift, deposits_on_the_floor_what_settles_there_and_the_map_adds_up) {
  const TurnedBox box(0.0, 1e-4);
  const Scale scale{1e-4, 1e-3, 1.2};
  FinesDrift drift;
  drift.response_time = 1e-5;
  drift.gravity = {0, 0, -98.1};
  drift.deposits = true;
  drift.walls = box.walls;
  DriftVelocity v;
  lbm::FaceFluxes f = box.fluxes;
  for (int n = 0; n < 40; ++n) update_drift(box.rows, f, {}, scale, drift, 1e-5, v);
  add_drift(box.rows, {}, scale, drift, v, f);
  lbm::ScalarFields fields(box.rows, mechanisms);
  lbm::ScalarBudget budget(box.rows, mechanisms, 1);
  for (std::size_t s = 0; s < box.rows.slots(); ++s)
    if (box.rows.is_active(s)) fields.amount[0][s] = 1.0;
  Fines fines;
  fines.stuck.assign(12, 0.0);
  fines.placed = {lbm::total(fields, 0)};
  lbm::ScalarOptions options;
  options.scalar.resize(mechanisms);
  for (int n = 0; n < 20; ++n) lbm::advance_scalars(box.rows, f, 10.0, options, fields, budget);
  // A uniform cloud of 10 cells' height: the part t w_s/h comes down, until the upper edge does. At the floor the sink
  // follows the sweep: its cells hold 0.0981 e/(1 - e) = 0.952, e = exp(-0.0981), so 0.048 of a cell's content, of
  // the 1.96 that fall, come at once: 2.4 %; the floor's cells lie 0.013 higher than the floor.
  const double fallen = 200 * 0.00981 / 10.0;
  const Ledger books = ledger(fines, fields, budget, 0);
  EXPECT_NEAR(books.FFW() / fallen, 1.0, 0.06);
  EXPECT_LT(std::abs(books.error()), 1e-12);
  std::vector<int> triangle(box.rows.slots(), -1);
  for (const auto& cell : box.walls)
    if (int& t = triangle[static_cast<std::size_t>(cell.slot)]; t < 0) t = cell.triangle;
  const std::vector<double> map = coupling::wall_map(fines, budget, 0, triangle);
  double sum = 0.0;
  for (const double m : map) sum += m;
  EXPECT_NEAR(sum / books.on_walls, 1.0, 1e-12);
  EXPECT_GT((map[8] + map[9]) / books.on_walls, 0.75);  // the floor; cells in its corners are booked on the sides
}

// Air that turns throws fines at a wall as the square of its speed: beside the floor it flows at half the speed of the
// cells above, so a quarter of their drift arrives. What settles, settles there as everywhere. Exact but for rounding.
TEST(FinesDrift, slower_air_beside_a_wall_throws_less_at_it) {
  const TurnedBox box(0.0, 1e-4);
  const Scale scale{1e-4, 1e-6, 1.2};
  lbm::FaceFluxes f = box.fluxes;
  FinesDrift drift;
  drift.deposits = true;
  drift.response_time = 1e-5;
  for (const auto& cell : box.walls) {
    const Vector3d at = box.rows.centre(cell.slot);
    if (at[2] < -0.4e-3 && std::abs(at[0]) < 0.5e-3 && std::abs(at[1]) < 0.5e-3) drift.walls.push_back(cell);
  }
  ASSERT_EQ(drift.walls.size(), 100u);  // 1 mm x 1 mm of the floor
  for (std::size_t s = 0; s < box.rows.slots(); ++s)
    f.mass[0][s] = box.rows.is_active(s) && box.rows.centre(s)[2] < -0.4e-3 ? 0.01 : 0.02;
  DriftVelocity v;
  for (int d = 0; d < 3; ++d) v[d].assign(box.rows.slots(), d == 2 ? -1.0 : 0.0);
  const auto rate = [&] {
    add_drift(box.rows, {}, scale, drift, v, f);
    double sum = 0.0;
    for (const auto& sink : f.sinks) sum += sink.rate;
    return sum / 100.0;
  };
  EXPECT_NEAR(rate(), 0.25 * scale.velocity_lu(1.0), 1e-12);
  drift.gravity = {0, 0, -4e4};  // tau g = 0.4 of the 1 m/s
  EXPECT_NEAR(rate(), (0.4 + 0.25 * 0.6) * scale.velocity_lu(1.0), 1e-12);
}

TEST(FinesDrift, cells_beside_a_tilted_wall_have_its_area_together) {
  // Faces that look along the wall add up to it but at the edges, where cells see two walls: up to half a cell on each
  // of the edges' 16 mm in 16 mm^2: 5 %.
  const TurnedBox box(0.35, 1e-4);
  double area = 0.0;
  for (const auto& cell : box.walls) area += cell.area * 1e-8;
  EXPECT_NEAR(area / 16e-6, 1.0, 0.05);
}

TEST(FinesDrift, along_a_tilted_wall_deposits_nothing_and_into_it_the_true_flux) {
  const double angle = 0.35;
  const TurnedBox box(angle, 1e-4);
  const Vector3d along = Eigen::AngleAxisd(angle, Vector3d::UnitY()) * Vector3d::UnitX();
  const Vector3d down = Eigen::AngleAxisd(angle, Vector3d::UnitY()) * -Vector3d::UnitZ();
  const Scale scale{1e-4, 1e-6, 1.2};
  FinesDrift drift;
  drift.deposits = true;
  drift.response_time = 1e-5;
  for (const auto& cell : box.walls)
    if (cell.triangle == 8 || cell.triangle == 9) drift.walls.push_back(cell);  // its floor
  const auto flux = [&](const Vector3d& velocity) {
    DriftVelocity v;
    for (int d = 0; d < 3; ++d) v[d].assign(box.rows.slots(), velocity[d]);
    lbm::FaceFluxes f = box.fluxes;
    add_drift(box.rows, {}, scale, drift, v, f);
    double sum = 0.0;
    for (const auto& sink : f.sinks) sum += sink.rate;
    return sum * 1e-8;  // [m^2 cells a step]
  };
  EXPECT_LT(flux(along), 1e-12 * flux(down));
  // Floor of 2 x 2 mm; edges as above: 8 mm of edges, half a cell, in 4 mm^2: 10 %.
  EXPECT_NEAR(flux(down) / (4e-6 * scale.velocity_lu(1.0)), 1.0, 0.1);
}

}  // namespace
