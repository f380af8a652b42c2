// An estimator that no file of rockyard knows localizes the rover of a trial.
#include <gmock/gmock.h>

#include "core/refusals.h"
#include "localization/toy_estimator.h"
#include "scenario/shipped.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using testing::HasSubstr;

DriveParams WithToy(const Overrides& overrides) {
  scenario::Scenario defaults;
  defaults.drive.localization.estimators.Add(localization::DescribeToy());
  const Overrides gestalt = {"rover.fidelity=quasi_static", "navigation.navigator=gestalt"};
  const Overrides all = kShortAndEmpty + gestalt + kTrueEncoders + overrides;
  return scenario::Shipped("gestalt/abundance", all, defaults).drive;
}

// It counts what one wheel rolls, without dead reckoning's distance scale.
TEST(AddedEstimator, TellsTheRoverWhereItIs) {
  const auto toy = RunTrial(WithToy({"localization.estimator=toy"}), {1, 0});
  const auto flown = RunTrial(WithToy({"perception.dead_reckoning.distance_scale=1.0"}), {1, 0});
  EXPECT_EQ(toy.outcome, flown.outcome);
  EXPECT_GT(toy.record.dead_reckoned_distance_m, 2.0);
  EXPECT_NEAR(toy.record.dead_reckoned_distance_m, flown.record.dead_reckoned_distance_m, 0.02);
  // The control: one that believes its wheels to roll less far drives on.
  const auto scaled = RunTrial(WithToy({"perception.dead_reckoning.distance_scale=0.8"}), {1, 0});
  EXPECT_GT(scaled.record.true_distance_m, toy.record.true_distance_m + 0.3);
}

TEST(AddedEstimator, HasItsGroupInAScenario) {
  const DriveParams drive = WithToy({"localization.toy.variance_m=0.25"});
  EXPECT_EQ(drive.localization.estimators.params<localization::ToyParams>().variance_m, 0.25);
  EXPECT_EQ(drive.localization.estimators.chosen().name(), "dead_reckoning");
  EXPECT_THAT(core::RefusalOf([] { WithToy({"localization.toy.variance_m=2"}); }),
              HasSubstr("localization.toy.variance_m"));
}

}  // namespace
}  // namespace rockyard::trial
