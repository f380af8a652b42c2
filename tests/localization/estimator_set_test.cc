#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "localization/dead_reckoning_estimator.h"
#include "localization/toy_estimator.h"

namespace rockyard::localization {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Group {
  EstimatorSet set;

  void Visit(core::FieldVisitor& v) { set.Visit(v); }
};

Group WithToy() {
  Group group;
  group.set.Add(DescribeDeadReckoning());
  group.set.Add(DescribeToy());
  return group;
}

Group Read(const std::string& json) {
  Group group = WithToy();
  core::ReadParams(core::ParseJson(json, "test"), group);
  return group;
}

std::string ProblemOf(std::string_view name) {
  Group group = WithToy();
  try {
    group.set.Add(DescribeToy(name));
  } catch (const core::UserError& error) {
    return error.problems()[0].path + " " + error.problems()[0].reason;
  }
  return "";
}

TEST(EstimatorSet, TheFirstIsChosen) {
  const Group group = WithToy();
  EXPECT_THAT(group.set.names(), ElementsAre("dead_reckoning", "toy"));
  EXPECT_EQ(group.set.chosen().name(), "dead_reckoning");
}

TEST(EstimatorSet, MakesWhatIsNamedWithItsParameters) {
  const Group group = Read(R"({"estimator": "toy", "toy": {"variance_m": 0.5}})");
  EstimatorSetup setup;
  setup.calibration.wheel_radius_m = 0.1;
  const auto estimator = group.set.chosen().Make(setup);
  messages::MotionMeasurement motion;
  motion.wheel_turn_rad.fill(4.0);
  estimator->Propagate(motion);
  EXPECT_NEAR(estimator->estimate().pose.x_m, 0.4, 1e-12);
  EXPECT_NEAR(estimator->estimate().covariance->coeff(0, 0), 0.2, 1e-12);
}

// What has no parameters has no group.
TEST(EstimatorSet, WritesWhatItReads) {
  const std::string text = core::DumpJson(
      core::WriteParams(Read(R"({"estimator": "toy", "toy": {"variance_m": 0.5}})")));
  EXPECT_EQ(core::DumpJson(core::WriteParams(Read(text))), text);
  EXPECT_THAT(text, HasSubstr("\"variance_m\": 0.5"));
  EXPECT_THAT(text, Not(HasSubstr("\"dead_reckoning\"")));
}

TEST(EstimatorSet, RefusesWhatItDoesNotKnow) {
  try {
    Read(R"({"estimator": "toi"})");
    FAIL() << "was read";
  } catch (const core::UserError& error) {
    EXPECT_THAT(error.problems()[0].suggestion, HasSubstr("toy"));
  }
  EXPECT_EQ(ProblemOf("toy"), "localization.toy is taken");
  EXPECT_EQ(ProblemOf("estimator"), "localization.estimator is taken");
  EXPECT_EQ(ProblemOf("Toy"), "localization.Toy cannot be the name of an estimator");
  EXPECT_EQ(ProblemOf("toy_2"), "");
}

}  // namespace
}  // namespace rockyard::localization
