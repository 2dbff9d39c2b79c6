#include "lbm/band_fluxes.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "lbm/air.hpp"
#include "lbm/band_level.hpp"
#include "lbm/scalars/face_fluxes.hpp"

namespace puffin::lbm {

namespace {

/// A neighbour through an open face, and the face between.
struct Step {
  std::ptrdiff_t cell = -1;
  BookedFace face;
};

class Faces {
 public:
  Faces(const Air& air, const FaceFluxes& fluxes) : air_(air), fluxes_(fluxes) {}
  /// Through face 2 d + (0: low, 1: high) of an active cell; cell -1 where it is closed.
  Step beyond(std::ptrdiff_t slot, int side) const {
    const int d = side / 2;
    const bool high = side % 2 != 0;
    auto c = air_.rows.cell(slot);
    c[d] += high ? 1 : -1;
    const std::ptrdiff_t other = air_.rows.active_slot(c[0], c[1], c[2]);
    if (other < 0) return {};
    const std::ptrdiff_t face = high ? slot : other;
    if (fluxes_.open[d][face] != 1) return {};
    return {other, {face, static_cast<std::int8_t>(d), static_cast<std::int8_t>(high ? 1 : -1)}};
  }

 private:
  const Air& air_;
  const FaceFluxes& fluxes_;
};

/// The shortest way from one fluid cell to another through fluid cells, at most `most` faces; empty: none.
std::vector<BookedFace> way(const Air& air, const Faces& faces, std::ptrdiff_t from, std::ptrdiff_t to, int most) {
  struct Visited {
    std::ptrdiff_t cell;
    int before;
    BookedFace face;
    int depth;
  };
  std::vector<Visited> visited{{from, -1, {}, 0}};
  for (std::size_t n = 0; n < visited.size(); ++n) {
    if (visited[n].depth >= most) break;
    for (int side = 0; side < 6; ++side) {
      const Step step = faces.beyond(visited[n].cell, side);
      if (step.cell < 0 || !air.is_fluid(step.cell)) continue;
      if (std::any_of(visited.begin(), visited.end(), [&](const Visited& v) { return v.cell == step.cell; })) continue;
      visited.push_back({step.cell, static_cast<int>(n), step.face, visited[n].depth + 1});
      if (step.cell != to) continue;
      std::vector<BookedFace> found;
      for (int k = static_cast<int>(visited.size()) - 1; visited[k].before >= 0; k = visited[k].before)
        found.push_back(visited[k].face);
      return found;
    }
  }
  return {};
}

}  // namespace

BandFluxes find_band_fluxes(const Air& air, FaceFluxes& fluxes) {
  BandFluxes band;
  if (!air.markers) return band;
  band.open = fluxes.open;
  const Faces faces(air, fluxes);
  const std::vector<std::ptrdiff_t> root = band_roots(air.rows, air.fluid, air.links);
  std::map<std::pair<std::ptrdiff_t, int>, std::vector<BookedFace>> gains;  // (face, axis) -> band faces
  for (const Run& run : air.rows.runs())
    for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s)
      for (const int side : {1, 3, 5}) {
        const Step step = faces.beyond(s, side);
        if (step.cell < 0 || (air.is_fluid(s) && air.is_fluid(step.cell))) continue;
        if (root[s] < 0 || root[step.cell] < 0 || root[s] == root[step.cell]) continue;
        const auto path = way(air, faces, root[s], root[step.cell], 6);
        if (path.empty()) ++band.unbooked;
        for (const BookedFace& f : path) gains[{f.face, f.axis}].push_back({step.face.face, step.face.axis, f.sign});
      }
  for (const auto& [place, sources] : gains) {
    band.to.push_back({place.first, static_cast<std::int8_t>(place.second), 1});
    band.from.insert(band.from.end(), sources.begin(), sources.end());
    band.first.push_back(static_cast<std::int32_t>(band.from.size()));
  }
  for (const Run& run : air.rows.runs())
    for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s)
      for (const int side : {1, 3, 5}) {
        const Step step = faces.beyond(s, side);
        if (step.cell >= 0 && !(air.is_fluid(s) && air.is_fluid(step.cell)))
          band.open[side / 2][s] = 3;  // closed below, when all ways have been found
      }
  for (int d = 0; d < 3; ++d)
    for (std::size_t s = 0; s < band.open[d].size(); ++s)
      if (band.open[d][s] == 3) {
        band.open[d][s] = 1;
        fluxes.open[d][s] = 0;
      }
  return band;
}

void book_band_fluxes(const BandFluxes& band, FaceFluxes& fluxes) {
  oneapi::tbb::parallel_for(
      oneapi::tbb::blocked_range<std::size_t>(0, band.to.size(), 1024),
      [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          double sum = 0.0;
          for (std::int32_t e = band.first[k]; e < band.first[k + 1]; ++e)
            sum += band.from[e].sign * fluxes.mass[band.from[e].axis][band.from[e].face];
          fluxes.mass[band.to[k].axis][band.to[k].face] += sum;
        }
      },
      oneapi::tbb::static_partitioner());
}

}  // namespace puffin::lbm
