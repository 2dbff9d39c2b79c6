// One hash over every output of a coupled run, for 1, 2, 5 and 8 threads, on each instruction set of this processor.

#include <algorithm>
#include <cstdlib>
#include <span>

#include "coupling/checkpoint/hash.hpp"
#include "lbm/isa.hpp"
#include "tests/tools/run/hurried_l_base.hpp"
#include "tests/tools/run/restart.hpp"
#include "tests/tools/run/small_dose.hpp"

namespace {

using namespace puffin;
namespace fs = std::filesystem;

/// Every table, HDF5 and VTK file of a run, names and bytes. (summary.csv belongs to the report, and says how long the
/// run took.)
std::uint64_t hash_of_outputs(const fs::path& run) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    const std::string kind = entry.path().extension();
    if (kind == ".csv" || kind == ".h5" || kind == ".pvd" || kind == ".vti" || kind == ".vtp")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::string all;
  for (const fs::path& file : files) all += file.lexically_relative(run).string() + '\n' + file_text(file);
  return coupling::xxh64(std::as_bytes(std::span(all)));
}

class Determinism : public SmallDose {
 protected:
  void SetUp() override {
    SmallDose::SetUp();
    std::ofstream(folder_ / "case.toml") << coarse_dose();
  }
  void TearDown() override {
    unsetenv("PUFFIN_ISA");
    SmallDose::TearDown();
  }
  /// The hash of a finished run, whose folder goes away. It must have had as many threads, also where there are fewer
  /// processors.
  std::uint64_t hash_with(int threads, int seed = 1) const {
    Child child({"run", folder_ / "case.toml", "--out", folder_ / "out", "--quiet", "--no-report", "--threads",
                 std::to_string(threads), "--set", "numerics.seed=" + std::to_string(seed)},
                folder_ / "out.log");
    int most = 1;
    while (!child.ends_within(std::chrono::milliseconds(20))) most = std::max(most, child.threads());
    EXPECT_EQ(child.wait(), 0) << text("out.log");
    EXPECT_GE(most, threads);
    const std::uint64_t hash = hash_of_outputs(folder_ / "out");
    fs::remove_all(folder_ / "out");
    return hash;
  }
  void expect_one_hash() const {
    for (const lbm::Isa isa : {lbm::Isa::baseline, lbm::Isa::avx2, lbm::Isa::avx512}) {
      if (isa > lbm::hardware_isa()) continue;
      setenv("PUFFIN_ISA", lbm::name(isa), 1);
      const std::uint64_t hash = hash_with(1);
      std::printf("%-8s  %016llx\n", lbm::name(isa), static_cast<unsigned long long>(hash));
      for (const int threads : {2, 5, 8})
        EXPECT_EQ(hash_with(threads), hash) << lbm::name(isa) << ", " << threads << " threads";
    }
  }
};

TEST_F(Determinism, OneHashForAnyNumberOfThreadsOnEachInstructionSet) { expect_one_hash(); }

// Clusters of more than 256 bodies and 512 touches are shared among the threads: the bed of L-Base, settled, lifts off.
TEST_F(Determinism, OneHashForABedThatThreadsShare) {
  std::ofstream(folder_ / "case.toml") << hurried_l_base("4.5 ms");
  expect_one_hash();
}

TEST_F(Determinism, ASeedMakesAReplicateThatCanBeRepeated) {
  const std::uint64_t first = hash_with(2, 1);
  EXPECT_NE(hash_with(2, 2), first);
  EXPECT_EQ(hash_with(2, 1), first);
}

}  // namespace
