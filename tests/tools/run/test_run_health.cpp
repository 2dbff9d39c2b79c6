// What goes wrong with a carrier ends a whole run: found within a hundred steps, named, three retreats, exit code 5.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/tools/run/small_dose.hpp"
#include "tests/tools/run/towards_the_floor.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/summary.hpp"

namespace {

using namespace puffin;

constexpr double dt = 5e-6, radius = 35e-6;  // [s], [m]
constexpr const char* elastic = "--no-report --set carriers.contact.restitution=1";

/// What a warning or the last message says.
struct Complaint {
  double time = 0.0;   // [s] when it was found
  bool names = false;  // carrier 0, its place under the middle of the duct, likely causes
};

class RunHealth : public SmallDose {
 protected:
  /// Ends with 5 after three retreats; the four complaints.
  std::vector<Complaint> complaints(double height, double speed, const std::string& youngs_modulus,
                                    const std::string& what, const std::string& more = "") const {
    std::ofstream(folder_ / "case.toml") << test::towards_the_floor
                                         << "[stop]\ntime = \"3 ms\"\n[output]\ncarriers = \"1 ms\"\n";
    char list[200];
    std::snprintf(list, sizeof list,
                  " --set 'carriers.list=[{position=[3e-3,1e-3,%g],velocity=[0,0,%g],spin=[0,0,0],diameter=7e-5,"
                  "density=1520}]'",
                  height, -speed);
    EXPECT_EQ(run("out", list + (" --set 'carriers.contact.youngs_modulus=\"" + youngs_modulus + "\"' ") + more), 5)
        << text("out.log");
    const output::Summary s = output::read_summary(folder_ / "out" / "summary.json");
    EXPECT_EQ(s.state, "diverged");
    EXPECT_EQ(s.warnings.size(), 3U);
    EXPECT_FALSE(output::list_checkpoints(folder_ / "out").empty()) << "the last good state is kept";
    std::vector<Complaint> found;
    for (std::size_t n = 0; n <= s.warnings.size(); ++n) {
      const std::string& said = n < s.warnings.size() ? s.warnings[n] : s.message;
      EXPECT_NE(said.find(what), std::string::npos) << said;
      const std::string retreat = "retreat " + std::to_string(n + 1) + " of 3 from t";
      EXPECT_EQ(said.find(retreat) != std::string::npos, n < s.warnings.size()) << said;
      Complaint c;
      const std::size_t at = said.rfind(" t = ");
      if (at != std::string::npos) c.time = std::stod(said.substr(at + 5));
      c.names = said.find("carrier 0 ") != std::string::npos && said.find("at [0.003, 0.001, ") != std::string::npos &&
                said.find(". Likely causes: ") != std::string::npos;
      EXPECT_TRUE(c.names) << said;
      found.push_back(c);
    }
    return found;
  }
  /// It happens between `earliest` and `latest` [s]. Attempt n steps by dt/2^n, or less to meet an output.
  static void expect_within_100_steps(const std::vector<Complaint>& found, double earliest, double latest) {
    for (std::size_t n = 0; n < found.size(); ++n) {
      EXPECT_GT(found[n].time, earliest) << n;
      EXPECT_LE(found[n].time, latest + 100.0 * std::ldexp(dt, -static_cast<int>(n))) << n;
    }
  }
};

// A carrier of 1 Pa goes through the wall with its whole speed, 80 m/s: in each attempt its steps are multiples of 50
// um, from 30 um over the floor to 20 um under it. Between, its overlap would be too large first.
TEST_F(RunHealth, ACarrierThatWentThroughAWallIsFoundWithin100Steps) {
  const double through = 1.03e-3 / 80.0;
  expect_within_100_steps(complaints(1.03e-3, 80.0, "1 Pa", "carrier 0 is outside the walls", "--no-report"), through,
                          1.01 * through);
}

// Hertz without a dashpot: the deepest overlap is (15 m v^2/(16 sqrt(R) E*))^(2/5) = 0.4 diameters for 47 Pa at 5 cm/s,
// E* = E/(2 - 2 nu^2), and the contact lasts 2.9 overlaps/v = 1.6 ms. The energy stored goes with overlap^(5/2): where
// 0.3 diameters are crossed the speed is still v sqrt(1 - 0.75^(5/2)) = 0.716 v, before it is more.
constexpr double gap = 5e-6, limit = 0.3 * 2.0 * radius, slowest = 0.716;

TEST_F(RunHealth, AnOverlapOverItsLimitIsFoundWithin100Steps) {
  expect_within_100_steps(complaints(radius + gap, 0.05, "47 Pa", "of its diameter", elastic), (gap + limit) / 0.05,
                          (gap + limit / slowest) / 0.05);
}

// The same 20 times faster is over within 0.1 ms, 20 steps: it may lie between two looks.
TEST_F(RunHealth, AnImpactTooDeepIsFoundThoughItWasOverBeforeTheNextLook) {
  expect_within_100_steps(complaints(radius + gap, 1.0, "18.8 kPa", "of its diameter", elastic), gap + limit,
                          gap + limit / slowest);
}

// Stiffer than any number can say: the first touch makes a force that is none. The report with it is written all the
// same, and the code is 5.
TEST_F(RunHealth, ACarrierThatIsNoNumberIsFoundWithin100Steps) {
  expect_within_100_steps(complaints(radius + gap, 1.0, "1e308 Pa", "has left the finite numbers"), gap, gap);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "report.html"));
}

// Gravity of 1e300 m/s^2: too fast from the first step on.
TEST_F(RunHealth, ACarrierFasterThanAnyAirIsFoundWithin100Steps) {
  expect_within_100_steps(
      complaints(1e-3, 1.0, "1 MPa", " moves at ", "--no-report --set 'carriers.gravity=[0,0,-1e300]'"), 0.0, 0.0);
}

// Its slip is endless: it has no place in the history of slips, and no law takes fines from it.
TEST_F(RunHealth, ACarrierWithFinesFasterThanAnyAirIsFoundWithin100Steps) {
  expect_within_100_steps(
      complaints(1e-3, 1.0, "1 MPa", " moves at ",
                 "--no-report --set 'carriers.gravity=[0,0,-1e300]' --set carriers.fines_each=2000 "
                 "--set carriers.fine_mass_ratio=2e-5 --set 'fines.micromodels=\"lactose-3.6e-3.toml\"' "
                 "--set 'fines.scalar=[{name=\"drug\",diffusion=\"1e-6 kg/(m s)\"}]'"),
      0.0, 0.0);
}

// A disk on which no file may be larger than 4 kB takes status.json and log.txt, but no checkpoint and no stats.h5.
TEST_F(RunHealth, ARunThatCanWriteNoMoreEndsWith7AndItsStatusSaysFailed) {
  const std::string command = std::string(PUFFIN_BINARY_DIR) + "/puffin run " + (folder_ / "case.toml").string() +
                              " --set stop.time=0.1ms --no-report --out " + (folder_ / "out").string() +
                              " >/dev/null 2>&1";
  EXPECT_EQ(WEXITSTATUS(std::system(("bash -c \"trap '' XFSZ; ulimit -f 4; " + command + "\"").c_str())), 7);
  EXPECT_EQ(output::read_status(folder_ / "out" / "status.json").state, "failed");
  EXPECT_NE(text("out/index.html").find("log.txt"), std::string::npos);
  EXPECT_EQ(text("out/index.html").find("http-equiv=\"refresh\""), std::string::npos) << "it does not wait for more";
  ASSERT_EQ(run("out", "--resume --set stop.time=0.1ms --no-report"), 0) << "with room again it is run";
  EXPECT_EQ(output::read_status(folder_ / "out" / "status.json").state, "finished");
}

}  // namespace
