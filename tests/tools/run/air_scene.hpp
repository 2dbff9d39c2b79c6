#pragma once
// Small scenes of air alone, run by the program, and their tables.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tools/output/csv_file.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::test {

inline const std::string air = R"toml(
[air]
density = "1.204 kg/m^3"
viscosity = "1.806e-5 Pa s"
)toml";
inline const std::string numerics = R"toml(
[numerics]
dx = "0.0625 mm"
lattice_speed = 0.025
time_step = "fixed"
les = "none"
precision = "double"
)toml";

/// Plane channel 1 mm high, 3 mm long, one cell wide: parabolic inlet of mean 0.5 m/s, Re 33.
inline const std::string channel = R"toml(
schema = 1
name = "channel"
[geometry]
generator = "duct"
[geometry.duct]
length = "3 mm"
width = "0.0625 mm"
height = "1 mm"
)toml" + air + R"toml(
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
profile = "parabolic"
velocity = "0.5 m/s"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[[air.boundary]]
patch = "y-max"
type = "periodic"
with = "y-min"
)toml" + numerics + R"toml(
[stop]
time = "40 ms"
[output]
statistics = "4 ms"
force = ["wall"]
line = [{ name = "across", from = [0.0015, 3e-5, 0.0], to = [0.0015, 3e-5, 0.001], points = 41 }]
plane = [
  { name = "first", normal = "x", at = "1 mm" },
  { name = "second", normal = "x", at = "2.02 mm" },
  { name = "end", normal = "x", at = "3 mm" },
]
probe = [{ name = "wall", at = [0.0015, 3e-5, 1e-5] }]
fields = [{ what = ["velocity"], region = "all", every = "20 ms" }]
)toml";

class AirScene : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("puffin-air-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  int run(const std::string& name, const std::string& text, const std::string& more = "") const {
    std::ofstream(folder_ / (name + ".toml")) << text;
    const std::string command = std::string(PUFFIN_BINARY_DIR) + "/puffin run " +
                                (folder_ / (name + ".toml")).string() + " --out " + (folder_ / name).string() +
                                " --quiet " + more + " >/dev/null 2>" + (folder_ / (name + ".log")).string();
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::string text(const std::string& name) const {
    std::ifstream stream(folder_ / name);
    std::stringstream all;
    all << stream.rdbuf();
    return all.str();
  }
  output::CsvTable table(const std::string& name) const { return output::read_csv(folder_ / name); }
  std::filesystem::path folder_;
};

/// Last value of a column among the rows whose `key` column is `name`.
inline double last(const output::CsvTable& t, const std::string& key, const std::string& name,
                   const std::string& column) {
  double value = std::nan("");
  const auto numbers = t.numbers(column);
  for (std::size_t n = 0; n < t.rows.size(); ++n)
    if (t.rows[n][t.find(key)] == name) value = numbers[n];
  return value;
}

}  // namespace puffin::test
