// What has gone wrong is found, with the carrier, the place and the reason.

#include <gtest/gtest.h>

#include "coupling/health.hpp"
#include "tests/coupling/checkpoint/coupled_scene.hpp"

namespace puffin::coupling {
namespace {

std::string complaint_of(const auto& ask) {
  try {
    ask();
  } catch (const Diverged& e) {
    return e.what();
  }
  return {};
}

class HealthOf : public ::testing::Test {
 protected:
  HealthOf() : sim_(coupled_simulation()), health_(sim_->models, sim_->state) {
    while (sim_->state.time < 0.3e-3) advance(sim_->models, 0.3e-3, sim_->state);
  }
  std::string complaint() const {
    return complaint_of([&] { health_.check(sim_->models, sim_->state); });
  }
  void expect_complaint(const std::string& part) const {
    EXPECT_NE(complaint().find(part), std::string::npos) << complaint();
  }
  dem::Carriers& carriers() { return sim_->state.carriers.carriers; }

  std::unique_ptr<cases::Simulation> sim_;
  Health health_;
};

TEST_F(HealthOf, ASoundStateIsGood) { EXPECT_EQ(complaint(), ""); }

TEST_F(HealthOf, ACarrierThatIsNoNumberIsNamed) {
  carriers().velocity[2][1] = std::numeric_limits<double>::quiet_NaN();
  expect_complaint("carrier 2 left the finite numbers");
}

TEST_F(HealthOf, ACarrierFasterThanAnyAirIsNamed) {
  carriers().velocity[1] = {1e6, 0.0, 0.0};
  expect_complaint("carrier 1 at [");
  expect_complaint("limit");
}

TEST_F(HealthOf, ACarrierOutsideTheWallsIsNamedWithItsPlace) {
  carriers().position[3] = {2e-3, -1e-4, 1e-3};
  carriers().rest[3] = dem::Rest::awake;
  expect_complaint("carrier 3 is outside the walls, at [0.002, -0.0001, 0.001] m");
}

TEST_F(HealthOf, AnOverlapBeyondTheLimitIsNamed) {
  auto& contacts = sim_->state.carriers.contacts;
  dem::Contact deep;
  deep.phase = dem::ContactPhase::bonded;
  deep.a = 0;
  deep.triangle = 0;
  deep.max_overlap = 0.31 * 7e-5;
  contacts.push_back(deep);
  expect_complaint("by 0.31 of its diameter");
}

// The overlap that was there before the carriers closed in carries no force and is not counted, once.
TEST_F(HealthOf, AnOverlapThatWasThereFromTheStartIsNotTakenOffTwice) {
  auto& contacts = sim_->state.carriers.contacts;
  dem::Contact deep;
  deep.phase = dem::ContactPhase::bonded;
  deep.a = 0, deep.b = 1;
  deep.offset = 0.2 * 7e-5;
  deep.max_overlap = 0.31 * 7e-5;
  contacts.push_back(deep);
  expect_complaint("overlaps carrier 1 by 0.31 of its diameter");
}

// An impact of 10 us lies between two looks a hundred steps apart.
class HealthOfImpacts : public HealthOf {
 protected:
  HealthOfImpacts() {
    dem::ContactEnded deep;
    deep.a = 3, deep.triangle = 7;
    deep.time_end = 0.29e-3;
    deep.max_overlap = 0.31 * 7e-5;
    sim_->state.events.ended.push_back(deep);
    sim_->state.carriers.statistics.largest_overlap = 0.31;
  }
  std::string complaint() const {
    return complaint_of([&] { health_.check_impacts(sim_->models, sim_->state); });
  }
};

TEST_F(HealthOfImpacts, OneTooDeepIsNamedThoughItIsOver) {
  carriers().position[3] = {2e-3, 1e-3, 1.25e-3};
  EXPECT_NE(complaint().find("carrier 3 at [0.002, 0.001, 0.00125] m overlaps the wall's triangle 7 by 0.31 of its "
                             "diameter at t = 0.00029 s"),
            std::string::npos)
      << complaint();
}

TEST_F(HealthOfImpacts, OneOfACarrierThatHasLeftIsNamedByItsPartner) {
  sim_->state.events.ended.back().a = 99;
  sim_->state.events.ended.back().b = 3;
  EXPECT_NE(complaint().find("carrier 99, which has left, overlaps carrier 3 by 0.31"), std::string::npos)
      << complaint();
}

TEST_F(HealthOfImpacts, OneWithinTheLimitIsGood) {
  sim_->state.events.ended.back().max_overlap = 0.29 * 7e-5;
  EXPECT_EQ(complaint(), "");
}

TEST_F(HealthOf, FinesThatDoNotAddUpAreNamed) {
  sim_->state.fines.left[0] += 1e-8 * sim_->state.fines.loaded;
  expect_complaint("scalar set 0 do not add up");
}

// The air: one cell is spoilt; the next steps must say so and name a cell beside it.
class HealthOfAir : public HealthOf {
 protected:
  /// Adds `excess` to the population in direction i of the cell at `x`, and steps until somebody complains.
  std::string spoilt(const Vec3& x, int i, float excess) {
    lbm::Air& air = *sim_->state.air;
    auto& populations = std::get<lbm::Populations<float>>(air.populations);
    for (const lbm::Run& run : air.rows.runs())
      for (int n = 0; n < run.count; ++n)
        if ((air.rows.centre(run.first + n) - x).cwiseAbs().maxCoeff() <= 0.5 * sim_->dx)
          populations.arrived(run, run.first + n, i) += excess;
    const std::int64_t before = air.steps;
    try {
      while (air.steps < before + 100) advance(sim_->models, 1.0, sim_->state);
    } catch (const Diverged& e) {
      return e.what();
    }
    return "nothing was noticed within 100 steps";
  }
  /// The kernel looks in every step at the populations with which it begins, and so does the complaint: the cell is the
  /// one that was spoilt. Places are printed with 5 digits, a cell is 0.25 mm wide.
  void expect_place(const std::string& complaint, const Vec3& x) const {
    ASSERT_NE(complaint.find("the air diverged at step"), std::string::npos) << complaint;
    EXPECT_NE(complaint.find("Likely causes"), std::string::npos) << complaint;
    Vec3 named;
    ASSERT_EQ(std::sscanf(complaint.c_str() + complaint.find('['), "[%lf, %lf, %lf]", &named[0], &named[1], &named[2]),
              3);
    EXPECT_LE((named - x).cwiseAbs().maxCoeff(), 0.51 * sim_->dx) << complaint;
  }
  const Vec3 place_{3.1e-3, 1.1e-3, 1.1e-3};
};

TEST_F(HealthOfAir, AValueThatIsNoNumberIsFoundWithItsCell) {
  expect_place(spoilt(place_, 0, std::numeric_limits<float>::quiet_NaN()), place_);
}

TEST_F(HealthOfAir, ASpeedOverTheLimitIsFoundWithItsCell) { expect_place(spoilt(place_, 1, 0.8F), place_); }

// -0.8: still beyond -0.5 if the time step falls by a fifth in this very step and the excess by its square. One step
// fills a single empty cell from its neighbours again; it is named all the same.
TEST_F(HealthOfAir, ADensityOutOfRangeIsFoundWithItsCellThoughTheNextStepFillsIt) {
  expect_place(spoilt(place_, 0, -0.8F), place_);
}

TEST_F(HealthOf, CarriersThatBeganOutsideAreNotAskedToBeInside) {
  const auto other = coupled_simulation();
  other->state.carriers.carriers.position[0] = {-1e-3, 1e-3, 1e-3};
  const Health health(other->models, other->state);
  EXPECT_NO_THROW(health.check(other->models, other->state));
}

TEST_F(HealthOf, TheCarriersIntegratorThatGivesUpIsADivergenceWithAPlace) {
  carriers().velocity[0][0] = std::numeric_limits<double>::quiet_NaN();
  carriers().rest[0] = dem::Rest::awake;
  try {
    for (int n = 0; n < 3; ++n) advance(sim_->models, 1.0, sim_->state);
    FAIL() << "nothing was noticed";
  } catch (const Diverged& e) {
    EXPECT_NE(std::string(e.what()).find("it was last at ["), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace puffin::coupling
