#pragma once
// Inputs of the stability scenes that no generator makes.

#include <filesystem>

namespace puffin::tools {

/// Writes into `folder`: shear-layer-3d.csv, rotated-duct.stl, slivers.stl, duplicate-facets.stl. Throws what the
/// writers throw.
void write_stability_shapes(const std::filesystem::path& folder);

}  // namespace puffin::tools
