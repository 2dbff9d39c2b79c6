#pragma once
// A velocity inlet with all its openings, and the area that makes a speed of its flow.

#include <memory>
#include <string>
#include <vector>

#include "cases/derived.hpp"
#include "cases/opening.hpp"
#include "lbm/links.hpp"

namespace puffin::cases {

/// The parts of an inlet's patch that do not touch are openings of their own: each brings air along its own inward
/// normal, or all along the velocity vector of the case, with one mean speed for all. A profile from a file is laid
/// onto the patch as a whole.
struct Inlet {
  std::vector<Opening> openings;
  double area = 0.0;    // [m^2] that air crosses: sum over the openings; flow_rate / area is the mean speed
  double across = 1.0;  // of the length of a velocity vector: its normal part, mean over the openings
  std::shared_ptr<const lbm::InletParts> parts;  // of several openings; null: of one
};

/// Throws GeometryError if a part has no area or no direction, or if a profile from a file meets parts that look
/// different ways.
Inlet inlet_of(const Case& c, const Surface& surface, const Boundary& b);

/// The parts of an inlet's patch that are openings of their own, without more.
std::vector<lbm::geometry::PatchPart> inlet_parts(const Surface& surface, const Boundary& b);
/// What messages call one of them.
std::string part_name(const Boundary& b, const std::vector<lbm::geometry::PatchPart>& parts, std::size_t part);

/// The area of inlets, found once, for what derives a speed from it: `check`, `estimate` and the run.
AreaOf inlet_areas(const Air& air, const Surface& surface);

}  // namespace puffin::cases
