#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cases/build.hpp"
#include "cases/derived.hpp"

namespace puffin::cases {

namespace {

namespace geometry = lbm::geometry;

/// Area [m^2] and mean outward normal of a patch.
struct PatchShape {
  double area = 0.0;
  Vec3 normal = Vec3::Zero();
};

PatchShape shape_of(const Surface& surface, int patch) {
  PatchShape shape;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t)
    if (surface.patches.of_triangle[t] == patch) {
      shape.area += surface.mesh.area(static_cast<int>(t));
      shape.normal += surface.mesh.area_vector(static_cast<int>(t));
    }
  if (shape.normal.norm() > 0.0) shape.normal.normalize();
  return shape;
}

const Boundary* boundary_of(const Air& air, const std::string& patch) {
  for (const Boundary& b : air.boundaries)
    if (b.patch == patch) return &b;
  return nullptr;
}

bool is_periodic(const Air& air, const std::string& patch) {
  return std::any_of(air.boundaries.begin(), air.boundaries.end(), [&](const Boundary& b) {
    return b.type == BoundaryType::periodic && (b.patch == patch || b.with == patch);
  });
}

/// What the lattice does at one patch, and what drives it.
void describe_patch(const Case& c, const Surface& surface, int patch, lbm::LinkGeometry& links,
                    std::vector<coupling::PatchDrive>& drives) {
  const std::string& name = surface.patches.names[patch];
  const PatchShape shape = shape_of(surface, patch);
  lbm::Boundary lattice{name, lbm::BoundaryKind::wall, {}};
  coupling::PatchDrive drive;
  drive.patch = name;
  drive.area = shape.area;
  if (is_periodic(c.air, name)) {
    lattice.kind = lbm::BoundaryKind::periodic;
  } else if (const Boundary* b = boundary_of(c.air, name)) {
    const Boundary copy = *b;
    switch (b->type) {
      case BoundaryType::velocity_inlet: {
        lattice.kind = lbm::BoundaryKind::velocity_inlet;
        Vec3 direction = -shape.normal;
        if (const auto* v = std::get_if<Velocity>(&b->flow)) direction = v->value.normalized();
        lattice.profile = [direction](const Vec3&) { return direction; };
        // A velocity vector crosses the patch with its normal part alone.
        const double share = std::abs(direction.dot(shape.normal));
        const double area = shape.area;
        drive.speed = [copy, area, share](double t) { return mean_speed(copy, t, area) * share; };
        drive.is_inlet = true;
        break;
      }
      case BoundaryType::pressure_outlet: {
        lattice.kind = lbm::BoundaryKind::pressure_outlet;
        const double pressure = b->pressure;
        drive.pressure = [pressure](double) { return pressure; };
        drive.is_outlet = true;
        break;
      }
      case BoundaryType::moving_wall: {
        const Vec3 velocity = std::get<Velocity>(b->flow).value;
        const double speed = velocity.norm();
        const Vec3 direction = speed > 0.0 ? Vec3(velocity / speed) : Vec3(Vec3::Zero());
        lattice.profile = [direction](const Vec3&) { return direction; };
        drive.speed = [speed](double) { return speed; };
        break;
      }
      default:
        break;
    }
  }
  links.boundaries.push_back(lattice);
  drives.push_back(drive);
}

/// The walls beside a plug inlet carry the plug's speed at the opening and let go of it over six cells.
///
/// A plug that meets walls at rest loses momentum in the first cells that no viscosity accounts for: a bounce-back wall
/// takes a third of the momentum of its cell in the first step, whatever the viscosity, and the stress that balances it
/// builds up over some 20 steps. Measured in a channel 6 cells high at tau = 0.5003: the cell beside the wall falls to
/// 0.55 of the inlet speed within two cells, and to 0.90 with the release. Errors of O(dx) beside the opening remain.
void release_plug(Simulation& s, lbm::LinkGeometry& links) {
  constexpr double cells = 6.0;
  int inlet = -1;
  for (std::size_t p = 0; p < links.boundaries.size(); ++p) {
    const bool wall = links.boundaries[p].kind == lbm::BoundaryKind::wall;
    if (wall && links.boundaries[p].profile) return;  // a moving wall: one speed for all walls that move
    if (links.boundaries[p].kind != lbm::BoundaryKind::velocity_inlet) continue;
    const Boundary* b = boundary_of(s.description.air, links.boundaries[p].patch);
    if (inlet >= 0 || b == nullptr || b->profile != Profile::plug) return;
    inlet = static_cast<int>(p);
  }
  if (inlet < 0) return;
  auto opening = std::make_shared<geometry::TriangleMesh>();
  opening->vertices = s.surface.mesh.vertices;
  opening->solids = s.surface.mesh.solids;
  for (std::size_t t = 0; t < s.surface.mesh.triangles.size(); ++t)
    if (s.surface.patches.of_triangle[t] == inlet) {
      opening->triangles.push_back(s.surface.mesh.triangles[t]);
      opening->solid.push_back(0);
    }
  const auto tree = std::make_shared<const geometry::TriangleTree>(opening);
  const double reach = cells * s.dx;
  const auto direction = links.boundaries[inlet].profile;
  for (std::size_t p = 0; p < links.boundaries.size(); ++p) {
    if (links.boundaries[p].kind != lbm::BoundaryKind::wall) continue;
    links.boundaries[p].profile = [tree, reach, direction](const Vec3& x) -> Vec3 {
      const double d = tree->closest(x, reach).distance;
      return d < reach ? Vec3((1.0 - d / reach) * direction(x)) : Vec3(Vec3::Zero());
    };
    s.models.patches[p].speed = s.models.patches[inlet].speed;
  }
}

/// Length before the outlets over which the eddy viscosity rises: three quarters of the hydraulic diameter.
double sponge_length(const Simulation& s) {
  double length = 0.0;
  for (std::size_t b = 0; b < s.models.patches.size(); ++b)
    if (s.models.patches[b].is_outlet) length = std::max(length, 0.75 * std::sqrt(s.models.patches[b].area));
  return length;
}

lbm::InitialCell initial_cell(const Air& air, const Vec3& x, const Vec3& box, double unit) {
  // Taylor-Green and the shear layer in a periodic box of edges `box`; the amplitude is the norm of initial_velocity.
  constexpr double two_pi = 6.283185307179586;
  lbm::InitialCell cell;
  Vec3 u = air.initial_velocity;
  const double a = air.initial_velocity.norm();
  if (air.initial == InitialField::taylor_green) {
    const double kx = two_pi * x[0] / box[0], ky = two_pi * x[1] / box[1];
    u = Vec3(-a * std::cos(kx) * std::sin(ky), a * (box[0] / box[1]) * std::sin(kx) * std::cos(ky), 0.0);
    const double scaled = a * unit;
    cell.density_excess = -0.75 * scaled * scaled * (std::cos(2 * kx) + std::cos(2 * ky));
  } else if (air.initial == InitialField::shear_layer) {
    // Two layers of thickness 1/80 of the box with a 5 % disturbance (Minion & Brown, J. Comput. Phys. 138, 734
    // (1997)).
    const double y = x[1] / box[1];
    u = Vec3(a * (y < 0.5 ? std::tanh(80.0 * (y - 0.25)) : std::tanh(80.0 * (0.75 - y))),
             0.05 * a * std::sin(two_pi * (x[0] / box[0] + 0.25)), 0.0);
  }
  for (int d = 0; d < 3; ++d) cell.velocity[d] = u[d] * unit;
  return cell;
}

void build_lattice(const LatticeNumbers& numbers, Simulation& s) {
  const Case& c = s.description;
  geometry::VoxelizeOptions options;
  std::vector<std::string> openings;
  for (const auto& name : openings_of(c))
    if (is_periodic(c.air, name)) {
      const Vec3 normal = shape_of(s.surface, s.surface.patches.find(name)).normal;
      for (int d = 0; d < 3; ++d) options.periodic[d] = options.periodic[d] || std::abs(normal[d]) > 0.99;
    } else {
      openings.push_back(name);
    }
  if (!openings.empty()) options.openings = s.surface.marked(openings);
  s.voxels = geometry::voxelize(*s.tree, s.dx, options, &s.pockets);

  lbm::LinkGeometry links;
  links.mesh = &s.tree->mesh();
  links.patch_of_triangle = s.surface.patches.of_triangle;
  for (std::size_t p = 0; p < s.surface.patches.names.size(); ++p)
    describe_patch(c, s.surface, static_cast<int>(p), links, s.models.patches);

  release_plug(s, links);

  lbm::AirOptions air;
  air.law = c.numerics.collision == Collision::bgk ? lbm::Law::bgk : lbm::Law::rr3;
  air.wall = c.numerics.wall == WallScheme::halfway ? lbm::WallScheme::halfway : lbm::WallScheme::bouzidi;
  air.double_precision = c.numerics.precision == Precision::float64;
  air.smagorinsky = c.numerics.les == Les::smagorinsky ? c.numerics.smagorinsky_constant : 0.0;
  air.sponge_length = sponge_length(s);
  s.state.air = lbm::make_air(s.voxels, links, air);
  s.state.scale = {s.dx, numbers.dt, c.air.density};
  s.state.cells = coupling::CellIndex(s.state.air->rows);
  s.state.touched.assign(s.state.air->rows.runs().size(), 0);
  s.state.spreader = coupling::Spreader(s.state.air->rows.slots());
}

}  // namespace

void build_air(Simulation& s) {
  const Case& c = s.description;
  s.models.air = {c.air.density, c.air.viscosity};
  const AreaOf area_of = [&](const std::string& patch) { return s.surface.area_of(patch); };
  s.reference_speed = reference_speed(c, area_of);
  auto& rule = s.models.time_step;
  if (c.air.model != AirModel::lbm) {
    // No lattice: the step only says how often the loads are renewed.
    rule.reference_dt = c.numerics.time_step == TimeStepRule::given ? c.numerics.time_step_seconds
                                                                    : std::min(1e-5, c.stop.time / 100.0);
    s.state.scale = {s.dx, rule.reference_dt, std::max(c.air.density, 1e-12)};
    for (std::size_t p = 0; p < s.surface.patches.names.size(); ++p) {
      lbm::LinkGeometry unused;
      describe_patch(c, s.surface, static_cast<int>(p), unused, s.models.patches);
    }
    if (c.air.model == AirModel::frozen)
      s.models.frozen_air = [field = c.air.frozen](const Vec3& x) -> Vec3 {
        if (const auto* u = std::get_if<UniformField>(&field)) return u->velocity;
        if (const auto* u = std::get_if<ShearField>(&field))
          return u->velocity + u->gradient * u->normal.dot(x) * u->direction;
        if (const auto* u = std::get_if<SolidBodyField>(&field)) return u->omega * u->axis.cross(x - u->center);
        throw std::invalid_argument("air.field: a frozen field from a file or a run is not offered");
      };
    return;
  }
  if (!(s.reference_speed > 0.0))
    throw std::invalid_argument("nothing sets the speed of the air: give numerics.reference_speed, e.g. \"1 m/s\"");
  const LatticeNumbers numbers = lattice_numbers(c, s.dx, s.reference_speed, area_of);
  rule.reference_dt = numbers.dt;
  rule.reference_speed = s.reference_speed;
  rule.follow = c.numerics.time_step == cases::TimeStepRule::follow_ramp && !c.numerics.reference_speed &&
                largest_mean_speed(c.air, c.stop.time, area_of) > 0.0;
  // Areas are sums over thousands of triangles: find them once.
  std::vector<std::pair<Boundary, double>> inlets;
  for (const Boundary& b : c.air.boundaries)
    if (b.type == BoundaryType::velocity_inlet) inlets.emplace_back(b, s.surface.area_of(b.patch));
  rule.speed = [inlets](double t) {
    double speed = 0.0;
    for (const auto& [b, area] : inlets) speed = std::max(speed, std::abs(mean_speed(b, t, area)));
    return speed;
  };
  if (const auto* force = std::get_if<Vec3>(&c.air.body_force); force && force->norm() > 0.0)
    s.models.body_force = [f = *force](double) { return f; };
  build_lattice(numbers, s);
  s.state.scale.dt = rule.first(0.0);
  if (c.air.initial != InitialField::uniform || c.air.initial_velocity.norm() > 0.0) {
    const Vec3 box = s.tree->max() - s.tree->min(), corner = s.tree->min();
    const double unit = s.state.scale.dt / s.dx;
    lbm::set_cells([&](const Vec3& x) { return initial_cell(c.air, x - corner, box, unit); }, *s.state.air);
  }
}

}  // namespace puffin::cases
