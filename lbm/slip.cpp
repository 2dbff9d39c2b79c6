#include "lbm/slip.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <map>

namespace puffin::lbm {

namespace {

int direction_of(const std::array<int, 3>& c) {
  for (int i = 0; i < d3q19::q; ++i)
    if (d3q19::velocity[i] == c) return i;
  return -1;
}

}  // namespace

void join_slip_links(const Rows& rows, std::vector<SlipLink>& links) {
  if (links.empty()) return;
  std::map<std::pair<std::ptrdiff_t, int>, std::int32_t> cut;  // (slot, direction) -> run
  for (const SlipLink& link : links) cut[{link.slot, link.direction}] = link.run;
  const auto neighbour = [&](std::ptrdiff_t slot, int axis, int step) {
    auto c = rows.cell(slot);
    c[axis] += step;
    return rows.active_slot(c[0], c[1], c[2]);
  };
  for (SlipLink& link : links) {
    const auto& c = d3q19::velocity[link.direction];
    for (int n = 0; n < 3 && link.direction > 6; ++n) {  // n: the axis along the wall's normal
      for (int t = 0; t < 3; ++t) {
        if (t == n || c[n] == 0 || c[t] == 0) continue;
        const std::ptrdiff_t beside = neighbour(link.slot, t, c[t]);
        if (neighbour(link.slot, n, c[n]) >= 0 || beside < 0 || neighbour(beside, n, c[n]) >= 0) continue;
        auto turned = c;
        turned[t] = -c[t];
        const int i = direction_of(turned);
        const auto partner = cut.find({beside, i});
        if (partner == cut.end()) continue;
        link.source = beside;
        link.source_run = partner->second;
        link.source_direction = static_cast<std::int16_t>(i);
      }
    }
  }
}

template <class T>
void reflect_at_slip_walls(const Rows& rows, const std::vector<SlipLink>& links, Parity last, Populations<T>& p) {
  oneapi::tbb::parallel_for(
      oneapi::tbb::blocked_range<std::size_t>(0, links.size(), 1024),
      [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          const SlipLink& link = links[k];
          const Run& run = rows.runs()[link.run];
          const T f = p.departed(rows.runs()[link.source_run], link.source, link.source_direction, last);
          // Departed values stand at the cells' own places after an even step and in the ghosts after an odd one;
          // what comes back is written to the other kind of place: no write meets a read.
          const int i = link.direction;
          if (last == Parity::even)
            p.f[i * p.stride + link.slot + neighbour_offset(run, i)] = f;
          else
            p.f[d3q19::opposite(i) * p.stride + link.slot] = f;
        }
      },
      oneapi::tbb::static_partitioner());
}

template void reflect_at_slip_walls(const Rows&, const std::vector<SlipLink>&, Parity, Populations<float>&);
template void reflect_at_slip_walls(const Rows&, const std::vector<SlipLink>&, Parity, Populations<double>&);

}  // namespace puffin::lbm
