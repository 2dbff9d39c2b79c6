#include "cases/assessment.hpp"

#include "cases/check_boundaries.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <stdexcept>

#include "cases/compressibility.hpp"
#include "cases/inlet_profile.hpp"
#include "cases/opening.hpp"
#include "cases/room.hpp"
#include "cases/section_speed.hpp"
#include "cases/undriven_speed.hpp"
#include "cases/units.hpp"
#include "cases/untagged_openings.hpp"
#include "lbm/geometry/buried_faces.hpp"
#include "lbm/geometry/voxel_report.hpp"

namespace puffin::cases {
namespace {

namespace geometry = lbm::geometry;

/// Length of the edges between a patch and the rest of the surface.
double perimeter_of(const Surface& s, const std::string& patch) {
  const int wanted = s.patches.find(patch);
  std::map<std::array<int, 2>, int> uses;  // edge -> triangles of the patch at it
  for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t)
    for (int k = 0; k < 3 && s.patches.of_triangle[t] == wanted; ++k) {
      const int a = s.mesh.triangles[t][k], b = s.mesh.triangles[t][(k + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  double length = 0.0;
  for (const auto& [edge, count] : uses)
    if (count == 1) length += (s.mesh.vertices[edge[0]] - s.mesh.vertices[edge[1]]).norm();
  return length;
}

/// Bytes of a cell: its slots (1.23 a cell in a device: ghosts) with 19 populations and what each scalar of each
/// mechanism keeps; the rest is what was measured beside that in the flow through an L-bend, set-up included.
double bytes_a_cell(const Case& c) {
  const double real = c.numerics.precision == Precision::float64 ? 8.0 : 4.0, populations = 19.0 * real;
  const double scalars = c.fines ? 3.0 * (16.0 + 3.0 * real) * static_cast<double>(c.fines->scalars.size()) : 0.0;
  return 1.23 * (populations + scalars) + 225.0;
}

/// Pictures of the whole device are put together in memory, as numbers on its box.
double output_of(const Case& c, const Assessment& a, const Surface& s) {
  if (!a.lattice) return 0.0;
  constexpr double number = 10.0;  // a float, and what is made of it on the way
  double most = 0.0;
  for (const FieldOutput& f : c.output.fields)
    if (std::holds_alternative<RegionAll>(f.region))
      most = std::max(most, number * (3.0 * f.velocity + f.pressure + f.fines));
  return most * cells_in_box(s, a.lattice->dx);
}

/// Nine runs of devices took 0.94 to 1.5 times as much (docs/results/reliability/memory-said.csv); `puffin estimate` is
/// nearer.
double memory_of(const Case& c, const Assessment& a, const Surface& s) {
  // A parcel: lists, stencils, contacts not yet written. Many take less each: 100,000 fines in flight took 0.65 GB,
  // 125,000 without air 0.38.
  constexpr double program = 75e6, triangle = 400.0, parcel = 25e3, each_more = 10e3, first_parcels = 2500.0;
  const double parcels = c.carriers ? static_cast<double>(c.carriers->count) / c.carriers->parcel : 0.0;
  return program + triangle * static_cast<double>(s.mesh.triangles.size()) + parcel * std::min(parcels, first_parcels) +
         each_more * std::max(0.0, parcels - first_parcels) + bytes_a_cell(c) * static_cast<double>(a.cells_fluid) +
         output_of(c, a, s);
}

void warn(const Case& c, Assessment& a) {
  const auto say = [&](const std::string& text) { a.warnings.push_back(text); };
  if (!a.lattice) return;
  const LatticeNumbers& n = *a.lattice;
  if (n.mach / std::sqrt(3.0) > 0.15)
    say("the lattice speed is above 0.15: density errors grow with its square, and runs may diverge");
  if (n.tau > 1.0) say("tau is above 1: the walls become inaccurate; lower lattice_speed or dx");
  const double cell_reynolds = a.reference_speed * n.dx * c.air.density / c.air.viscosity;
  if (cell_reynolds > 100.0 && c.numerics.les == Les::none)
    say("the cell Reynolds number is " + std::to_string(std::lround(cell_reynolds)) + " and les is \"none\"");
  const double gap_cells = a.narrowest_gap / n.dx;
  if (a.narrowest_gap > 0.0 && gap_cells < 4.0)
    say("the narrowest gap, " + format_quantity(a.narrowest_gap, unit::length) + ", has fewer than 4 cells");
  // Behind the step of the L-bend the jet of an inlet of 10 cells and more meets the floor where experiments have it;
  // of 6.6 and 4.9 cells far too early (docs/thesis-comparison.md).
  constexpr double fewest_cells = 8.0, turbulent = 2300.0;
  for (const InletNumbers& i : a.inlets) {
    if (i.reynolds < turbulent || i.hydraulic_diameter >= fewest_cells * n.dx) continue;
    char text[256];
    std::snprintf(
        text, sizeof text,
        "the inlet \"%s\" has %.1f cells (4 area / perimeter) for a jet of Reynolds number %.0f; below %.0f it "
        "spreads too fast: take a dx of at most %.3g mm",
        i.patch.c_str(), i.hydraulic_diameter / n.dx, i.reynolds, fewest_cells,
        1e3 * i.hydraulic_diameter / fewest_cells);
    say(text);
  }
  const bool whole_cells = c.numerics.wall == WallScheme::ibm || c.numerics.wall == WallScheme::psm;
  if (whole_cells && a.thinnest_wall < 2.0 * n.dx)
    say("the thinnest wall, " + format_quantity(a.thinnest_wall, unit::length) +
        ", has fewer than 2 cells, and walls \"ibm\" and \"psm\" leak round such: lower dx, or take \"bouzidi\"");
  if (a.thin_walls > 0)
    say(std::to_string(a.thin_walls) +
        " links between cells cross a wall thinner than a cell; the flow is stopped there half-way: lower dx");
  if (std::abs(a.volume_voxels / a.volume - 1.0) > 0.05) say("the voxels miss the volume by more than 5 %: lower dx");
  if (c.carriers && c.carriers->diameter * std::cbrt(c.carriers->parcel) > 1.5 * n.dx)
    say("the parcels are larger than the cells: the air they disturb is not the air they should feel");
}

}  // namespace

std::array<bool, 3> periodic_directions(const Case& c, const Surface& s) {
  std::array<bool, 3> periodic{false, false, false};
  for (const Boundary& b : c.air.boundaries) {
    if (b.type != BoundaryType::periodic) continue;
    const int wanted = s.patches.find(b.patch);
    Vec3 normal = Vec3::Zero();
    for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t)
      if (s.patches.of_triangle[t] == wanted) normal += s.mesh.area_vector(static_cast<int>(t));
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    periodic[axis] = true;
  }
  return periodic;
}

Assessment assess(const Case& given, const Surface& s) {
  refuse_untagged_openings(given, s.patches);
  Case c = given;
  complete_file_profiles(s, c);
  Assessment a;
  a.volume = s.volume;
  a.area = s.area;
  const AreaOf area_of = inlet_areas(c.air, s);
  for (const Boundary& b : c.air.boundaries) {
    if (b.type != BoundaryType::velocity_inlet) continue;
    Air alone = c.air;
    alone.boundaries = {b};
    profile_of(b, s, inlet_of(c, s, b));  // refuses a profile that does not fit the opening
    const double area = area_of(b.patch), speed = largest_mean_speed(alone, c.stop.time, area_of);
    const double diameter = 4.0 * area / perimeter_of(s, b.patch);
    a.inlets.push_back({b.patch, area, speed, diameter, reynolds(c.air, speed, diameter)});
  }
  if (c.air.model == AirModel::lbm) {
    require_room(c, s, std::numeric_limits<double>::infinity());
    a.reference_speed = reference_speed(c, area_of);
    if (!(a.reference_speed > 0.0)) {
      const EstimatedSpeed estimate = estimated_speed(c, s);
      a.reference_speed = estimate.value;
      if (!estimate.warning.empty()) a.warnings.push_back(estimate.warning);
    }
    if (!(a.reference_speed > 0.0)) throw CaseError({problem_at(c, "numerics.reference_speed", no_speed)});
    const std::vector<std::string> openings = openings_of(c);
    geometry::VoxelizeOptions options;
    options.periodic = periodic_directions(c, s);
    if (!openings.empty()) options.openings = s.marked(openings);
    options.flush = s.marked(slip_patches_of(c));
    const geometry::TriangleTree tree(s.mesh);
    geometry::Pockets dropped;
    double narrowing = 1.0;
    try {
      const geometry::Voxels voxels = geometry::voxelize(tree, cell_size(c.numerics, s.volume), options, &dropped);
      const geometry::VoxelReport report = geometry::voxel_report(tree, voxels, s.patches, openings, dropped);
      geometry::refuse_buried(report.hidden);
      a.thin_walls = report.hidden.thin;
      a.cells_fluid = static_cast<std::int64_t>(report.cells_fluid);
      a.volume_voxels = report.volume_voxels;
      a.narrowest_gap = report.narrowest_gap;
      a.thinnest_wall = report.thinnest_wall;
      narrowing = section_ratio(c, s, tree, voxels);
    } catch (const std::invalid_argument& e) {
      throw geometry::GeometryError(e.what());
    }
    if (narrowing > 1.0) a.reference_speed = reference_speed(c, area_of, narrowing);
    const LatticeSpeed speed = lattice_speed(c, s, a.reference_speed);
    c.numerics.lattice_speed = speed.value;
    if (!speed.warning.empty()) a.warnings.push_back(speed.warning);
    a.lattice = lattice_numbers(c, cell_size(c.numerics, s.volume), a.reference_speed, area_of, narrowing);
  }
  if (c.air.model != AirModel::lbm) {
    const geometry::TriangleTree tree(s.mesh);
    geometry::refuse_buried(geometry::buried_places(tree, s.marked(openings_of(c))));
  }
  if (c.air.model == AirModel::frozen && c.fines) {  // cells without a lattice: the fines are carried through them
    require_room(c, s, std::numeric_limits<double>::infinity());
    a.cells_fluid = std::llround(s.volume / std::pow(cell_size(c.numerics, s.volume), 3));
  }
  a.memory = memory_of(c, a, s);
  warn(c, a);
  return a;
}

}  // namespace puffin::cases
