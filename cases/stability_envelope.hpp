#pragma once
// Which settings of the air were seen to run: what `puffin bench stability` found, as `puffin check` uses it.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/case.hpp"

namespace puffin::cases {

/// What the map says of one collision, eddy viscosity and wall, at a relaxation time of 1/2 to within 1e-3.
struct EnvelopeRow {
  Collision collision = Collision::rr3;
  Les les = Les::smagorinsky;
  double smagorinsky_constant = 0.0;  // 0 with les = none
  WallScheme wall = WallScheme::bouzidi;
  double runs = 0.0;    // the largest lattice speed up to which every scene ran to its end; 0: none
  double heals = 0.0;   // ... ran, or ran on with smaller steps
  double tried = 0.0;   // the largest lattice speed of the map
  std::string failure;  // the first that diverged, else the first that needed smaller steps: "step-inlet at 0.15"

  bool operator==(const EnvelopeRow&) const = default;
};

/// Reads cases/stability/envelope.toml. Throws std::runtime_error with file and line if it is not one.
std::vector<EnvelopeRow> read_envelope(const std::filesystem::path& file);

/// The same as text; read_envelope returns equal rows.
std::string write_envelope(const std::vector<EnvelopeRow>& rows);

/// What to say of a case whose lattice has the relaxation time tau and the lattice speed given: its settings diverged
/// there in the map, went beyond it, or are not in it. "" if they ran, or if tau is above 0.505 (trt: 0.512): viscosity
/// then damps what the map is about. Of several constants of the eddy viscosity the largest not above the case's
/// counts.
std::string outside_envelope(const Case& c, double tau, double lattice_speed, const std::vector<EnvelopeRow>& rows);

}  // namespace puffin::cases
