// An estimator that fails ends its drive as a navigator does: the record is whole, and what the
// machine may have done is tried once more. The estimators here stand for those of plugins.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/drive/drive_experiment.h"
#include "localization/dead_reckoning.h"
#include "navigation/navigator_fault.h"
#include "trial/shipped_trials.h"
#include "truth/end_cause.h"

namespace rockyard::trial {
namespace {

using navigation::FaultKind;
using navigation::NavigatorFault;
using testing::EndsWith;
using testing::IsEmpty;
using truth::EndCause;
using truth::TrialOutcome;

enum class Where { kMaking, kPropagating, kFeeling, kCounting, kRemembering };

// What happens to the drives of a test, in the order in which they begin.
struct Script {
  std::vector<std::optional<FaultKind>> faults;  // of each drive; those after them go well
  Where where = Where::kPropagating;
  int drives = 0;
};

struct FailingParams {
  std::shared_ptr<Script> script = std::make_shared<Script>();

  void Visit(core::FieldVisitor&) {}
};

// Dead reckoning, unless it fails.
class Failing final : public localization::Estimator {
 public:
  Failing(const FailingParams& params, const localization::EstimatorSetup& setup)
      : script_(params.script), flown_(setup) {
    const auto drive = static_cast<std::size_t>(script_->drives++);
    if (drive < script_->faults.size()) fault_ = script_->faults[drive];
    FailAt(Where::kMaking);
  }

  void Propagate(const messages::MotionMeasurement& motion) override {
    flown_.Propagate(motion);
    own_[0] += 1.0;
    if (own_[0] == 60.0) FailAt(Where::kPropagating);
  }
  void Feel(const messages::VehicleState& felt, double duration_s) override {
    flown_.Feel(felt, duration_s);
    if (own_[0] == 60.0) FailAt(Where::kFeeling);
  }
  void Place(const messages::PoseUpdate& update) override { flown_.Place(update); }
  const messages::LocalizationEstimate& estimate() const override { return flown_.estimate(); }
  std::span<const double> own_values() const override {
    FailAt(Where::kCounting);
    return own_;
  }
  localization::EstimatorMemory Remember() const override {
    FailAt(Where::kRemembering);
    return flown_.Remember();
  }

 private:
  void FailAt(Where where) const {
    if (fault_ && script_->where == where) throw NavigatorFault(*fault_, "the reason");
  }

  std::shared_ptr<Script> script_;
  localization::DeadReckoningEstimator flown_;
  std::optional<FaultKind> fault_;
  std::vector<double> own_{0.0};
};

localization::EstimatorDescription<FailingParams> DescribeFailing() {
  return {.name = "failing",
          .doc = "dead reckoning, or fails",
          .make = [](const FailingParams& params, const localization::EstimatorSetup& setup)
              -> std::unique_ptr<localization::Estimator> {
            return std::make_unique<Failing>(params, setup);
          },
          .own_values = {{"ticks", "1", "how often it was carried on"}}};
}

// 3 m of level sand, without errors.
DriveParams With(const FailingParams& params, const Overrides& overrides = {}) {
  scenario::Scenario defaults;
  defaults.drive.localization.estimators.Add(DescribeFailing(), params);
  const Overrides failing = {"localization.estimator=failing", "rover.fidelity=quasi_static"};
  const Overrides all = kShortAndEmpty + kTrueEncoders + failing + overrides;
  return scenario::Shipped("pathfinder/level_sand", all, defaults).drive;
}

DriveResult Driven(const FailingParams& params) { return RunTrial(With(params), {1, 0}); }

FailingParams FailingAt(Where where, FaultKind kind) {
  FailingParams params;
  params.script->where = where;
  params.script->faults = {kind, kind};
  return params;
}

// As experiments ask of a record.
void ExpectWhole(const truth::DriveRecord& record) {
  for (const truth::DriveColumn& column : truth::kDriveColumns) {
    const double value = record.*column.member;
    EXPECT_TRUE(std::isfinite(value) || (column.may_lack && std::isnan(value))) << column.name;
  }
}

class EstimatorFaults : public testing::TestWithParam<Where> {};

INSTANTIATE_TEST_SUITE_P(Places, EstimatorFaults,
                         testing::Values(Where::kMaking, Where::kPropagating, Where::kFeeling,
                                         Where::kCounting, Where::kRemembering));

TEST_P(EstimatorFaults, EndTheDrive) {
  const FailingParams params = FailingAt(GetParam(), FaultKind::kThrew);
  const DriveResult result = Driven(params);
  EXPECT_EQ(result.outcome, TrialOutcome::kNavigatorFault);
  EXPECT_EQ(truth::CauseOf(result.outcome, result.detail), EndCause::kNavigatorThrew);
  EXPECT_THAT(result.detail, EndsWith(": the reason"));
  EXPECT_EQ(params.script->drives, 1);
  EXPECT_THAT(result.own_values.estimator, IsEmpty());
  ExpectWhole(result.record);
  const bool at_end = GetParam() == Where::kCounting || GetParam() == Where::kRemembering;
  EXPECT_EQ(result.record.true_distance_m > 2.0, at_end);
  EXPECT_EQ(result.record.true_distance_m == 0.0, GetParam() == Where::kMaking);
}

TEST_P(EstimatorFaults, ThatTheMachineMayHaveDoneAreTriedOnceMore) {
  FailingParams params = FailingAt(GetParam(), FaultKind::kCpuTime);
  const DriveResult result = Driven(params);
  EXPECT_EQ(truth::CauseOf(result.outcome, result.detail), EndCause::kNavigatorCpuTime);
  EXPECT_EQ(params.script->drives, 2);
  params.script->drives = 0;
  params.script->faults.pop_back();
  const DriveResult well = Driven(params);
  EXPECT_EQ(well.outcome, TrialOutcome::kGoalReached);
  EXPECT_EQ(params.script->drives, 2);
}

TEST(EstimatorFaultTest, OneThatDoesNotFailIsDeadReckoning) {
  const DriveResult result = Driven({});
  const DriveResult flown = RunTrial(With({}, {"localization.estimator=dead_reckoning"}), {1, 0});
  EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached);
  for (const truth::DriveColumn& column : truth::kDriveColumns) {
    const double value = result.record.*column.member;
    EXPECT_TRUE(value == flown.record.*column.member || std::isnan(value)) << column.name;
  }
  EXPECT_EQ(result.end.memory.pose.x_m, result.record.believed_x_m);
  ASSERT_EQ(result.own_values.estimator.size(), 1U);
  EXPECT_GT(result.own_values.estimator[0], 100.0);
}

// Own values are the last columns, of every estimator that a scenario could choose.
TEST(EstimatorFaultTest, OwnValuesAreColumns) {
  const experiments::DriveExperiment chosen(With({}));
  const experiments::DriveExperiment other(With({}, {"localization.estimator=oracle"}));
  for (const auto* experiment : {&chosen, &other}) {
    ASSERT_EQ(experiment->schema().size(), truth::kDriveColumns.size() + 4 + 1);  // 4 of ENav
    EXPECT_EQ(experiment->schema().back().name, "failing.ticks");
    EXPECT_EQ(experiment->schema().back().meaning, "how often it was carried on");
  }
  EXPECT_GT(chosen.Run(1, 0).values.back(), 100.0);
  EXPECT_TRUE(std::isnan(other.Run(1, 0).values.back()));
}

}  // namespace
}  // namespace rockyard::trial
