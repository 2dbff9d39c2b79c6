#pragma once
// A duct with vents in its sides, as a file beside a case: an inlet of faces that do not touch.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cases/read_case.hpp"

namespace puffin::cases::test {

/// 40 mm x 4 mm x 4 mm along x. The solid "inlet" is the vents 4 mm long, 2 mm from the closed end, in y-min and y-max,
/// and with `end` that end too; faces of 16 mm^2 all of them.
class VentedDuct {
 public:
  explicit VentedDuct(bool end) : file_(std::filesystem::temp_directory_path() / own_name()) {
    facet_of(end ? "inlet" : "wall", {0, 0, 0}, {0, 0, 4}, {0, 4, 4}, {0, 4, 0});
    facet_of("outlet", {40, 0, 0}, {40, 4, 0}, {40, 4, 4}, {40, 0, 4});
    const std::array<double, 4> x{0, 2, 6, 40};
    for (int k = 0; k < 3; ++k) {
      const double a = x[k], b = x[k + 1];
      const char* side = k == 1 ? "inlet" : "wall";
      facet_of(side, {a, 0, 0}, {b, 0, 0}, {b, 0, 4}, {a, 0, 4});
      facet_of(side, {a, 4, 0}, {a, 4, 4}, {b, 4, 4}, {b, 4, 0});
      facet_of("wall", {a, 0, 0}, {a, 4, 0}, {b, 4, 0}, {b, 0, 0});
      facet_of("wall", {a, 0, 4}, {b, 0, 4}, {b, 4, 4}, {a, 4, 4});
    }
    std::ofstream out(file_);
    for (const char* solid : {"inlet", "outlet", "wall"}) {
      out << "solid " << solid << '\n';
      for (const auto& [name, text] : facets_)
        if (name == solid) out << text;
      out << "endsolid " << solid << '\n';
    }
  }
  VentedDuct(const VentedDuct&) = delete;
  VentedDuct& operator=(const VentedDuct&) = delete;
  ~VentedDuct() { std::filesystem::remove(file_); }

  /// The case, with keys of the inlet's boundary.
  Case with(const std::string& inlet) const {
    return parse_case("schema = 1\nname = \"vents\"\n[geometry]\nstl = \"" + file_.filename().string() +
                          "\"\nunit = \"mm\"\n[air]\ndensity = 1.2\nviscosity = 1.8e-5\n[[air.boundary]]\n"
                          "patch = \"inlet\"\ntype = \"velocity-inlet\"\n" +
                          inlet +
                          "\n[[air.boundary]]\npatch = \"outlet\"\ntype = \"pressure-outlet\"\n[numerics]\n"
                          "dx = \"0.5 mm\"\n[stop]\ntime = \"20 ms\"\n",
                      (file_.parent_path() / "vents.toml").string());
  }

 private:
  /// Tests may run side by side.
  static std::string own_name() {
    return std::string("puffin-vented-duct-") + ::testing::UnitTest::GetInstance()->current_test_info()->name() +
           ".stl";
  }
  using Corner = std::array<double, 3>;
  void facet_of(const std::string& solid, Corner a, Corner b, Corner c, Corner d) {
    for (const auto& t : {std::array{a, b, c}, std::array{a, c, d}}) {
      std::string text = "facet normal 0 0 0\nouter loop\n";
      for (const Corner& v : t) {
        char line[80];
        std::snprintf(line, sizeof line, "vertex %g %g %g\n", v[0], v[1], v[2]);
        text += line;
      }
      facets_.emplace_back(solid, text + "endloop\nendfacet\n");
    }
  }

  std::filesystem::path file_;
  std::vector<std::pair<std::string, std::string>> facets_;
};

}  // namespace puffin::cases::test
