#include "cases/build_boundaries.hpp"

#include <algorithm>
#include <cmath>

#include "cases/check_boundaries.hpp"
#include "cases/derived.hpp"
#include "cases/inlet_profile.hpp"

namespace puffin::cases {

namespace {

namespace geometry = lbm::geometry;

/// All walls that move share one speed on the lattice: the fastest. Each has its velocity in units of it.
double fastest_wall(const Air& air) {
  double speed = 0.0;
  for (const Boundary& b : air.boundaries)
    if (b.type == BoundaryType::moving_wall) speed = std::max(speed, std::get<Velocity>(b.flow).value.norm());
  return speed;
}

void describe_inlet(const Case& c, const Surface& surface, const Boundary& b, lbm::Boundary& lattice,
                    coupling::PatchDrive& drive) {
  const Inlet inlet = from_file(c, "air.boundary", [&] { return inlet_of(c, surface, b); });
  lattice.kind = lbm::BoundaryKind::velocity_inlet;
  lattice.profile = from_file(c, "air.boundary", [&] { return profile_of(b, surface, inlet); }).shape;
  lattice.parts = inlet.parts;
  lattice.exact_flow = b.profile != Profile::plug;
  drive.area = inlet.area;
  drive.speed = [b, area = inlet.area, across = inlet.across](double t) { return mean_speed(b, t, area) * across; };
  drive.is_inlet = true;
}

}  // namespace

void describe_patches(const Case& c, const Surface& surface, std::vector<lbm::Boundary>& boundaries,
                      std::vector<coupling::PatchDrive>& drives) {
  const double fastest = fastest_wall(c.air);
  for (std::size_t p = 0; p < surface.patches.names.size(); ++p) {
    const std::string& name = surface.patches.names[p];
    lbm::Boundary lattice{name, lbm::BoundaryKind::wall, {}};
    coupling::PatchDrive drive;
    drive.patch = name;
    drive.area = surface.area_of(name);
    const Boundary* b = boundary_of(c.air, name);
    if (is_periodic(c.air, name)) {
      lattice.kind = lbm::BoundaryKind::periodic;
    } else if (b != nullptr) {
      switch (b->type) {
        case BoundaryType::velocity_inlet:
          describe_inlet(c, surface, *b, lattice, drive);
          break;
        case BoundaryType::pressure_outlet:
          lattice.kind = lbm::BoundaryKind::pressure_outlet;
          drive.pressure = [pressure = b->pressure](double) { return pressure; };
          drive.is_outlet = true;
          break;
        case BoundaryType::moving_wall:
          if (fastest > 0.0) {
            const Vec3 velocity = std::get<Velocity>(b->flow).value / fastest;
            lattice.profile = [velocity](const Vec3&) { return velocity; };
            lattice.slides = true;
            drive.speed = [fastest](double) { return fastest; };
          }
          break;
        case BoundaryType::slip:
          lattice.kind = lbm::BoundaryKind::slip;
          break;
        case BoundaryType::wall:
        case BoundaryType::periodic:
          break;
      }
    }
    boundaries.push_back(lattice);
    drives.push_back(drive);
  }
}

// A plug that meets walls at rest loses momentum in the first cells that no viscosity accounts for: a bounce-back wall
// takes a third of the momentum of its cell in the first step, whatever the viscosity, and the stress that balances it
// builds up over some 20 steps. Measured in a channel 6 cells high at tau = 0.5003: the cell beside the wall falls to
// 0.55 of the inlet speed within two cells, and to 0.90 with the release. Errors of O(dx) beside the opening remain.
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

void build_turbulence(Simulation& s) {
  for (std::size_t p = 0; p < s.models.patches.size(); ++p) {
    const Boundary* b = boundary_of(s.description.air, s.models.patches[p].patch);
    if (b == nullptr || b->type != BoundaryType::velocity_inlet || !(b->turbulence > 0.0)) continue;
    // Eddies of a developed duct: integral length 0.3 of the width (Hinze, Turbulence (1975), section 7-13).
    const auto& parts = s.state.air->boundaries[p].parts;  // each with eddies of its own
    for (std::size_t part = 0; part < (parts ? parts->area.size() : 1); ++part) {
      const double length = 0.3 * std::sqrt(parts ? parts->area[part] : s.models.patches[p].area) / s.dx;
      const std::uint64_t seed = s.description.numerics.seed + p + part * s.models.patches.size();
      s.models.turbulence.push_back(lbm::make_inlet_turbulence(*s.state.air, static_cast<int>(p), b->turbulence,
                                                               std::max(length, 1.0), seed, static_cast<int>(part)));
    }
  }
}

}  // namespace puffin::cases
