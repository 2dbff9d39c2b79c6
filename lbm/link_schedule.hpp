#pragma once
// When each link can be applied: with its cells still in the cache, and beside others like it.
//
// A sweep goes through the chunks of cells in order. The links of a cell need what this cell, and for a wall near it
// the cell behind, have sent out; so they can be applied as soon as the chunks of both are collided, long before the
// whole sweep is. A second pass over the cells at walls, with its wait for memory, is saved. Wall cells that have no
// row of their like are gathered into groups. Outlets also need the cells beside their own, and come when all are
// collided; then walls that wait for an earlier chunk, for periodic faces or for an outlet.
// The order changes no bit as long as inlets and outlets come before the walls of their own cells: a near wall reads
// what comes back along an opening's link, and what an outlet needs of a cell is read before its walls, for it takes
// account of the population at rest, which takes their imbalance. All else that a link writes is a place of its own,
// read by no other link and no collision of the same step.

#include <cstdint>
#include <vector>

#include "lbm/links.hpp"
#include "lbm/rows.hpp"

namespace puffin::lbm {

/// Things that wait for chunks.
struct Waiting {
  /// Per chunk, and one more: the first that waits for this chunk as the last. Within a chunk's part come first those
  /// that need no earlier chunk.
  std::vector<std::size_t> first;
  std::vector<std::int32_t> needs_from;  // the earliest chunk that each needs; -1: periodic faces or outlets

  struct Range {
    std::size_t first, end;
  };
  /// Those that can be done right after `chunk`, when the chunks from `begin` on are collided.
  Range ready(int chunk, int begin) const;
  /// The others that wait for `chunk`.
  Range late(int chunk, int begin) const { return {ready(chunk, begin).end, first[chunk + 1]}; }
};

/// Where what comes back along an outlet link is read. Cells are named by the number of their first outlet link.
struct OutletSource {
  /// Whether the outlet ends a straight passage, as find_outlet_sources() says.
  bool straight = false;
  /// The neighbour beside the link's own cell, one step on along the outlet as the link goes, where that is a cell
  /// before the outlet too; else the own cell.
  std::int32_t beside = 0;
  /// The cell whose velocity tells whether air leaves: the own one if a face of it is the outlet's, else the one
  /// beside.
  std::int32_t judge = 0;
  std::int8_t out = 0;  // direction of the axis that points out of the cell beside; of faces of cells
  /// The cell behind the one beside, away from the outlet, and its run; -1 where there is none.
  std::int32_t run_behind = -1;
  std::ptrdiff_t behind = -1;
};

struct LinkSchedule {
  std::vector<WallRun> runs;  // long ones, with the coefficients of Links
  Waiting waiting_runs;
  std::vector<WallGroup> groups;  // all other wall cells
  Waiting waiting_groups;
  std::vector<std::int32_t> places;              // of the cells of groups: see WallGroup
  std::vector<float> partner, moving, returned;  // of the cells of groups, as those of Links
  std::vector<std::size_t> inlets, outlets;      // per chunk, and one more: first link
  std::vector<OutletSource> outlet_sources;      // per outlet link
};

/// Run that holds an active slot.
std::int32_t run_of(const Rows& rows, std::ptrdiff_t slot);

/// fluid: by slot; empty: every active cell is.
LinkSchedule schedule_links(const Rows& rows, const Links& links, const std::vector<std::uint8_t>& fluid);

}  // namespace puffin::lbm
