#pragma once
// Settled beds that are kept on the disk, so that runs with the same dose let it fall once.

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "cases/settle.hpp"
#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::cases {

/// XXH64 of all that a settled bed depends on: places, radii and masses of the carriers, gravity, whether they spin,
/// restitution, friction and rolling friction of both contacts, and the triangles. Adhesion and stiffness are none of
/// it (settle.hpp).
std::uint64_t bed_key(const dem::Models& models, const lbm::geometry::TriangleMesh& mesh,
                      const std::vector<dem::Carrier>& carriers);

/// The bed of that key in the folder `store`; where there is none, or what is there is damaged, `settle` makes it and
/// it is kept: written to a temporary name and renamed. Who comes while another process settles the same bed waits for
/// it. Positions are kept as they are, bit for bit. Throws std::system_error if the folder cannot be written. in:
/// carriers, their number; kept: set to whether the bed was there
SettledBed stored_bed(const std::filesystem::path& store, std::uint64_t key, std::size_t carriers,
                      const std::function<SettledBed()>& settle, bool& kept);

}  // namespace puffin::cases
