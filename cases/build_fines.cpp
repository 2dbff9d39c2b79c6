#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cases/build.hpp"
#include "cases/micromodel_file.hpp"
#include "coupling/carry_fines.hpp"
#include "coupling/frozen_fluxes.hpp"
#include "coupling/regain_fines.hpp"
#include "coupling/wall_faces.hpp"

namespace puffin::cases {

namespace {

/// [slot] patch index of the ghosts that lie in an opening, else -1.
std::vector<int> patches_of_openings(const lbm::Air& air, const lbm::FluxRoutes& routes) {
  std::vector<int> patch(air.rows.slots(), -1);
  for (const auto* list : {&air.links.inlets, &air.links.outlets})
    for (const auto& link : *list) {
      for (const auto& o : routes.openings) {
        if (o.slot != link.slot || o.direction != link.direction) continue;
        std::ptrdiff_t ghost = o.face;
        if (o.sign > 0) ghost += lbm::neighbour_offset(air.rows.runs()[air.run_of_slot[o.face]], 2 * o.axis + 1);
        patch[ghost] = link.patch;
      }
    }
  return patch;
}

/// What [[fines.boundary]] holds for the scalars of one set, as amounts in a cell full of air, by patch: the value in
/// the first, and nothing of what comes off carriers in the others, so that their sum is the value.
std::vector<std::optional<double>> fixed_values(const Simulation& s, const std::string& scalar, bool first) {
  std::vector<std::optional<double>> values;
  for (const ScalarBoundary& b : s.description.fines->boundaries) {
    if (b.scalar != scalar) continue;
    const int patch = s.surface.patches.find(b.patch);
    values.resize(s.models.patches.size());
    values[static_cast<std::size_t>(patch)] = first ? b.value * std::pow(s.dx, 3) : 0.0;
  }
  return values;
}

/// Fines in the air at the start: exp(-r^2/(2 sigma^2)) at the centres of the cells, scaled to the wanted amount.
void place_cloud(const GaussianBlob& cloud, const lbm::Air& air, std::vector<double>& amount) {
  const lbm::Rows& rows = air.rows;
  double sum = 0.0;
  for (const auto& run : rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot) {
      if (!air.is_fluid(slot)) continue;
      Vec3 r = rows.centre(slot) - cloud.center;
      for (int d = 0; d < 3; ++d)  // of the periodic images the nearest
        if (rows.periodic()[d]) r[d] -= rows.dx() * rows.box()[d] * std::round(r[d] / (rows.dx() * rows.box()[d]));
      amount[slot] = std::exp(-0.5 * r.squaredNorm() / (cloud.sigma * cloud.sigma));
      sum += amount[slot];
    }
  if (!(sum > 0.0))
    throw std::invalid_argument("fines.scalar.initial: the cloud lies outside the air; move its center inside");
  for (const auto& run : rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot) amount[slot] *= cloud.amount / sum;
}

lbm::ScalarLaw law_of(const Scalar& scalar) {
  lbm::ScalarLaw law;
  law.scheme = scalar.scheme == ScalarScheme::upwind     ? lbm::Scheme::upwind
               : scalar.scheme == ScalarScheme::minmod   ? lbm::Scheme::minmod
               : scalar.scheme == ScalarScheme::van_leer ? lbm::Scheme::van_leer
                                                         : lbm::Scheme::mc;
  law.wall = scalar.wall == ScalarWall::absorb ? lbm::WallRule::absorb : lbm::WallRule::reflect;
  return law;
}

bool is_opening(const Simulation& s, int patch) {
  if (patch < 0 || static_cast<std::size_t>(patch) >= s.models.patches.size()) return false;
  const auto& p = s.models.patches[static_cast<std::size_t>(patch)];
  return p.is_inlet || p.is_outlet;
}

/// [patch] 1: a wall on which a value is held for some scalar; empty: there is none.
std::vector<char> holding_walls(const Simulation& s) {
  std::vector<char> holds;
  for (const ScalarBoundary& b : s.description.fines->boundaries) {
    const int patch = s.surface.patches.find(b.patch);
    if (is_opening(s, patch)) continue;
    holds.resize(s.models.patches.size(), 0);
    holds[static_cast<std::size_t>(patch)] = 1;
  }
  return holds;
}

/// [triangle] 1: of an opening or a periodic patch, where there is no wall.
std::vector<char> triangles_without_wall(const Simulation& s) {
  std::vector<char> without(s.models.patches.size() + 1, 0);  // by patch; the last: of no patch
  for (std::size_t p = 0; p + 1 < without.size(); ++p) without[p] = is_opening(s, static_cast<int>(p));
  for (const Boundary& b : s.description.air.boundaries)
    if (b.type == BoundaryType::periodic)
      for (const std::string& name : {b.patch, b.with})
        if (const int patch = s.surface.patches.find(name); patch >= 0) without[static_cast<std::size_t>(patch)] = 1;
  std::vector<char> found;
  for (const int patch : s.surface.patches.of_triangle)
    found.push_back(without[patch < 0 ? without.size() - 1 : static_cast<std::size_t>(patch)]);
  return found;
}

/// What the inertia of the fines does, and which triangle a cell beside a wall belongs to.
void build_drift(Simulation& s) {
  const Fines& f = *s.description.fines;
  const lbm::Rows& rows = s.state.air->rows;
  const bool inertia = f.wall_deposition != WallDeposition::none;
  const std::vector<char> holds = holding_walls(s);
  bool absorbs = !holds.empty();
  for (const Scalar& scalar : f.scalars) absorbs = absorbs || scalar.wall == ScalarWall::absorb;
  if (!inertia && !absorbs) return;
  const auto walls = coupling::find_wall_cells(rows, s.state.fluxes, *s.tree, triangles_without_wall(s));
  s.models.triangle_of_slot.assign(rows.slots(), -1);
  for (const auto& cell : walls) {  // the nearest comes first
    int& triangle = s.models.triangle_of_slot[static_cast<std::size_t>(cell.slot)];
    if (triangle < 0) triangle = cell.triangle;
  }
  if (!holds.empty()) {
    const auto faces =
        coupling::find_wall_faces(*s.state.air, s.state.fluxes, walls, s.surface.patches.of_triangle, holds);
    for (int d = 0; d < 3; ++d)
      for (const auto& [face, triangle] : faces[d]) {
        s.state.scalars.work.held_walls[d].push_back(face);
        s.models.triangle_of_slot[static_cast<std::size_t>(face.cell)] = triangle;  // of two walls, that which holds
      }
  }
  if (!inertia) return;
  coupling::FinesDrift drift;
  drift.response_time = coupling::response_time(f.diameter, f.density, s.description.air.viscosity);
  drift.gravity = f.gravity;
  drift.deposits = f.wall_deposition == WallDeposition::inertial;
  drift.walls = walls;
  if (s.models.frozen_air) {
    for (auto& cell : drift.walls) cell.inside = cell;  // the field is known in the wall's cells too
    coupling::set_frozen_drift(rows, s.models.frozen_air, drift, s.state.fines_drift);
    coupling::add_drift(rows, s.state.routes, s.state.scale, drift, s.state.fines_drift, s.state.fluxes);
  }
  s.models.drift = std::move(drift);
}

/// Fines that come back to carriers.
void build_regain(Simulation& s) {
  const Fines& f = *s.description.fines;
  if (!(f.reattachment > 0.0 || f.pick_up > 0.0)) return;
  coupling::Regain regain;
  regain.sticking = f.reattachment;
  regain.pick_up = f.pick_up;
  regain.fine_diameter = f.diameter;
  regain.response_time = coupling::response_time(f.diameter, f.density, s.description.air.viscosity);
  for (int t = 0; t < static_cast<int>(s.surface.mesh.triangles.size()); ++t)
    regain.area.push_back(s.surface.mesh.area(t));
  s.models.regain = std::move(regain);
}

/// As long as no more fines of a scalar than this are airborne, it is not carried on: 0.3 millionths of the dose. The
/// three scalars of a set together stay below the millionth at which a run counts as empty, and far above what the
/// first touches of a shaking bed release (1e-19 to 1e-16 of the dose, docs/fines.md); a chaotic outcome is known to a
/// tenth. Where a case puts fines into the air itself, a billionth of all.
double negligible_fines(const Fines& f, double dose, double in_all) {
  const bool clouds =
      std::any_of(f.scalars.begin(), f.scalars.end(), [](const Scalar& x) { return x.initial.has_value(); });
  return f.micromodels.empty() || clouds ? 1e-9 * in_all : 3e-7 * dose;
}

}  // namespace

void build_fines(Simulation& s) {
  const Fines& f = *s.description.fines;
  if (!f.micromodels.empty()) s.models.fines = read_micromodels(f.micromodels);
  if (!s.state.air) {
    build_regain(s);
    return coupling::keep_fines_in_one_place(static_cast<int>(f.scalars.size()), s.state);
  }
  const lbm::Air& air = *s.state.air;
  s.state.routes = lbm::find_routes(air, s.state.fluxes);
  if (s.models.frozen_air)
    coupling::set_frozen_fluxes(air.rows, s.state.routes, s.state.scale, s.models.frozen_air, s.state.fluxes);
  const Numerics& n = s.description.numerics;
  s.models.scalars.cfl = n.scalar_cfl;
  s.models.scalars.single = !s.models.frozen_air && n.precision == Precision::float32;  // as the fluxes are
  s.models.scalars.skip_empty = n.skip.empty_cells;
  s.models.idle_transport = n.skip.idle_transport;
  s.models.transport_steps = n.skip.transport_steps;
  if (f.turbulent_schmidt > 0.0 && (s.models.frozen_air || s.description.numerics.les != Les::smagorinsky))
    throw std::invalid_argument(
        "fines.turbulent_schmidt: fines are mixed by the unresolved eddies of air.model = \"lbm\" with numerics.les = "
        "\"smagorinsky\"; set these, or leave it out");
  s.models.turbulent_schmidt = f.turbulent_schmidt;
  const int sets = static_cast<int>(f.scalars.size());
  s.state.scalars = lbm::ScalarFields(air.rows, coupling::mechanisms * sets, patches_of_openings(air, s.state.routes));
  build_drift(s);
  build_regain(s);
  s.state.budget = lbm::ScalarBudget(air.rows, coupling::mechanisms * sets, static_cast<int>(s.models.patches.size()));
  s.state.fines.placed.assign(f.scalars.size(), 0.0);
  double in_all = s.state.fines.loaded;
  for (int set = 0; set < sets; ++set) {
    const Scalar& scalar = f.scalars[set];
    for (int m = 0; m < coupling::mechanisms; ++m) {
      s.models.scalars.scalar.push_back(law_of(scalar));
      s.models.scalars.scalar.back().fixed = fixed_values(s, scalar.name, m == 0);
      s.models.diffusion.push_back(scalar.diffusion / s.description.air.density);
    }
    // What no carrier brought goes with the first of the scalars of a set: it is nobody's release.
    const int first = coupling::scalar_index(set, coupling::Mechanism::wall);
    if (scalar.initial) {
      place_cloud(*scalar.initial, air, s.state.scalars.amount[first]);
      s.state.fines.placed[set] = lbm::total(s.state.scalars, first);
    }
    in_all = std::max(in_all, s.state.fines.loaded + s.state.fines.placed[set]);
    s.state.airborne = s.state.airborne || scalar.initial || !s.models.scalars.scalar[first].fixed.empty();
  }
  if (n.skip.idle_transport) s.models.scalars.negligible = negligible_fines(f, s.state.fines.loaded, in_all);
}

}  // namespace puffin::cases
