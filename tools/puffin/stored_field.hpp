#pragma once
// The velocity that a finished run has stored, as a field for another: air.field = { run = "DIR", at = "100 ms" }.

#include "cases/build.hpp"

namespace puffin::tools {

/// Reads DIR/vtk/fields.pvd: of the moments with velocity the one nearest to `at`, and of its regions the largest.
/// Trilinear between the fluid cells around a point, as probes are; zero where none of them is fluid.
/// Throws std::invalid_argument if there is no such run, no velocity in it, or no moment within half an output interval
/// of `at` (the times there are, are named); output::OutputError if a file is damaged.
std::function<coupling::Vec3(const coupling::Vec3&)> read_stored_field(const cases::RunField& wanted);

}  // namespace puffin::tools
