#pragma once
// Reading and writing STL files: triangle soup on disk, a welded TriangleMesh in memory.

#include <stdexcept>
#include <string>
#include <string_view>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// A file that is not a usable STL. The message holds the file, the line (ASCII) or triangle (binary), and a remedy.
class StlError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that is not there, or cannot be read or written at all; nothing is said about what it holds.
class StlFileError : public StlError {
 public:
  using StlError::StlError;
};

/// Corners nearer than this fraction of the bounding box diagonal become one vertex: single precision (the precision of
/// binary STL and of most exporters) resolves 6e-8 of the largest coordinate.
inline constexpr double weld_fraction = 1e-7;

/// Reads a binary or ASCII STL; multiplies every coordinate by `unit` [m per unit of the file]; welds corners (see
/// weld.hpp). Recognises a binary file by its length, so one that begins with "solid" is read right; ASCII may have
/// CRLF, any case, several solids, and no last endsolid. Facet normals in the file are ignored: the order of the
/// corners decides. Facets that welding collapses are kept as degenerate facets (check_surface counts them). Throws
/// StlFileError: no such file, unreadable; StlError: empty, truncated, not STL, non-finite coordinate, unit <= 0.
/// Memory stays proportional to the file's length, whatever the file claims.
TriangleMesh read_stl(const std::string& path, double unit = 1.0);

/// The same from the bytes of a file; `name` begins every message.
TriangleMesh parse_stl(const std::string& name, std::string_view bytes, double unit = 1.0);

/// The distance [m] within which read_stl welds the corners of a surface with these corners.
double weld_tolerance(const TriangleMesh& mesh);

/// Writes `mesh` [m] divided by `unit` [m per unit of the file]. ASCII: one named solid per entry of mesh.solids, in
/// order, with 9 digits (exact for single precision); binary: single precision, the name of the solid in the header if
/// there is only one. The file appears under its name only when complete. Throws StlFileError if it cannot be written.
void write_stl(const std::string& path, const TriangleMesh& mesh, bool binary = false, double unit = 1.0);

}  // namespace puffin::lbm::geometry
