#pragma once
// Links: where the line from a cell centre to a neighbour is cut by the surface. Built once, flat lists, no search
// later.
//
// Walls are imposed through the cut links (sharp immersed boundary): the population that leaves the cell along the link
// comes back after reflection at the exact wall distance q (in units of the link), by linear interpolation:
//   q <  1/2:  f_in = 2q f_out + (1-2q) f_out(x - c)        q >= 1/2:  f_in = f_out/(2q) + (1 - 1/(2q)) f_own,
// f_own the post-collision population of the cell in the returning direction.
// Source: Bouzidi, Firdaouss & Lallemand, Phys. Fluids 13, 3452 (2001). Each cell's mass imbalance over its cut links
// goes into its population at rest, so that the air's mass is conserved to round-off and no momentum is added (given
// back over the links it displaced inclined walls twice as far: docs/decisions/0007-walls.md).
// Half-way bounce-back is the same with q = 1/2 everywhere.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lbm/geometry/patch_parts.hpp"
#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/kernel.hpp"
#include "lbm/rows.hpp"

namespace puffin::lbm {

enum class BoundaryKind { wall, velocity_inlet, pressure_outlet, periodic, slip };
enum class WallScheme { bouzidi, halfway, ibm, psm };

class WallSides;

/// For walls that act on whole cells (ibm, psm): which computed cells have their centre in the fluid, and where the
/// walls are. Links between computed cells are then open but for thin walls; links out of them reflect half-way.
struct CellKinds {
  std::vector<std::uint8_t> fluid;  // by slot
  std::shared_ptr<const WallSides> sides;
};

/// The faces of an inlet that has several which do not touch. Each is an opening of its own with one mean speed for
/// all.
struct InletParts {
  geometry::NearestPart nearest;
  std::vector<geometry::Vec3> normal;  // out of the fluid
  std::vector<double> area;            // [m^2] that air crosses
  std::vector<double> share;           // mean normal part of the profile
};

/// What happens at one patch of the surface.
struct Boundary {
  std::string patch;
  BoundaryKind kind = BoundaryKind::wall;
  /// Moving wall: velocity of the surface at a point, in units of the wall speed; empty: at rest.
  /// Velocity inlet: profile at a point relative to the section mean, pointing into the domain.
  std::function<geometry::Vec3(const geometry::Vec3&)> profile;
  /// Velocity inlet: the flow is the mean speed times the area of the patch (true), or times the area of its cells: see
  /// opening_flow.hpp.
  bool exact_flow = false;
  bool slides = false;  // moving wall: with one velocity from end to end, so that it carries air along
  std::shared_ptr<const InletParts> parts{};  // velocity inlet of several faces; null: of one
};

/// One link cut by an opening of the domain.
struct OpeningLink {
  std::ptrdiff_t slot = 0;
  std::int32_t run = 0;
  std::int16_t direction = 0;
  std::int16_t patch = 0;
  double gain = 0.0;       // velocity inlet: population gained for a unit mean speed: -6 w c.profile
  double cubic = 0.0;      // and for its cube, by laws with odd moments of third order: inlet_gains.hpp
  double wall_gain = 0.0;  // for a unit speed of the sliding wall at the edge: less what that carries along
  std::int16_t wall = -1;  // the patch of that wall
  std::int16_t part = 0;   // of an inlet of several faces
};

/// One link cut by a slip wall: what comes back along it is what left `source` in `source_direction`.
struct SlipLink {
  std::ptrdiff_t slot = 0, source = 0;
  std::int32_t run = 0, source_run = 0;
  std::int16_t direction = 0, source_direction = 0;
  std::int16_t patch = 0;
};

struct LinkSchedule;

struct Links {
  std::vector<WallRun> walls;                    // in the order of the rows
  std::vector<float> partner;                    // weight of f_own (far) or f_out(x-c); that of f_out is 1 - partner
  std::vector<float> moving;                     // population gained for a unit wall speed; empty when no wall moves
  std::vector<float> returned;                   // of `moving`, what the cell gives back at once: moving_walls.hpp
  std::vector<std::int16_t> wall_patch;          // per coefficient
  std::vector<OpeningLink> inlets, outlets;      // sorted by slot
  std::shared_ptr<const LinkSchedule> schedule;  // when walls, inlets and outlets are applied
  /// Links between two active cells with a wall between them (thinner than a cell); never in `walls`.
  struct ThinLink {
    std::ptrdiff_t slot = 0;
    std::int32_t run = 0;
    std::int16_t direction = 0;
    std::int16_t patch = 0;
  };
  std::vector<ThinLink> thin;
  std::vector<SlipLink> slip;  // slip.hpp
  /// Mass that a sliding wall carries from one cell to the next for a unit wall speed, through the face that `face`
  /// holds in direction `axis` (face_fluxes.hpp).
  struct Carried {
    std::ptrdiff_t face = 0;
    std::int8_t axis = 0;
    double mass = 0.0;
  };
  std::vector<Carried> carried;
  /// Populations that cross a periodic face: direction, ghost slot, the active slot it mirrors.
  struct Image {
    std::int16_t direction = 0;
    std::ptrdiff_t ghost = 0, active = 0;
  };
  std::vector<Image> images;         // in pairs, first and last of a stretch of neighbouring slots in one direction
  std::vector<Image> corner_images;  // likewise; between two mirrored cells, at periodic corners; for mass fluxes alone
  std::vector<double> opening_cells_area;  // per boundary: area on the lattice, times shares of parts [dx^2]
  std::size_t missed = 0;                  // links out of the fluid on which no surface was found (taken as q = 1)
};

/// Surface, patches and how they act; `patch_of_triangle` indexes `boundaries`.
struct LinkGeometry {
  const geometry::TriangleMesh* mesh = nullptr;
  std::vector<int> patch_of_triangle;
  std::vector<Boundary> boundaries;
};

/// Finds every cut link. Throws std::runtime_error if an opening got no link at all.
Links build_links(const Rows& rows, const LinkGeometry& surface, WallScheme scheme, const CellKinds& kinds = {});

}  // namespace puffin::lbm
