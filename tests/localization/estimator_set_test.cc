#include <gmock/gmock.h>

#include <string>

#include "core/archive.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "localization/dead_reckoning.h"
#include "localization/toy_estimator.h"

namespace rockyard::localization {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

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
  return core::RefusalOf([&] { group.set.Add(DescribeToy(name)); });
}

TEST(EstimatorSet, TheFirstIsChosen) {
  const Group group = WithToy();
  EXPECT_THAT(group.set.names(), ElementsAre("dead_reckoning", "toy"));
  EXPECT_EQ(group.set.chosen().name(), "dead_reckoning");
}

TEST(EstimatorSet, MakesWhatIsNamedWithItsParameters) {
  const Group group = Read(R"({"estimator": "toy", "toy": {"variance_m": 0.5}})");
  EstimatorSetup setup{.calibration = {.wheel_radius_m = 0.1}};
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
  EXPECT_THAT(core::RefusalOf([] { Read(R"({"estimator": "toi"})"); }), HasSubstr("toy"));
  EXPECT_THAT(ProblemOf("toy"), StartsWith("localization.toy: is taken"));
  EXPECT_THAT(ProblemOf("estimator"), StartsWith("localization.estimator: is taken"));
  EXPECT_THAT(ProblemOf("Toy"), StartsWith("localization.Toy: cannot be the name of an estimator"));
  EXPECT_EQ(ProblemOf("toy_2"), "");
}

}  // namespace
}  // namespace rockyard::localization
