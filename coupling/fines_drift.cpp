#include "coupling/fines_drift.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lbm/scalars/run_faces.hpp"

namespace puffin::coupling {

namespace {

constexpr double no_rise = std::numeric_limits<double>::infinity();  // instead of a rise: nothing beyond the face

/// Calls visit(slot, run) for every active cell, chunk by chunk in parallel.
template <class Visit>
void for_each_cell(const lbm::Rows& rows, const Visit& visit) {
  tbb::parallel_for(std::size_t{0}, rows.chunks().size(), [&](std::size_t c) {
    for (int r = rows.chunks()[c].first_run; r < rows.chunks()[c].last_run; ++r) {
      const lbm::Run& run = rows.runs()[r];
      for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) visit(s, run);
    }
  });
}

void size_for(const lbm::Rows& rows, DriftVelocity& velocity) {
  for (auto& v : velocity) v.resize(rows.slots(), 0.0);
}

/// Ghosts of periodic faces stand for the cells that they mirror.
void mirror(const lbm::Rows& rows, std::vector<double>& values) {
  for (const auto& [ghost, cell] : rows.periodic_images()) values[ghost] = values[cell];
}

std::vector<int> runs_by_slot(const lbm::Rows& rows) {
  std::vector<int> run_of(rows.slots(), -1);
  for (std::size_t r = 0; r < rows.runs().size(); ++r)
    std::fill_n(run_of.begin() + rows.runs()[r].first, rows.runs()[r].count, static_cast<int>(r));
  return run_of;
}

FinesDrift::Place place_of(std::ptrdiff_t slot, const lbm::Run& run) {
  FinesDrift::Place place{slot, {}};
  for (int d = 0; d < 3; ++d) place.low[d] = slot + lbm::offset_low(run, d);
  return place;
}

/// Four times the square of the air's mass flux in a cell.
double flow_squared(const lbm::FaceFluxes& fluxes, const FinesDrift::Place& p) {
  double sum = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double twice = fluxes.mass[d][p.slot] + fluxes.mass[d][p.low[d]];
    sum += twice * twice;
  }
  return sum;
}

/// Drift towards its wall [m/s]: settling, and what the air's turning causes.
double drift_into_wall(const FinesDrift& drift, const DriftVelocity& velocity, const lbm::FaceFluxes& fluxes,
                       const FinesDrift::WallCell& cell) {
  const std::ptrdiff_t in = cell.inside.slot;
  const Eigen::Vector3d settling = drift.response_time * drift.gravity;
  const Eigen::Vector3d turning = Eigen::Vector3d(velocity[0][in], velocity[1][in], velocity[2][in]) - settling;
  const double here = flow_squared(fluxes, cell), inside = flow_squared(fluxes, cell.inside);
  const double slower = here < inside ? here / inside : 1.0;
  return std::max(0.0, cell.outward.dot(settling + slower * turning));
}

}  // namespace

double response_time(double diameter, double density, double viscosity) {
  const double knudsen = 2.0 * 0.067e-6 / diameter;
  const double slip = 1.0 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen));
  return density * diameter * diameter * slip / (18.0 * viscosity);
}

std::vector<FinesDrift::WallCell> find_wall_cells(const lbm::Rows& rows, const lbm::FaceFluxes& fluxes,
                                                  const lbm::geometry::TriangleTree& tree,
                                                  const std::vector<char>& opening) {
  std::vector<FinesDrift::WallCell> cells;
  std::vector<lbm::geometry::Feature> found, beside;
  const std::vector<int> run_of = runs_by_slot(rows);
  for (const lbm::Run& run : rows.runs())
    for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) {
      std::array<Eigen::Vector3d, 6> closed;
      int count = 0;
      for (int d = 0; d < 3; ++d) {
        if (fluxes.open[d][s] == 0) closed[count++] = Eigen::Vector3d::Unit(d);
        if (fluxes.open[d][s + lbm::offset_low(run, d)] == 0) closed[count++] = -Eigen::Vector3d::Unit(d);
      }
      if (count == 0) continue;
      const Eigen::Vector3d centre = rows.centre(s);
      found.clear();
      tree.near_features(centre, 2.0 * rows.dx(), &opening, found);
      if (found.empty()) continue;
      std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
      });
      const std::size_t first = cells.size();  // of this cell, the nearest wall first
      for (const auto& wall : found) {
        if (wall.distance > found.front().distance + 0.75 * rows.dx()) break;
        const FinesDrift::Place here = place_of(s, run);
        FinesDrift::WallCell cell{here, tree.mesh().area_vector(wall.triangle).normalized(), 0.0, wall.triangle, here};
        if (wall.distance > 1e-3 * rows.dx() && (wall.point - centre).dot(cell.outward) > 0.0)
          cell.outward = (wall.point - centre) / wall.distance;
        const Eigen::Vector3d in = (centre - 1.5 * rows.dx() * cell.outward - rows.origin()) / rows.dx();
        const std::ptrdiff_t further =
            rows.active_slot(static_cast<int>(std::lround(in[0])), static_cast<int>(std::lround(in[1])),
                             static_cast<int>(std::lround(in[2])));
        beside.clear();
        if (further >= 0) tree.near_features(rows.centre(further), 0.6 * rows.dx(), &opening, beside);
        if (further >= 0 && beside.empty()) cell.inside = place_of(further, rows.runs()[run_of[further]]);
        cells.push_back(cell);
      }
      for (int n = 0; n < count; ++n) {
        const auto sees = [&](const FinesDrift::WallCell& c) { return closed[n].dot(c.outward); };
        const auto best = std::max_element(cells.begin() + first, cells.end(),
                                           [&](const auto& x, const auto& y) { return sees(x) < sees(y); });
        best->area += std::max(0.0, sees(*best));
      }
    }
  return cells;
}

void update_drift(const lbm::Rows& rows, const lbm::FaceFluxes& fluxes, const ForceOnAir& force, const Scale& scale,
                  const FinesDrift& drift, double seconds, DriftVelocity& velocity) {
  size_for(rows, velocity);
  const double blend = -std::expm1(-seconds / drift.response_time);
  const double per_difference = scale.pressure_unit() / (3.0 * scale.density * scale.dx);  // [m/s^2] per lattice unit
  std::vector<double> density = fluxes.density;
  mirror(rows, density);
  // Rise of the density through the high and the low face, less three times the force there: pressure is a third of it.
  std::vector<double> up(rows.slots()), down(rows.slots());
  std::vector<double> pushed(rows.slots(), 0.0);
  for (int d = 0; d < 3; ++d) {
    const auto& open = fluxes.open[d];
    if (force.carriers != nullptr) {
      const auto& given = d == 0 ? force.carriers->x : d == 1 ? force.carriers->y : force.carriers->z;
      for_each_cell(rows, [&](std::ptrdiff_t s, const lbm::Run&) { pushed[s] = given[s]; });
      mirror(rows, pushed);
    }
    const double everywhere = 3.0 * force.everywhere[d];
    const auto rise_between = [&](std::ptrdiff_t below, std::ptrdiff_t above) {
      return density[above] - density[below] - 1.5 * (pushed[above] + pushed[below]) - everywhere;
    };
    for_each_cell(rows, [&](std::ptrdiff_t s, const lbm::Run& run) {
      const std::ptrdiff_t low = s + lbm::offset_low(run, d), high = s + lbm::offset_high(run, d);
      up[s] = open[s] == 1 ? rise_between(s, high) : no_rise;
      down[s] = open[low] == 1 ? rise_between(low, s) : no_rise;
    });
    mirror(rows, up);
    mirror(rows, down);
    for_each_cell(rows, [&](std::ptrdiff_t s, const lbm::Run& run) {
      const bool above = up[s] != no_rise, below = down[s] != no_rise;
      double rise = 0.0;  // over one cell
      if (above && below) {
        rise = 0.5 * (up[s] + down[s]);
      } else if (above) {  // a wall below: the rise one face further inside, if there is one
        const double inside = up[s + lbm::offset_high(run, d)];
        rise = inside != no_rise ? inside : up[s];
      } else if (below) {
        const double inside = down[s + lbm::offset_low(run, d)];
        rise = inside != no_rise ? inside : down[s];
      }
      const double push = rise * per_difference / density[s] + drift.gravity[d];
      velocity[d][s] += blend * (drift.response_time * push - velocity[d][s]);
    });
  }
}

void set_frozen_drift(const lbm::Rows& rows, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& air,
                      const FinesDrift& drift, DriftVelocity& velocity) {
  size_for(rows, velocity);
  const double h = 0.25 * rows.dx();
  for_each_cell(rows, [&](std::ptrdiff_t s, const lbm::Run&) {
    const Eigen::Vector3d x = rows.centre(s), u = air(x);
    Eigen::Vector3d turning = Eigen::Vector3d::Zero();
    for (int d = 0; d < 3; ++d)
      turning += u[d] * (air(x + h * Eigen::Vector3d::Unit(d)) - air(x - h * Eigen::Vector3d::Unit(d))) / (2.0 * h);
    for (int d = 0; d < 3; ++d) velocity[d][s] = drift.response_time * (drift.gravity[d] - turning[d]);
  });
}

void add_drift(const lbm::Rows& rows, const lbm::FluxRoutes& routes, const Scale& scale, const FinesDrift& drift,
               const DriftVelocity& velocity, lbm::FaceFluxes& fluxes) {
  for (int d = 0; d < 3; ++d) {
    std::vector<double> v = velocity[d], density = fluxes.density;
    fluxes.drift[d].assign(rows.slots(), 0.0);
    mirror(rows, v);
    mirror(rows, density);
    for_each_cell(rows, [&](std::ptrdiff_t s, const lbm::Run& run) {
      if (fluxes.open[d][s] != 1) return;
      const std::ptrdiff_t high = s + lbm::offset_high(run, d);
      fluxes.drift[d][s] = 0.25 * (density[s] + density[high]) * scale.velocity_lu(v[s] + v[high]);
    });
    for (const auto& image : routes.images) fluxes.drift[d][image.ghost] = fluxes.drift[d][image.active];
  }
  if (!drift.deposits) return;
  fluxes.sinks.clear();
  for (const FinesDrift::WallCell& cell : drift.walls) {
    const double rate = scale.velocity_lu(drift_into_wall(drift, velocity, fluxes, cell)) * cell.area;
    if (!fluxes.sinks.empty() && fluxes.sinks.back().slot == cell.slot)
      fluxes.sinks.back().rate += rate;  // a corner
    else
      fluxes.sinks.push_back({cell.slot, rate});
  }
}

}  // namespace puffin::coupling
