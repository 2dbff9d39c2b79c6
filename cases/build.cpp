#include "cases/build.hpp"

#include "cases/derived.hpp"

namespace puffin::cases {

std::unique_ptr<Simulation> build(const Case& c) {
  auto s = std::make_unique<Simulation>();
  s->description = c;
  s->surface = load_surface(c);
  if (const auto problems = unknown_patches(c, s->surface.patches); !problems.empty()) throw CaseError(problems);
  s->tree = std::make_shared<const lbm::geometry::TriangleTree>(s->surface.mesh);
  if (c.air.model == AirModel::lbm || c.numerics.dx) s->dx = cell_size(c.numerics, s->surface.volume);
  build_air(*s);
  if (c.carriers) build_carriers(*s);
  if (c.fines) build_fines(*s);
  return s;
}

}  // namespace puffin::cases
