#include "lbm/link_schedule.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "lbm/openings.hpp"
#include "lbm/populations.hpp"

namespace puffin::lbm {

namespace {

constexpr int long_run = 4;  // cells: their neighbours are read at once, those of groups one by one

/// Chunk of every run.
std::vector<std::int32_t> chunk_of_runs(const Rows& rows) {
  std::vector<std::int32_t> chunk(rows.runs().size());
  for (std::size_t c = 0; c < rows.chunks().size(); ++c)
    std::fill(chunk.begin() + rows.chunks()[c].first_run, chunk.begin() + rows.chunks()[c].last_run,
              static_cast<std::int32_t>(c));
  return chunk;
}

struct Needs {
  std::int32_t from = 0, last = 0;  // chunks
};

/// The chunks that cells [first, end) of a wall run read: their own, and those of the cells behind their near links.
Needs needs_of(const Rows& rows, const Links& links, const std::vector<std::int32_t>& chunk, const WallRun& wall,
               int first, int end) {
  const Run& run = rows.runs()[wall.run];
  Needs needs{chunk[wall.run], chunk[wall.run]};
  bool last_of_all = false;  // it needs what crosses periodic faces, or comes back at an outlet
  for (std::uint32_t near = wall.directions & ~wall.far; near != 0; near &= near - 1) {
    const std::ptrdiff_t back = neighbour_offset(run, d3q19::opposite(std::countr_zero(near)));
    for (int n = first; n < end; ++n) {
      const std::ptrdiff_t behind = wall.first + n + back;
      if (rows.is_active(behind)) {
        const std::int32_t other = chunk[run_of(rows, behind)];
        needs.from = std::min(needs.from, other);
        needs.last = std::max(needs.last, other);
      } else {  // a solid cell has no weight; the image of an active one has its value after the periodic faces
        const auto c = rows.cell(behind);
        last_of_all = last_of_all || rows.active_slot(c[0], c[1], c[2]) >= 0 ||
                      first_outlet_link(links.outlets, wall.first + n) >= 0;
      }
    }
  }
  if (last_of_all) needs.from = -1;
  return needs;
}

/// A wall run or cell, and what it waits for.
struct Item {
  Needs needs;
  const WallRun* wall;
  int cell;  // within the wall run
};

/// Runs are done in the order of what they need.
bool before(const Item& a, const Item& b) {
  return std::pair(a.needs.last, -a.needs.from) < std::pair(b.needs.last, -b.needs.from);
}

/// Cells of equal kind are one group. Those that need no chunk but their own, and those that need periodic faces
/// or outlets, are apart from the others, of which a group waits for the earliest that any of them needs: few groups,
/// so few packs that are not full.
auto kind_of(const Item& i) {
  const int reach = i.needs.from == i.needs.last ? 0 : i.needs.from >= 0 ? 1 : 2;
  return std::tuple(i.needs.last, reach, i.wall->directions, i.wall->far, i.wall->moving);
}
struct Group {
  std::size_t first, end;  // of the cells in order of kind
  Needs needs;
};
std::vector<Group> groups_of(const std::vector<Item>& cells) {
  std::vector<Group> groups;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    if (groups.empty() || kind_of(cells[groups.back().first]) != kind_of(cells[n]))
      groups.push_back({n, n, cells[n].needs});
    Group& group = groups.back();
    group.end = n + 1;
    group.needs.from = std::min(group.needs.from, cells[n].needs.from);
  }
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return std::pair(a.needs.last, -a.needs.from) < std::pair(b.needs.last, -b.needs.from);
  });
  return groups;
}

/// First of each chunk in a list ordered by chunk.
template <class List, class ChunkOf>
std::vector<std::size_t> first_of_chunks(const List& list, std::size_t chunks, const ChunkOf& chunk_of) {
  std::vector<std::size_t> first(chunks + 1, list.size());
  for (std::size_t c = 0, k = 0; c < chunks; ++c) {
    while (k < list.size() && chunk_of(list[k]) < static_cast<std::int32_t>(c)) ++k;
    first[c] = k;
  }
  return first;
}

void add_group(const Rows& rows, const Links& links, const std::vector<Item>& cells, const Group& group,
               LinkSchedule& schedule) {
  const WallRun& like = *cells[group.first].wall;
  std::vector<Item> members(cells.begin() + static_cast<std::ptrdiff_t>(group.first),
                            cells.begin() + static_cast<std::ptrdiff_t>(group.end));
  while (members.size() % group_unit != 0) members.push_back(members.back());
  schedule.groups.push_back({static_cast<std::int32_t>(members.size()), like.directions, like.far, like.moving,
                             schedule.places.size(), schedule.partner.size()});
  const auto put_places = [&](int direction) {
    for (const Item& item : members) {
      const WallRun& wall = *item.wall;
      const std::ptrdiff_t slot = wall.first + item.cell;
      schedule.places.push_back(static_cast<std::int32_t>(slot + neighbour_offset(rows.runs()[wall.run], direction)));
    }
  };
  put_places(0);
  int link = 0;
  for (std::uint32_t bits = like.directions; bits != 0; bits &= bits - 1, ++link) {
    const int i = std::countr_zero(bits);
    put_places(i);
    put_places(d3q19::opposite(i));
    for (const Item& item : members) {
      const WallRun& wall = *item.wall;
      const std::size_t at = wall.coefficient + static_cast<std::size_t>(link) * wall.count + item.cell;
      schedule.partner.push_back(links.partner[at]);
      if (links.moving.empty()) continue;
      schedule.moving.push_back(links.moving[at]);
      schedule.returned.push_back(links.returned[at]);
    }
  }
}

}  // namespace

std::int32_t run_of(const Rows& rows, std::ptrdiff_t slot) {  // runs lie in memory in their order
  const auto after = std::upper_bound(rows.runs().begin(), rows.runs().end(), slot,
                                      [](std::ptrdiff_t s, const Run& run) { return s < run.first; });
  return static_cast<std::int32_t>(after - rows.runs().begin()) - 1;
}

Waiting::Range Waiting::ready(int chunk, int begin) const {
  const auto from = needs_from.begin();
  const auto late = std::partition_point(from + static_cast<std::ptrdiff_t>(first[chunk]),
                                         from + static_cast<std::ptrdiff_t>(first[chunk + 1]),
                                         [begin](std::int32_t needed) { return needed >= begin; });
  return {first[chunk], static_cast<std::size_t>(late - from)};
}

LinkSchedule schedule_links(const Rows& rows, const Links& links, const std::vector<std::uint8_t>& fluid) {
  const std::vector<std::int32_t> chunk = chunk_of_runs(rows);
  const std::size_t chunks = rows.chunks().size();
  std::vector<Item> runs, cells;
  for (const WallRun& wall : links.walls) {
    if (wall.count >= long_run) {
      runs.push_back({needs_of(rows, links, chunk, wall, 0, wall.count), &wall, 0});
      continue;
    }
    for (int n = 0; n < wall.count; ++n) cells.push_back({needs_of(rows, links, chunk, wall, n, n + 1), &wall, n});
  }
  std::stable_sort(runs.begin(), runs.end(), before);
  std::stable_sort(cells.begin(), cells.end(), [](const Item& a, const Item& b) { return kind_of(a) < kind_of(b); });

  LinkSchedule schedule;
  for (const Item& item : runs) {
    schedule.runs.push_back(*item.wall);
    schedule.waiting_runs.needs_from.push_back(item.needs.from);
  }
  schedule.waiting_runs.first = first_of_chunks(runs, chunks, [](const Item& item) { return item.needs.last; });
  const std::vector<Group> groups = groups_of(cells);
  for (const Group& group : groups) {
    add_group(rows, links, cells, group, schedule);
    schedule.waiting_groups.needs_from.push_back(group.needs.from);
  }
  schedule.waiting_groups.first = first_of_chunks(groups, chunks, [](const Group& group) { return group.needs.last; });
  const auto chunk_of_link = [&](const OpeningLink& link) { return chunk[link.run]; };
  schedule.inlets = first_of_chunks(links.inlets, chunks, chunk_of_link);
  schedule.outlets = first_of_chunks(links.outlets, chunks, chunk_of_link);
  schedule.outlet_sources = find_outlet_sources(rows, links.outlets, fluid);
  return schedule;
}

}  // namespace puffin::lbm
