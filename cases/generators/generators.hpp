#pragma once
// Parametric devices and test shapes: a kind and a few lengths in, a closed triangle surface with named solids out.
//
// Frames (x is the direction in which the flow enters, z is up):
//   l-bend, omega-bend   x = 0 the face of the backward-facing step, y = 0 the middle of the main duct, z = 0 its floor
//   duct, step, box, obstacle   one corner in the origin, the shape in x, y, z >= 0
//   pipe, bend           the inlet's centre in the origin; the bend turns in the x-y plane, towards +y
// Solids, in this order where they exist: inlet, outlet, wall, pocket, obstacle. A box, and a duct or an obstacle with
// `periodic = true`, name their six outer faces x-min, x-max, y-min, y-max, z-min, z-max instead; a pipe with
// `periodic = true` has x-min, x-max and wall; a step with `periodic = true` has y-min and y-max for its sides.

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::cases {

using ParameterValue = std::variant<double, std::vector<double>, std::string, bool>;
using Parameters = std::map<std::string, ParameterValue>;  // lengths [m], angles [rad], volumes [m^3]

enum class Provenance {
  given,    // the founding thesis states this value
  assumed,  // it does not: our choice
};
enum class Range { any, not_negative, positive };

struct ParameterInfo {
  std::string name;
  ParameterValue default_value;  // its type is the type of the parameter
  std::string unit;              // "m", "rad", "m^3" or ""
  std::string meaning;
  Provenance provenance = Provenance::assumed;
  Range range = Range::not_negative;      // of a number, or of each number of a list
  std::vector<std::string> choices = {};  // of a word
};

/// One thing wrong with one parameter. The message names the value and the remedy, not the parameter.
struct ParameterProblem {
  std::string parameter;
  std::string message;
};

/// Everything wrong with the parameters of a generator, at once.
class GeneratorError : public std::invalid_argument {
 public:
  GeneratorError(const std::string& kind, std::vector<ParameterProblem> problems);
  const std::vector<ParameterProblem>& problems() const { return problems_; }

 private:
  std::vector<ParameterProblem> problems_;
};

/// The indentation for the dose: a truncated cone in the floor.
struct Pocket {
  lbm::geometry::Vec3 floor = lbm::geometry::Vec3::Zero();  // [m] centre of its floor
  double bottom_diameter = 0.0;                             // [m]
  double top_diameter = 0.0;                                // [m]
  double depth = 0.0;                                       // [m]
};

/// Where things are in the frame of a shape.
struct KeyPoints {
  std::optional<lbm::geometry::Vec3> inlet, outlet;  // [m] centres of the openings
  std::optional<Pocket> pocket;
  double path_length = 0.0;  // [m] along the centre line from inlet to outlet, corners taken sharp; 0 without openings
};

/// "l-bend", "omega-bend", "duct", "pipe", "bend", "step", "box", "obstacle".
const std::vector<std::string>& generator_kinds();

/// One sentence on what the kind is. Throws std::invalid_argument for an unknown kind, as all functions here.
const std::string& summary_of(const std::string& kind);

const std::vector<ParameterInfo>& parameters_of(const std::string& kind);

/// Every problem of these parameters: unknown names (with "did you mean"), wrong types, negative lengths, pieces that
/// do not fit together. Empty: generate() will succeed.
std::vector<ParameterProblem> check_parameters(const std::string& kind, const Parameters& parameters);

/// The parameters with every default filled in and every free length solved for (`leg_lengths` of the devices).
/// Throws GeneratorError.
Parameters resolve_parameters(const std::string& kind, const Parameters& parameters);

/// The closed surface of the fluid. Each edge is shared by exactly two triangles, in opposite directions; area vectors
/// point out of the fluid; no edge is longer than `facet_size` (0: chosen from the shape).
/// Throws GeneratorError.
lbm::geometry::TriangleMesh generate(const std::string& kind, const Parameters& parameters = {});

/// Names of the solids that generate() will give, in order, without building the surface.
/// Throws GeneratorError.
std::vector<std::string> solids_of(const std::string& kind, const Parameters& parameters = {});

/// Throws GeneratorError.
KeyPoints key_points(const std::string& kind, const Parameters& parameters = {});

}  // namespace puffin::cases
