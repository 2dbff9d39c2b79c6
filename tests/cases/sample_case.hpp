#pragma once
// A small complete case in memory, and what the reader says about a changed one.

#include <string>
#include <vector>

#include "cases/read_case.hpp"

namespace puffin::cases::test {

inline const std::string sample = R"(schema = 1
name = "sample"
[geometry]
generator = "l-bend"
[air]
density = "1.2 kg/m^3"
viscosity = "1.8e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = "36 L/min"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.4 mm"
[carriers]
count = 1000
parcel = 10
diameter = "70 um"
density = "1520 kg/m^3"
[carriers.fill]
shape = "cylinder"
at = "pocket"
[carriers.adhesion]
model = "hamaker"
surface_energy = "3.6e-3 J/m^2"
[stop]
time = "10 ms"
)";

inline Case parse(const std::string& text, const std::vector<Override>& overrides = {}, std::string_view preset = {}) {
  return parse_case(text, "folder/case.toml", overrides, preset);
}

/// The problems of a text, one line each; empty if it is right.
inline std::vector<std::string> problems_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  std::vector<std::string> lines;
  try {
    parse(text, overrides);
  } catch (const CaseError& e) {
    for (const Problem& p : e.problems) lines.push_back(p.to_string());
  }
  return lines;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace puffin::cases::test
