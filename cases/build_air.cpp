#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "cases/assessment.hpp"
#include "cases/build.hpp"
#include "cases/build_boundaries.hpp"
#include "cases/check_boundaries.hpp"
#include "cases/compressibility.hpp"
#include "cases/derived.hpp"
#include "cases/frozen_ways.hpp"
#include "cases/initial_air.hpp"
#include "cases/inlet.hpp"
#include "cases/opening.hpp"
#include "cases/point_field.hpp"
#include "cases/section_speed.hpp"
#include "cases/table_file.hpp"
#include "cases/undriven_speed.hpp"
#include "lbm/geometry/buried_faces.hpp"
#include "lbm/geometry/voxel_errors.hpp"
#include "lbm/markers.hpp"

namespace puffin::cases {

namespace {

namespace geometry = lbm::geometry;

/// Length before the outlets over which the eddy viscosity rises: three quarters of the hydraulic diameter.
double sponge_length(const Simulation& s) {
  double length = 0.0;
  for (std::size_t b = 0; b < s.models.patches.size(); ++b)
    if (s.models.patches[b].is_outlet) length = std::max(length, 0.75 * std::sqrt(s.models.patches[b].area));
  return length;
}

std::function<Vec3(const Vec3&)> frozen_air(const Simulation& s) {
  const FrozenField& field = s.description.air.frozen;
  if (const auto* file = std::get_if<FieldFile>(&field)) {
    const auto points = std::make_shared<const PointField>(read_point_field(file->file));
    return [points](const Vec3& x) { return points->at(x); };
  }
  if (std::holds_alternative<RunField>(field)) return s.stored_field;
  return [field](const Vec3& x) -> Vec3 {
    if (const auto* u = std::get_if<UniformField>(&field)) return u->velocity;
    if (const auto* u = std::get_if<ShearField>(&field))
      return u->velocity + u->gradient * u->normal.normalized().dot(x) * u->direction.normalized();
    const auto& u = std::get<SolidBodyField>(field);
    return u.omega * u.axis.normalized().cross(x - u.center);
  };
}

/// Empty: none. A table is linear between its rows and constant outside them.
std::function<Vec3(double)> body_force(const Case& c) {
  if (const auto* file = std::get_if<ForceFile>(&c.air.body_force)) {
    const Columns columns = read_columns(file->file, {"time", "fx", "fy", "fz"});
    const auto& time = columns.at("time");
    if (std::adjacent_find(time.begin(), time.end(), std::greater_equal<>()) != time.end())
      throw std::invalid_argument(file->file + ": the times must rise from row to row");
    std::array<TimeTable, 3> force;
    for (int d = 0; d < 3; ++d) force[d] = {time, columns.at(std::array{"fx", "fy", "fz"}[d])};
    return [force](double t) { return Vec3(force[0].at(t), force[1].at(t), force[2].at(t)); };
  }
  const Vec3 constant = std::get<Vec3>(c.air.body_force);
  if (constant.norm() == 0.0) return {};
  return [constant](double) { return constant; };
}

/// Equilibrium of the initial velocity and pressure with the stress of its gradients (central differences over a cell),
/// so that no layer of wrong stress has to decay: Pi = -2/3 tau S in lattice units.
void set_initial_air(Simulation& s) {
  const auto start = from_file(s.description, "air.initial", [&] {
    return initial_air(s.description.air, s.tree->min(), s.tree->max() - s.tree->min());
  });
  if (!start) return;
  const coupling::Scale& scale = s.state.scale;
  const double tau = scale.relaxation_time(s.models.air.viscosity / s.models.air.density);
  lbm::set_cells(
      [&](const Vec3& x) {
        lbm::InitialCell cell;
        const Vec3 u = start->velocity(x);
        Eigen::Matrix3d gradient;  // [1/step]
        for (int d = 0; d < 3; ++d) {
          const Vec3 half = 0.5 * s.dx * Vec3::Unit(d);
          gradient.col(d) = (start->velocity(x + half) - start->velocity(x - half)) * scale.dt / s.dx;
          cell.velocity[d] = scale.velocity_lu(u[d]);
        }
        const int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
        for (int k = 0; k < 6; ++k)
          cell.stress[k] = -tau / 3.0 * (gradient(pairs[k][0], pairs[k][1]) + gradient(pairs[k][1], pairs[k][0]));
        cell.density_excess = scale.density_excess_lu(start->pressure(x) + (start->gauge ? 0.0 : scale.base));
        return cell;
      },
      *s.state.air);
}

void build_voxels(const Case& c, Simulation& s) {
  geometry::VoxelizeOptions options;
  std::vector<std::string> openings;
  options.periodic = periodic_directions(c, s.surface);
  for (const auto& name : openings_of(c))
    if (!is_periodic(c.air, name)) openings.push_back(name);
  if (!openings.empty()) options.openings = s.surface.marked(openings);
  options.flush = s.surface.marked(slip_patches_of(c));
  try {
    s.voxels = geometry::voxelize(*s.tree, s.dx, options, &s.pockets);
  } catch (const std::invalid_argument& e) {
    throw geometry::GeometryError(e.what());
  }
  geometry::refuse_buried(geometry::hidden_faces(*s.tree, s.voxels, options.openings));
}

void build_lattice(const Case& c, const LatticeNumbers& numbers, Simulation& s) {
  lbm::LinkGeometry links;
  links.mesh = &s.tree->mesh();
  links.patch_of_triangle = s.surface.patches.of_triangle;
  describe_patches(c, s.surface, links.boundaries, s.models.patches);
  // Markers would pump the band behind an immersed wall that moves.
  if (c.numerics.wall != WallScheme::ibm) release_plug(s, links);

  lbm::AirOptions air;
  air.law = law_of(c.numerics.collision);
  // A frozen field has no walls that act on the air: only the cells of the fluid are wanted.
  air.wall = s.models.frozen_air ? lbm::WallScheme::bouzidi : wall_of(c.numerics.wall);
  air.markers.retraction = lbm::retraction_for(numbers.tau);
  air.wall_model = c.numerics.wall_model && !s.models.frozen_air;
  air.double_precision = c.numerics.precision == Precision::float64;
  air.smagorinsky = c.numerics.les == Les::none ? 0.0 : c.numerics.smagorinsky_constant;
  air.eddy = c.numerics.les == Les::vreman ? lbm::Eddy::vreman : lbm::Eddy::smagorinsky;
  air.hrr_sigma = c.numerics.hrr_sigma;
  air.sponge_length = sponge_length(s);
  s.state.air = lbm::make_air(s.voxels, links, air);
  build_turbulence(s);
  s.state.scale = {s.dx, numbers.dt, c.air.density, common_pressure(c)};
  s.state.cells = coupling::CellIndex(s.state.air->rows, s.state.air->fluid);
  s.state.touched.assign(s.state.air->rows.runs().size(), 0);
  s.state.spreader = coupling::Spreader(s.state.air->rows.slots());
}

/// Cells in which fines are carried by a field that does not change; nothing is collided or streamed there.
void build_frozen_cells(Simulation& s) {
  const Case& c = s.description;
  const Vec3 low = s.tree->min(), size = s.tree->max() - low;
  double speed = 0.0;  // at 17^3 points: the corners, where linear fields are fastest, and what lies between
  constexpr int parts = 16;
  for (int k = 0; k <= parts; ++k)
    for (int j = 0; j <= parts; ++j)
      for (int i = 0; i <= parts; ++i)
        speed = std::max(speed, s.models.frozen_air(low + size.cwiseProduct(Vec3(i, j, k)) / parts).norm());
  double diffusivity = 0.0;
  for (const Scalar& scalar : c.fines->scalars) diffusivity = std::max(diffusivity, scalar.diffusion / c.air.density);
  auto& rule = s.models.time_step;
  rule.reference_dt = c.stop.time / 100.0;
  if (speed > 0.0)
    rule.reference_dt = std::min(rule.reference_dt, c.numerics.lattice_speed * s.dx / speed);
  else if (diffusivity > 0.0)  // 16 of these, the interval of a scene at rest, are what diffusion follows
    rule.reference_dt = std::min(rule.reference_dt, 0.03 * s.dx * s.dx / diffusivity);
  if (c.numerics.time_step == TimeStepRule::given) rule.reference_dt = c.numerics.time_step_seconds;
  LatticeNumbers numbers;
  numbers.dt = rule.reference_dt;
  const Case open = with_open_patches(c, s.surface);
  for (std::string& text : closed_ways(open, s.surface, speed, s.models.frozen_air))
    s.warnings.push_back(std::move(text));
  build_voxels(open, s);
  build_lattice(open, numbers, s);
  const double unit = s.state.scale.dt / s.dx;
  lbm::set_cells(
      [&](const Vec3& x) {
        const Vec3 u = s.models.frozen_air(x) * unit;
        return lbm::InitialCell{0.0, {u[0], u[1], u[2]}, {}};
      },
      *s.state.air);
}

}  // namespace

lbm::WallScheme wall_of(WallScheme wall) {
  switch (wall) {
    case WallScheme::halfway:
      return lbm::WallScheme::halfway;
    case WallScheme::ibm:
      return lbm::WallScheme::ibm;
    case WallScheme::psm:
      return lbm::WallScheme::psm;
    case WallScheme::bouzidi:
      break;
  }
  return lbm::WallScheme::bouzidi;
}

lbm::Law law_of(Collision collision) {
  switch (collision) {
    case Collision::bgk:
      return lbm::Law::bgk;
    case Collision::trt:
      return lbm::Law::trt;
    case Collision::central_moments:
      return lbm::Law::central_moments;
    case Collision::hrr:
      return lbm::Law::hrr;
    case Collision::rr3:
      break;
  }
  return lbm::Law::rr3;
}

void build_air(Simulation& s) {
  const Case& c = s.description;
  s.models.air = {c.air.density, c.air.viscosity};
  const AreaOf area_of = inlet_areas(c.air, s.surface);
  s.reference_speed = reference_speed(c, area_of);
  auto& rule = s.models.time_step;
  if (c.air.model == AirModel::frozen) s.models.frozen_air = from_file(c, "air.field", [&] { return frozen_air(s); });
  if (c.air.model == AirModel::frozen && c.fines) return build_frozen_cells(s);
  if (c.air.model != AirModel::lbm) {
    geometry::refuse_buried(geometry::buried_places(*s.tree, s.surface.marked(openings_of(c))));
    // No lattice: the step only says how often the loads are renewed.
    rule.reference_dt = c.numerics.time_step == TimeStepRule::given
                            ? c.numerics.time_step_seconds
                            : std::min({1e-5, c.stop.time / 100.0, 0.5 * response_time(c)});
    s.state.scale = {s.dx, rule.reference_dt, std::max(c.air.density, 1e-12)};
    std::vector<lbm::Boundary> unused;
    describe_patches(c, s.surface, unused, s.models.patches);
    return;
  }
  if (!(s.reference_speed > 0.0)) {
    const EstimatedSpeed estimate = estimated_speed(c, s.surface);
    s.reference_speed = estimate.value;
    if (!estimate.warning.empty()) s.warnings.push_back(estimate.warning);
  }
  if (!(s.reference_speed > 0.0)) throw std::invalid_argument(no_speed);
  build_voxels(c, s);
  const double narrowing = c.numerics.reference_speed ? 1.0 : section_ratio(c, s.surface, *s.tree, s.voxels);
  if (narrowing > 1.0) s.reference_speed = reference_speed(c, area_of, narrowing);
  const LatticeSpeed tamed = lattice_speed(c, s.surface, s.reference_speed);
  if (!tamed.warning.empty()) s.warnings.push_back(tamed.warning);
  Case suited = c;
  suited.numerics.lattice_speed = s.lattice_speed = tamed.value;
  const LatticeNumbers numbers = lattice_numbers(suited, s.dx, s.reference_speed, area_of, narrowing);
  rule.reference_dt = numbers.dt;
  rule.reference_speed = largest_followed_speed(c.air, c.stop.time, area_of);
  rule.follow =
      c.numerics.time_step == cases::TimeStepRule::follow_ramp && largest_mean_speed(c.air, c.stop.time, area_of) > 0.0;
  rule.speed = [air = c.air, area_of](double t) { return followed_speed(air, t, area_of); };
  s.models.body_force = from_file(c, "air.body_force", [&] { return body_force(c); });
  build_lattice(c, numbers, s);
  s.state.scale.dt = rule.first(0.0);
  set_initial_air(s);
}

}  // namespace puffin::cases
