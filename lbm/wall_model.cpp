#include "lbm/wall_model.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "lbm/air.hpp"

namespace puffin::lbm {

using geometry::Vec3;

namespace {

using Range = oneapi::tbb::blocked_range<std::size_t>;

/// Pseudo-inverse of sum w_i c_i c_i within the plane across `normal`; directions no link points in stay as they are.
Eigen::Matrix3d inverse_in_plane(std::uint32_t directions, const Vec3& normal) {
  Eigen::Matrix3d k = Eigen::Matrix3d::Zero();
  for (int i = 1; i < d3q19::q; ++i) {
    if (!(directions >> i & 1U)) continue;
    const auto& c = d3q19::velocity[i];
    const Vec3 v(c[0], c[1], c[2]);
    k += d3q19::weight[i] * v * v.transpose();
  }
  const Eigen::Matrix3d plane = Eigen::Matrix3d::Identity() - normal * normal.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(plane * k * plane);
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  for (int n = 0; n < 3; ++n)
    if (solver.eigenvalues()[n] > 0.2 / 18.0)  // a plane wall along the grid has 1/18
      inverse += solver.eigenvectors().col(n) * solver.eigenvectors().col(n).transpose() / solver.eigenvalues()[n];
  return plane * inverse * plane;
}

/// Where the populations of a cell lie, less its slot: all that its run decides.
struct Places {
  std::int32_t run = -1;
  std::ptrdiff_t at[d3q19::q] = {};

  /// Of those that arrived for a step of kind `next`.
  void arrived(const Run& r, std::int32_t index, std::size_t stride, Parity next) {
    if (index == run) return;
    run = index;
    for (int i = 0; i < d3q19::q; ++i) {
      const int o = d3q19::opposite(i);
      at[i] = next == Parity::even ? static_cast<std::ptrdiff_t>(i * stride)
                                   : static_cast<std::ptrdiff_t>(o * stride) + neighbour_offset(r, o);
    }
  }
  /// Of those that left in a step of kind `last`: where the opposite ones had arrived for it.
  void departed(const Run& r, std::int32_t index, std::size_t stride, Parity last) {
    if (index == run) return;
    arrived(r, index, stride, last);
    for (int i = 1; i < d3q19::q; i += 2) std::swap(at[i], at[d3q19::opposite(i)]);
  }
};

}  // namespace

WallStress werner_wengle(double speed, double distance, double viscosity) {
  const double laminar = viscosity * speed / distance;
  // x^(7/4) and x^(1/4) by square roots.
  const double x = speed / 8.3, root = std::sqrt(x);
  const double power = x * root * std::sqrt(root) * std::sqrt(std::sqrt(viscosity / distance));
  const double stress = std::max(laminar, power);
  return {stress, std::sqrt(stress) * distance / viscosity};
}

WallStress reichardt(double speed, double distance, double viscosity) {
  constexpr double kappa = 0.41, c = 7.8;
  double u_tau = std::sqrt(werner_wengle(speed, distance, viscosity).over_rho);
  for (int n = 0; n < 2 && u_tau > 0.0; ++n) {
    const double y = u_tau * distance / viscosity, slow = std::exp(-y / 11.0), fast = std::exp(-y / 3.0);
    const double u_plus = std::log1p(kappa * y) / kappa + c * (1.0 - slow - y / 11.0 * fast);
    const double slope = 1.0 / (1.0 + kappa * y) + c / 11.0 * (slow - fast + y / 3.0 * fast);
    u_tau -= (u_tau * u_plus - speed) / (u_plus + y * slope);
  }
  return {u_tau * u_tau, u_tau * distance / viscosity};
}

WallModel find_modelled_cells(const Rows& rows, const Links& links, const LinkGeometry& surface) {
  WallModel model;
  const WallSides sides(rows, surface, 6.0);
  for (const WallRun& wall : links.walls)
    for (int n = 0; n < wall.count; ++n) {
      ModelledCell cell;
      cell.slot = wall.first + n;
      cell.run = wall.run;
      cell.directions = wall.directions;
      const WallPlace* place = sides.of(cell.slot);
      if (place == nullptr) continue;
      const Eigen::Matrix3d plane = Eigen::Matrix3d::Identity() - place->normal * place->normal.transpose();
      Eigen::Matrix3d area = Eigen::Matrix3d::Zero();
      for (int i = 1; i < d3q19::q; ++i) {
        if (!(wall.directions >> i & 1U)) continue;
        const auto& c = d3q19::velocity[i];
        const Vec3 along = plane * Vec3(c[0], c[1], c[2]);
        area += 18.0 * d3q19::weight[i] * std::max(0.0, place->normal.dot(Vec3(c[0], c[1], c[2]))) * along *
                along.transpose();
      }
      cell.probe = cell.slot;
      double distance = std::max(place->distance / rows.dx(), 0.1);
      const Vec3 at = (place->point - 2.5 * rows.dx() * place->normal - rows.origin()) / rows.dx();
      const std::ptrdiff_t probe =
          rows.active_slot(static_cast<int>(std::lround(at[0])), static_cast<int>(std::lround(at[1])),
                           static_cast<int>(std::lround(at[2])));
      const WallPlace* beside = probe >= 0 ? sides.of(probe) : nullptr;
      if (beside != nullptr && beside->distance > place->distance) {
        cell.probe = probe;
        distance = beside->distance / rows.dx();
      }
      cell.distance = static_cast<float>(distance);
      const Eigen::Matrix3d inverse = inverse_in_plane(wall.directions, place->normal);
      const int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
      for (int k = 0; k < 6; ++k) {
        cell.inverse[k] = static_cast<float>(inverse(pairs[k][0], pairs[k][1]));
        cell.area[k] = static_cast<float>(area(pairs[k][0], pairs[k][1]));
      }
      const auto& boundary = surface.boundaries[surface.patch_of_triangle[place->triangle]];
      const Vec3 u = boundary.profile ? boundary.profile(place->point) : Vec3(Vec3::Zero());
      for (int d = 0; d < 3; ++d) {
        cell.normal[d] = static_cast<float>(place->normal[d]);
        cell.wall[d] = static_cast<float>(u[d]);
      }
      model.cells.push_back(cell);
    }
  model.target.assign(4 * model.cells.size(), 0.0F);
  std::vector<std::int32_t> run_of(rows.slots(), -1);
  for (std::size_t r = 0; r < rows.runs().size(); ++r)
    std::fill_n(run_of.begin() + rows.runs()[r].first, rows.runs()[r].count, static_cast<std::int32_t>(r));
  for (ModelledCell& cell : model.cells) cell.probe_run = run_of[cell.probe];
  return model;
}

void find_wall_stress(double viscosity, double wall_speed, Air& air) {
  WallModel& model = *air.wall_model;
  const auto cells = [&]<class T>(const Populations<T>& p, const Range& range) {
    Places places;
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const ModelledCell& cell = model.cells[k];
      places.arrived(air.rows.runs()[cell.probe_run], cell.probe_run, p.stride, p.next);
      double drho = 0.0;
      Vec3 u = Vec3::Zero();
#pragma GCC unroll 19
      for (int i = 0; i < d3q19::q; ++i) {
        const double f = p.f[places.at[i] + cell.probe];
        const auto& c = d3q19::velocity[i];
        drho += f;
        for (int d = 0; d < 3; ++d) u[d] += f * c[d];
      }
      u /= 1.0 + drho;
      const Vec3 normal(cell.normal[0], cell.normal[1], cell.normal[2]);
      u -= wall_speed * Vec3(cell.wall[0], cell.wall[1], cell.wall[2]);
      u -= normal.dot(u) * normal;
      const double speed = u.norm();
      float* const target = model.target.data() + 4 * k;
      std::fill_n(target, 4, 0.0F);
      if (!(speed > 1e-12)) continue;
      const WallStress stress = reichardt(speed, cell.distance, viscosity);
      const double per_speed = (1.0 + drho) * stress.over_rho / speed;
      const auto& a = cell.area;
      target[0] = static_cast<float>(per_speed * (a[0] * u[0] + a[3] * u[1] + a[4] * u[2]));
      target[1] = static_cast<float>(per_speed * (a[3] * u[0] + a[1] * u[1] + a[5] * u[2]));
      target[2] = static_cast<float>(per_speed * (a[4] * u[0] + a[5] * u[1] + a[2] * u[2]));
      target[3] = static_cast<float>(std::clamp((stress.y_plus - 5.0) / 10.0, 0.0, 1.0));
    }
  };
  std::visit(
      [&](const auto& p) {
        oneapi::tbb::parallel_for(
            Range(0, model.cells.size(), 512), [&](const Range& range) { cells(p, range); },
            oneapi::tbb::static_partitioner());
      },
      air.populations);
}

void impose_wall_stress(Air& air) {
  const WallModel& model = *air.wall_model;
  const auto cells = [&]<class T>(Populations<T>& p, const Range& range) {
    const Parity last = p.next == Parity::even ? Parity::odd : Parity::even;
    Places left, back;
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const ModelledCell& cell = model.cells[k];
      const float* const target = model.target.data() + 4 * k;
      if (!(target[3] > 0.0F)) continue;
      const Run& run = air.rows.runs()[cell.run];
      left.departed(run, cell.run, p.stride, last);
      back.arrived(run, cell.run, p.stride, p.next);
      T* const f = p.f.data() + cell.slot;
      double density = 0.0;
#pragma GCC unroll 19
      for (int i = 0; i < d3q19::q; ++i) density += f[left.at[i]];
      double lack[3] = {target[0], target[1], target[2]};
      for (std::uint32_t rest = cell.directions; rest != 0; rest &= rest - 1) {
        const int i = std::countr_zero(rest);
        const auto& c = d3q19::velocity[i];
        const double given =
            static_cast<double>(f[left.at[i]]) + f[back.at[d3q19::opposite(i)]] - 2.0 * d3q19::weight[i] * density;
        for (int d = 0; d < 3; ++d) lack[d] -= given * c[d];
      }
      const auto& v = cell.inverse;
      const double b[3] = {target[3] * (v[0] * lack[0] + v[3] * lack[1] + v[4] * lack[2]),
                           target[3] * (v[3] * lack[0] + v[1] * lack[1] + v[5] * lack[2]),
                           target[3] * (v[4] * lack[0] + v[5] * lack[1] + v[2] * lack[2])};
      double mass = 0.0;
      for (std::uint32_t rest = cell.directions; rest != 0; rest &= rest - 1) {
        const int i = std::countr_zero(rest);
        const auto& c = d3q19::velocity[i];
        const T gain = static_cast<T>(d3q19::weight[i] * (b[0] * c[0] + b[1] * c[1] + b[2] * c[2]));
        f[back.at[d3q19::opposite(i)]] += gain;
        mass += gain;
      }
      f[0] -= static_cast<T>(mass);  // direction 0
    }
  };
  std::visit(
      [&](auto& p) {
        oneapi::tbb::parallel_for(
            Range(0, model.cells.size(), 512), [&](const Range& range) { cells(p, range); },
            oneapi::tbb::static_partitioner());
      },
      air.populations);
}

}  // namespace puffin::lbm
