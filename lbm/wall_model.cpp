#include "lbm/wall_model.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

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

}  // namespace

WallStress werner_wengle(double speed, double distance, double viscosity) {
  const double laminar = viscosity * speed / distance;
  // x^(7/4) and x^(1/4) by square roots.
  const double x = speed / 8.3, root = std::sqrt(x);
  const double power = x * root * std::sqrt(root) * std::sqrt(std::sqrt(viscosity / distance));
  const double stress = std::max(laminar, power);
  return {stress, std::sqrt(stress) * distance / viscosity};
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
      double area = 0.0;
      for (int i = 1; i < d3q19::q; ++i) {
        if (!(wall.directions >> i & 1U)) continue;
        const auto& c = d3q19::velocity[i];
        area += 6.0 * d3q19::weight[i] * std::max(0.0, place->normal.dot(Vec3(c[0], c[1], c[2])));
      }
      cell.area = static_cast<float>(area);
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
      for (int k = 0; k < 6; ++k) cell.inverse[k] = static_cast<float>(inverse(pairs[k][0], pairs[k][1]));
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
  oneapi::tbb::parallel_for(
      Range(0, model.cells.size(), 512),
      [&](const Range& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          const ModelledCell& cell = model.cells[k];
          const auto m = moments_at(air, cell.probe);
          Vec3 u(m.ux, m.uy, m.uz);
          const Vec3 normal(cell.normal[0], cell.normal[1], cell.normal[2]);
          u -= wall_speed * Vec3(cell.wall[0], cell.wall[1], cell.wall[2]);
          u -= normal.dot(u) * normal;
          const double speed = u.norm();
          float* const target = model.target.data() + 4 * k;
          std::fill_n(target, 4, 0.0F);
          if (!(speed > 1e-12)) continue;
          const WallStress stress = werner_wengle(speed, cell.distance, viscosity);
          for (int d = 0; d < 3; ++d)
            target[d] = static_cast<float>((1.0 + m.density_excess) * stress.over_rho * cell.area * u[d] / speed);
          target[3] = static_cast<float>(std::clamp((stress.y_plus - 5.0) / 10.0, 0.0, 1.0));
        }
      },
      oneapi::tbb::static_partitioner());
}

void impose_wall_stress(Air& air) {
  const WallModel& model = *air.wall_model;
  std::visit(
      [&]<class T>(Populations<T>& p) {
        const Parity last = p.next == Parity::even ? Parity::odd : Parity::even;
        oneapi::tbb::parallel_for(
            Range(0, model.cells.size(), 512),
            [&](const Range& range) {
              for (std::size_t k = range.begin(); k < range.end(); ++k) {
                const ModelledCell& cell = model.cells[k];
                const float* const target = model.target.data() + 4 * k;
                if (!(target[3] > 0.0F)) continue;
                const Run& run = air.rows.runs()[cell.run];
                double density = 0.0;
                for (int i = 0; i < d3q19::q; ++i) density += p.departed(run, cell.slot, i, last);
                double lack[3] = {target[0], target[1], target[2]};
                for (int i = 1; i < d3q19::q; ++i) {
                  if (!(cell.directions >> i & 1U)) continue;
                  const double given = static_cast<double>(p.departed(run, cell.slot, i, last)) +
                                       p.arrived(run, cell.slot, d3q19::opposite(i)) - 2.0 * d3q19::weight[i] * density;
                  for (int d = 0; d < 3; ++d) lack[d] -= given * d3q19::velocity[i][d];
                }
                const auto& v = cell.inverse;
                const double b[3] = {target[3] * (v[0] * lack[0] + v[3] * lack[1] + v[4] * lack[2]),
                                     target[3] * (v[3] * lack[0] + v[1] * lack[1] + v[5] * lack[2]),
                                     target[3] * (v[4] * lack[0] + v[5] * lack[1] + v[2] * lack[2])};
                double mass = 0.0;
                for (int i = 1; i < d3q19::q; ++i) {
                  if (!(cell.directions >> i & 1U)) continue;
                  const auto& c = d3q19::velocity[i];
                  const T gain = static_cast<T>(d3q19::weight[i] * (b[0] * c[0] + b[1] * c[1] + b[2] * c[2]));
                  p.arrived(run, cell.slot, d3q19::opposite(i)) += gain;
                  mass += gain;
                }
                p.f[cell.slot] -= static_cast<T>(mass);  // direction 0
              }
            },
            oneapi::tbb::static_partitioner());
      },
      air.populations);
}

}  // namespace puffin::lbm
