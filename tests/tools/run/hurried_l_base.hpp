#pragma once
// All 25000 carriers of L-Base in its device, coarse, and hit within milliseconds instead of a quarter of a second: so
// the run is short and yet carriers fly, collide and shed fines.

#include <string>

namespace puffin {

/// The case file; `end` like "10 ms". Needs PUFFIN_SOURCE_DIR.
inline std::string hurried_l_base(const std::string& end) {
  return "base = \"" PUFFIN_SOURCE_DIR
         "/cases/l-base/case.toml\"\n"
         R"toml(name = "L-Base, hurried"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = [["0 s", "0 L/min"], ["4 ms", "40 L/min"]]
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.5 mm"
[output]
statistics = "0.1 ms"
carriers = "2 ms"
fields = [{ what = ["velocity", "fines"], region = "slice:y=0", every = "5 ms" }]
[stop]
time = ")toml" +
         end + "\"\n";
}

}  // namespace puffin
