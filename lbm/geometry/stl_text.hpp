#pragma once
// The ASCII dialect of STL. Used by read_stl and write_stl only.

#include <string>
#include <string_view>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// Appends the triangles of an ASCII STL to `mesh`, three new vertices each, coordinates times `unit`. Grammar: solid
/// [name] { facet [normal x y z] outer loop {vertex x y z}x3 endloop endfacet } [endsolid [name]], any case, any white
/// space, comment or colour lines between facets skipped. Solids of the same name become one; nameless ones are called
/// "solid". Throws StlError "path:line: ...".
void parse_stl_text(const std::string& path, std::string_view text, double unit, TriangleMesh& mesh);

/// The ASCII text of `mesh` divided by `unit`.
std::string format_stl_text(const TriangleMesh& mesh, double unit);

}  // namespace puffin::lbm::geometry
