// A settled bed is kept for the runs that come after, bit for bit, and for no other dose.

#include <gtest/gtest.h>

#include <fstream>

#include "cases/bed_store.hpp"

namespace puffin::cases {
namespace {

using Vec3 = Eigen::Vector3d;

class BedStore : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  /// The bed, and whether it had to settle.
  SettledBed take(std::uint64_t key, const SettledBed& bed) {
    settled_ = false;
    return stored_bed(
        folder_, key, bed.positions.size(),
        [&] {
          settled_ = true;
          return bed;
        },
        kept_);
  }
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("puffin-bed-store-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
  bool settled_ = false, kept_ = false;
};

TEST_F(BedStore, TheSecondRunFindsTheBedOfTheFirstBitForBit) {
  const SettledBed bed{{Vec3(0.1, -0.2, 1.0 / 3.0), Vec3(1e-9, 2e-9, 3e-9)}, 0.125, true};
  take(7, bed);
  EXPECT_TRUE(settled_ && !kept_);
  const SettledBed again = take(7, bed);
  EXPECT_TRUE(!settled_ && kept_);
  EXPECT_EQ(again.positions, bed.positions);
  EXPECT_EQ(again.time, bed.time);
  EXPECT_TRUE(again.at_rest);
  take(8, bed);
  EXPECT_TRUE(settled_) << "another dose";
}

TEST_F(BedStore, ADamagedBedIsSettledAnew) {
  const SettledBed bed{{Vec3(1.0, 2.0, 3.0)}, 0.5, false};
  take(7, bed);
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() != ".bed") continue;
    std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(45);  // within the first position
    file.put('x');
  }
  EXPECT_EQ(take(7, bed).positions, bed.positions);
  EXPECT_TRUE(settled_);
}

TEST_F(BedStore, ALinkInPlaceOfTheTemporaryFileIsNotFollowed) {
  const std::filesystem::path mine = folder_.string() + "-mine";
  std::ofstream(mine) << "mine";
  std::filesystem::create_directories(folder_);
  std::filesystem::create_symlink(mine, folder_ / "0000000000000007.bed.part");
  const SettledBed bed{{Vec3(1.0, 2.0, 3.0)}, 0.5, false};
  take(7, bed);
  EXPECT_EQ(std::filesystem::file_size(mine), 4U);
  take(7, bed);
  EXPECT_TRUE(kept_);
  std::filesystem::remove(mine);
}

TEST_F(BedStore, TheKeyGoesWithWhatTheBedDependsOn) {
  dem::Models models;
  lbm::geometry::TriangleMesh mesh{{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 2}}, {0}, {"wall"}};
  std::vector<dem::Carrier> carriers(2);
  for (auto& c : carriers) c.radius = 35e-6, c.mass = 3e-10;
  const std::uint64_t key = bed_key(models, mesh, carriers);
  models.wall.adhesion = dem::Jkr{};  // none of it
  EXPECT_EQ(bed_key(models, mesh, carriers), key);
  carriers[1].radius *= 1.0 + 1e-12;
  EXPECT_NE(bed_key(models, mesh, carriers), key);
  carriers[1].radius = carriers[0].radius;
  EXPECT_EQ(bed_key(models, mesh, carriers), key);
  mesh.vertices[2].z() = 1e-12;
  EXPECT_NE(bed_key(models, mesh, carriers), key);
  mesh.vertices[2].z() = 0.0;
  std::get<dem::LinearContact>(models.wall.contact).friction = dem::ConstantFriction{0.31};
  EXPECT_NE(bed_key(models, mesh, carriers), key);
}

}  // namespace
}  // namespace puffin::cases
