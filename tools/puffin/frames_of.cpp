#include "tools/puffin/frames_of.hpp"

#include <algorithm>
#include <cmath>

#include "tools/puffin/sampling.hpp"

namespace puffin::tools {

namespace {

using coupling::Vec3;

struct Block {
  std::array<int, 3> low{0, 0, 0}, high{0, 0, 0};  // cells [low, high)
};

Block block_of(const lbm::Rows& rows, const cases::Region& region) {
  Block b;
  b.high = rows.box();
  const auto cell = [&](int axis, double at) {
    const int c = static_cast<int>(std::lround((at - rows.origin()[axis]) / rows.dx()));
    return std::clamp(c, 0, rows.box()[axis] - 1);
  };
  if (const auto* slice = std::get_if<cases::RegionSlice>(&region)) {
    b.low[slice->axis] = cell(slice->axis, slice->at);
    b.high[slice->axis] = b.low[slice->axis] + 1;
  } else if (const auto* box = std::get_if<cases::RegionBox>(&region)) {
    for (int d = 0; d < 3; ++d) {
      b.low[d] = cell(d, box->min[d]);
      b.high[d] = cell(d, box->max[d]) + 1;
    }
  }
  return b;
}

}  // namespace

output::FieldFrame field_frame(const cases::Simulation& s, const cases::FieldOutput& wanted) {
  const lbm::Air& air = *s.state.air;
  const Block block = block_of(air.rows, wanted.region);
  output::FieldFrame frame;
  frame.dx = air.rows.dx();
  for (int d = 0; d < 3; ++d) {
    frame.origin[d] = air.rows.origin()[d] + frame.dx * block.low[d];
    frame.size[d] = block.high[d] - block.low[d];
  }
  const std::size_t cells = static_cast<std::size_t>(frame.cells());
  frame.fluid.assign(cells, 0);
  if (wanted.velocity) frame.velocity.assign(3 * cells, 0.0F);
  if (wanted.pressure) frame.pressure.assign(cells, 0.0F);
  const auto& fields = s.state.scalars;
  if (wanted.fines && s.description.fines)
    for (const auto& scalar : s.description.fines->scalars)
      frame.fines.push_back({scalar.name, std::vector<float>(cells, 0.0F)});
  const double volume = frame.dx * frame.dx * frame.dx;
  for (const auto& run : air.rows.runs()) {
    if (run.y < block.low[1] || run.y >= block.high[1] || run.z < block.low[2] || run.z >= block.high[2]) continue;
    for (int n = std::max(0, block.low[0] - run.x); n < run.count && run.x + n < block.high[0]; ++n) {
      const std::ptrdiff_t slot = run.first + n;
      if (!air.is_fluid(slot)) continue;
      const std::size_t at =
          (run.x + n - block.low[0]) +
          static_cast<std::size_t>(frame.size[0]) *
              ((run.y - block.low[1]) + static_cast<std::size_t>(frame.size[1]) * (run.z - block.low[2]));
      frame.fluid[at] = 1;
      if (wanted.velocity || wanted.pressure) {
        const PointReading r = read_cell(s, slot);
        for (int d = 0; d < 3 && wanted.velocity; ++d) frame.velocity[3 * at + d] = static_cast<float>(r.velocity[d]);
        if (wanted.pressure) frame.pressure[at] = static_cast<float>(r.pressure);
      }
      for (std::size_t k = 0; k < frame.fines.size(); ++k) {
        double sum = 0.0;
        for (int m = 0; m < coupling::mechanisms; ++m) sum += fields.amount[coupling::mechanisms * k + m][slot];
        frame.fines[k].values[at] = static_cast<float>(sum / volume);
      }
    }
  }
  return frame;
}

output::CarrierFrame carrier_frame(const cases::Simulation& s) {
  const auto& c = s.state.carriers.carriers;
  output::CarrierFrame frame;
  for (std::size_t p = 0; p < c.size(); ++p) {
    const Vec3 &x = c.position[p], &v = c.velocity[p], &w = c.spin[p];
    frame.position.push_back({x[0], x[1], x[2]});
    frame.id.push_back(static_cast<std::int32_t>(c.id[p]));
    frame.diameter.push_back(static_cast<float>(2.0 * c.radius[p]));
    frame.velocity.push_back({static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])});
    frame.spin.push_back({static_cast<float>(w[0]), static_cast<float>(w[1]), static_cast<float>(w[2])});
    const auto id = static_cast<std::size_t>(c.id[p]);
    frame.fines.push_back(
        static_cast<float>(id < s.state.fines.left.size() ? s.state.fines.left[id] / c.carriers[p] : 0.0));
    frame.asleep.push_back(c.rest[p] == dem::Rest::asleep ? 1 : 0);
  }
  return frame;
}

output::WallFrame wall_frame(const cases::Simulation& s) {
  const auto& mesh = s.surface.mesh;
  output::WallFrame frame;
  for (const Vec3& v : mesh.vertices) frame.vertices.push_back({v[0], v[1], v[2]});
  frame.triangles = mesh.triangles;
  frame.patch.assign(s.surface.patches.of_triangle.begin(), s.surface.patches.of_triangle.end());
  for (std::size_t p = 0; p < s.models.patches.size(); ++p)
    frame.patches.push_back({s.models.patches[p].patch, s.models.patches[p].is_inlet || s.models.patches[p].is_outlet});
  const bool carried = s.state.scalars.scalars() > 0;
  if (!carried && !s.description.carriers) return frame;
  const auto per_area = [&](std::vector<double> map) {
    for (std::size_t t = 0; t < map.size(); ++t)
      if (map[t] != 0.0) map[t] /= mesh.area(static_cast<int>(t));  // nothing lands on a triangle without area
    return map;
  };
  const auto stuck = [&](int set) {
    return coupling::wall_map(s.state.fines, s.state.budget, set, s.models.triangle_of_slot);
  };
  frame.fines = per_area(carried ? stuck(0) : s.state.fines.stuck);
  if (carried)
    for (std::size_t k = 1; k < s.description.fines->scalars.size(); ++k)
      frame.further_fines.emplace_back(s.description.fines->scalars[k].name, per_area(stuck(static_cast<int>(k))));
  if (!s.description.carriers) return frame;  // fines of the inflow alone: nothing hits the walls
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    frame.hits.push_back(s.state.collisions.hits[t]);
    frame.energy.push_back(s.state.collisions.energy[t]);
  }
  return frame;
}

}  // namespace puffin::tools
