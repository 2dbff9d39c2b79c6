// Openings by name, and cases that forget them.

#include "cases/untagged_openings.hpp"

#include <gtest/gtest.h>

#include "lbm/geometry/surface_check.hpp"

namespace puffin::cases {
namespace {

TEST(UntaggedOpenings, AreKnownByAWordOfTheirName) {
  for (const char* name : {"inlet", "Outlet-2", "air_inlet", "INFLOW", "mouthpiece", "side vent", "port3"})
    EXPECT_TRUE(is_called_opening(name)) << name;
  for (const char* name : {"wall", "support", "prevention", "pocket", "", "x-min", "inletwall"})
    EXPECT_FALSE(is_called_opening(name)) << name;
}

// Without a lattice: by their usual names or tagged by hand, unless something says that they are closed.
TEST(UntaggedOpenings, AreOpenUnsaidWhereNoLatticeIs) {
  Case c;
  c.air.model = AirModel::frozen;
  c.carriers.emplace();
  c.carriers->fill.emplace();
  c.carriers->fill->at = "tray";
  for (const char* name : {"lid", "tray", "wall", "shut", "left"}) {
    Patch patch;
    patch.name = name;
    c.geometry.patches.push_back(patch);
  }
  Boundary shut, pair;
  shut.patch = "shut", shut.type = BoundaryType::wall;
  pair.patch = "left", pair.with = "right", pair.type = BoundaryType::periodic;
  c.air.boundaries = {shut, pair};
  for (const char* name : {"inlet", "outlet", "lid"}) EXPECT_TRUE(is_open_unsaid(c, name)) << name;
  for (const char* name : {"tray", "wall", "pocket", "obstacle", "shut", "left", "right", "x-min"})
    EXPECT_FALSE(is_open_unsaid(c, name)) << name;
  c.air.model = AirModel::lbm;
  EXPECT_FALSE(is_open_unsaid(c, "outlet"));
}

TEST(UntaggedOpenings, AreRefusedAllAtOnceUnlessABoundarySaysWhatHappensThere) {
  Case c;
  c.air.model = AirModel::lbm;
  const lbm::geometry::Patches patches{{"inlet", "outlet", "wall", "vent"}, {}};
  Boundary inlet;
  inlet.patch = "inlet";
  c.air.boundaries = {inlet};
  try {
    refuse_untagged_openings(c, patches);
    FAIL();
  } catch (const lbm::geometry::GeometryError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("'outlet'"), std::string::npos);
    EXPECT_NE(text.find("'vent'"), std::string::npos);
    EXPECT_EQ(text.find("'inlet'"), std::string::npos);
  }
  Boundary pair;
  pair.patch = "vent";
  pair.with = "outlet";
  c.air.boundaries.push_back(pair);
  EXPECT_NO_THROW(refuse_untagged_openings(c, patches));
  c.air.boundaries.clear();
  c.air.model = AirModel::none;
  EXPECT_NO_THROW(refuse_untagged_openings(c, patches));
}

}  // namespace
}  // namespace puffin::cases
