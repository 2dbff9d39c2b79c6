#include "cases/build.hpp"

#include <stdexcept>

#include "cases/check_boundaries.hpp"
#include "cases/check_places.hpp"
#include "cases/derived.hpp"
#include "cases/inlet_profile.hpp"
#include "cases/room.hpp"
#include "cases/untagged_openings.hpp"

namespace puffin::cases {

std::unique_ptr<Simulation> build(const Case& c, const StoredFieldReader& stored_field, double available,
                                  const std::filesystem::path& beds) {
  auto s = std::make_unique<Simulation>();
  s->description = c;
  s->beds = beds;
  s->surface = load_surface(c);
  for (const lbm::geometry::Defect& d : s->surface.defects)
    if (d.kind == "duplicate facet") s->warnings.push_back(d.kind + ": " + d.message);
  if (const auto problems = boundary_problems(c, s->surface); !problems.empty()) throw CaseError(problems);
  for (std::string& text : boundary_warnings(c, s->surface)) s->warnings.push_back(std::move(text));
  refuse_untagged_openings(c, s->surface.patches);
  require_room(c, s->surface, available);
  s->tree = std::make_shared<const lbm::geometry::TriangleTree>(s->surface.mesh);
  if (const auto problems = carrier_place_problems(c, *s->tree); !problems.empty()) throw CaseError(problems);
  if (c.air.model == AirModel::lbm || c.numerics.dx || c.numerics.cells)
    s->dx = cell_size(c.numerics, s->surface.volume);
  complete_file_profiles(s->surface, s->description);
  if (const auto* run = std::get_if<RunField>(&c.air.frozen); run && c.air.model == AirModel::frozen) {
    if (!stored_field) throw std::invalid_argument("air.field: this program cannot read the field of another run");
    s->stored_field = from_file(c, "air.field", [&] { return stored_field(*run); });
  }
  build_air(*s);
  // The maps of the walls have a place for every triangle, carriers or not: fines of an inflow stick to walls too.
  s->state.collisions = coupling::Collisions(dem::Carriers{}, s->surface.mesh.triangles.size());
  s->state.fines = coupling::Fines(dem::Carriers{}, 0.0, s->surface.mesh.triangles.size());
  if (c.carriers) build_carriers(*s);
  if (c.fines)
    build_fines(*s);
  else if (s->state.air)
    s->state.air->links.corner_images.clear();  // only what carries fines reads them
  return s;
}

}  // namespace puffin::cases
