#pragma once
// A small dose in the L-bend as a whole run of the program, in a folder of its own.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/sanitized.hpp"

namespace puffin {

/// A small dose in the L-bend, hit at once by air at 36 L/min: in 10 ms carriers leave the pocket and hit walls.
inline const std::string small_dose = R"toml(
schema = 1
name = "small-dose"
[geometry]
generator = "l-bend"
[geometry.l-bend]
facet_size = "2 mm"
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = [["0 s", "0 L/min"], ["4 ms", "40 L/min"]]
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
)toml" + std::string(sanitized ? "dx = \"1 mm\"" : "dx = \"0.5 mm\"") +
                                      R"toml(
[carriers]
count = 1000
parcel = 10
diameter = "70 um"
density = "1520 kg/m^3"
fines_each = 2000
fine_mass_ratio = 2e-5
gravity = [0.0, 0.0, -9.81]
rotation = false
[carriers.fill]
shape = "cylinder"
at = "pocket"
gap = 0.2
[carriers.contact]
model = "linear"
restitution = 0.6
friction = 0.3
[carriers.adhesion]
model = "hamaker"
surface_energy = "3.6e-3 J/m^2"
cutoff_gap = "0.4 nm"
[fines]
micromodels = "lactose-3.6e-3.toml"
[[fines.scalar]]
name = "fines"
diffusion = "1e-6 kg/(m s)"
[stop]
time = "10 ms"
[output]
statistics = "0.5 ms"
carriers = "2 ms"
fields = [{ what = ["velocity", "fines"], region = "slice:y=0", every = "5 ms" }]
)toml";

/// The same on coarser cells and to 8 ms: a third of the time, and as much in motion, for tests that run it often.
inline std::string coarse_dose() {
  std::string text = small_dose;
  const auto replace = [&](const std::string& what, const std::string& with) {
    text.replace(text.find(what), what.size(), with);
  };
  if (!sanitized) replace("dx = \"0.5 mm\"", "dx = \"0.6 mm\"");
  replace("[stop]\ntime = \"10 ms\"", "[stop]\ntime = \"8 ms\"");
  return text;
}

class SmallDose : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("puffin-run-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "case.toml") << small_dose;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Exit code of `puffin run case.toml --out NAME` with more arguments; what it says goes to NAME.log.
  int run(const std::string& name, const std::string& arguments) const {
    const std::string command = std::string(PUFFIN_BINARY_DIR) + "/puffin run " + (folder_ / "case.toml").string() +
                                " --out " + (folder_ / name).string() + " " + arguments + " >/dev/null 2>" +
                                (folder_ / (name + ".log")).string();
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::string text(const std::string& name) const {
    std::ifstream stream(folder_ / name);
    std::stringstream all;
    all << stream.rdbuf();
    return all.str();
  }
  std::filesystem::path folder_;
};

}  // namespace puffin
