#include "lbm/moving_walls.hpp"

#include <bit>

#include "lbm/d3q19.hpp"
#include "lbm/populations.hpp"

namespace puffin::lbm {

namespace {

/// Cut links of walls by cell and direction.
class WallLinkIndex {
 public:
  WallLinkIndex(const Rows& rows, const Links& links) : links_(links), wall_of_(rows.slots(), -1) {
    for (std::size_t w = 0; w < links.walls.size(); ++w)
      for (int n = 0; n < links.walls[w].count; ++n) wall_of_[links.walls[w].first + n] = static_cast<std::int32_t>(w);
  }
  /// Index of its coefficients; -1: no wall cuts this link.
  std::ptrdiff_t find(std::ptrdiff_t slot, int direction) const {
    if (slot < 0 || wall_of_[slot] < 0) return -1;
    const WallRun& wall = links_.walls[wall_of_[slot]];
    if (!(wall.directions >> direction & 1U)) return -1;
    const int before = std::popcount(wall.directions & ((1U << direction) - 1U));
    return static_cast<std::ptrdiff_t>(wall.coefficient) + std::ptrdiff_t{before} * wall.count + (slot - wall.first);
  }

 private:
  const Links& links_;
  std::vector<std::int32_t> wall_of_;  // [slot]
};

/// The direction along axis d with this sign.
constexpr int along(int d, int sign) { return 2 * d + (sign > 0 ? 1 : 2); }

int direction_of(const std::array<int, 3>& c) {
  for (int i = 1; i < d3q19::q; ++i)
    if (d3q19::velocity[i][0] == c[0] && d3q19::velocity[i][1] == c[1] && d3q19::velocity[i][2] == c[2]) return i;
  return 0;
}

}  // namespace

void carry_along_walls(const Rows& rows, const LinkGeometry& surface, Links& links) {
  links.returned = links.moving;
  for (const Boundary& b : surface.boundaries)
    if (b.kind == BoundaryKind::velocity_inlet || b.kind == BoundaryKind::pressure_outlet) return;
  const WallLinkIndex index(rows, links);
  const auto at_rest = [&](std::ptrdiff_t link) {
    return link >= 0 && !surface.boundaries[links.wall_patch[link]].profile;
  };
  for (const WallRun& wall : links.walls) {
    if (!wall.moving) continue;
    for (int n = 0; n < wall.count; ++n)
      for (int i = 7; i < d3q19::q; ++i) {  // face diagonals
        const std::ptrdiff_t slot = wall.first + n, own = index.find(slot, i);
        if (own < 0 || links.returned[own] == 0.0F) continue;
        const auto cell = rows.cell(slot);
        const auto& c = d3q19::velocity[i];
        bool carried = false, blocked = false;
        for (int d = 0; d < 3 && !carried; ++d) {
          if (c[d] == 0) continue;
          blocked = blocked || at_rest(index.find(slot, along(d, c[d])));
          auto beside = cell;
          beside[d] += c[d];
          std::array<int, 3> back{c[0], c[1], c[2]};
          back[d] = -back[d];
          if (index.find(slot, along(d, c[d])) >= 0) continue;  // a wall stands between
          const std::ptrdiff_t other = rows.active_slot(beside[0], beside[1], beside[2]);
          const std::ptrdiff_t partner = index.find(other, direction_of(back));
          if (partner < 0 || links.returned[partner] != -links.moving[own]) continue;
          carried = true;
          links.returned[own] = links.returned[partner] = 0.0F;
          const double leaves = -static_cast<double>(links.moving[own]);
          links.carried.push_back({c[d] > 0 ? slot : other, static_cast<std::int8_t>(d), c[d] * leaves});
        }
        if (!carried && blocked) links.moving[own] = links.returned[own] = 0.0F;
      }
  }
}

}  // namespace puffin::lbm
