// A navigator that fails ends its drive, whatever drives: the record is whole, and what the machine
// may have done is tried once more. The navigators here stand for plugins and processes.
#include "navigation/navigator_fault.h"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/drive/drive_experiment.h"
#include "navigation/navigator.h"
#include "trial/shipped_trials.h"
#include "truth/end_cause.h"

namespace rockyard::trial {
namespace {

using navigation::FaultKind;
using navigation::NavigatorFault;
using testing::ElementsAre;
using testing::EndsWith;
using testing::IsEmpty;
using testing::StartsWith;
using truth::EndCause;
using truth::TrialOutcome;

enum class Where { kMaking, kDeciding, kCounting, kShowing };

// What happens to the drives of a test, in the order in which they begin.
struct Script {
  std::vector<std::optional<FaultKind>> faults;  // of each drive; those after them go well
  Where where = Where::kDeciding;
  int at_decision = 40;
  bool is_a_fault = true;  // false: it throws what is no NavigatorFault
  int drives = 0;
};

struct FailingParams {
  double goal_tolerance_m = 0.3;
  std::shared_ptr<Script> script = std::make_shared<Script>();

  void Visit(core::FieldVisitor& v) {
    v.Real("goal_tolerance_m", goal_tolerance_m, core::Setting("arrives within", {0.0, 1.0}));
  }
};

// Drives straight ahead up to its goal, unless it fails.
class Failing final : public navigation::Navigator {
 public:
  Failing(const FailingParams& params, const navigation::NavigatorSetup& setup)
      : params_(params), goal_(setup.goal) {
    Script& script = *params_.script;
    const auto drive = static_cast<std::size_t>(script.drives++);
    if (drive < script.faults.size()) fault_ = script.faults[drive];
    FailAt(Where::kMaking);
  }

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    own_[0] += 1.0;
    own_[1] = input.time_s;
    if (own_[0] == params_.script->at_decision) FailAt(Where::kDeciding);
    const double left_m =
        std::hypot(goal_.x_m - input.estimate.x_m, goal_.y_m - input.estimate.y_m);
    if (left_m < params_.goal_tolerance_m) {
      return navigation::Finish(navigation::NavigatorStatus::kArrived);
    }
    return navigation::Move({messages::MotionKind::kArc, 0.0, +1});
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal& goal, navigation::GoalChange) override { goal_ = goal; }
  std::span<const double> own_values() const override {
    FailAt(Where::kCounting);
    return own_;
  }

 private:
  void FailAt(Where where) const {
    if (!fault_ || params_.script->where != where) return;
    if (!params_.script->is_a_fault) throw std::runtime_error("a defect");
    throw NavigatorFault(*fault_, "the reason");
  }

  FailingParams params_;
  messages::Goal goal_;
  std::optional<FaultKind> fault_;
  std::vector<double> own_{0.0, 0.0};
};

navigation::NavigatorDescription<FailingParams> DescribeFailing() {
  return {.name = "failing",
          .doc = "drives straight ahead, or fails",
          .traits = [](const FailingParams& params) -> navigation::NavigatorTraits {
            return {navigation::LookReading::kNothing,
                    navigation::CostOfLook{},
                    {"goal_tolerance_m", params.goal_tolerance_m}};
          },
          .make = [](const FailingParams& params, const navigation::NavigatorSetup& setup)
              -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<Failing>(params, setup);
          },
          .own_values = {{"decisions", "1", "how often it was asked"},
                         {"last_time_s", "s", "when it was asked last"}}};
}

// 3 m of level sand, without errors.
DriveParams With(const FailingParams& params, const Overrides& overrides = {}) {
  scenario::Scenario defaults;
  defaults.drive.navigation.navigators.Add(DescribeFailing(), params);
  const Overrides failing = {"navigation.navigator=failing", "rover.fidelity=quasi_static"};
  const Overrides all = kShortAndEmpty + kTrueEncoders + failing + overrides;
  return scenario::Shipped("pathfinder/level_sand", all, defaults).drive;
}

DriveResult Driven(const FailingParams& params) { return RunTrial(With(params), {1, 0}); }

std::optional<EndCause> CauseOf(const DriveResult& result) {
  return truth::CauseOf(result.outcome, result.detail);
}

// As experiments ask of a record.
void ExpectWhole(const truth::DriveRecord& record) {
  for (const truth::DriveColumn& column : truth::kDriveColumns) {
    const double value = record.*column.member;
    EXPECT_TRUE(std::isfinite(value) || (column.may_lack && std::isnan(value))) << column.name;
  }
}

struct Fault {
  FaultKind kind;
  EndCause cause;
  bool twice;  // whether it is driven once more
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << truth::Info(fault.cause).name; }

class NavigatorFaults : public testing::TestWithParam<Fault> {};

INSTANTIATE_TEST_SUITE_P(
    Kinds, NavigatorFaults,
    testing::Values(Fault{FaultKind::kThrew, EndCause::kNavigatorThrew, false},
                    Fault{FaultKind::kNonsense, EndCause::kNavigatorNonsense, false},
                    Fault{FaultKind::kMessage, EndCause::kNavigatorMessage, false},
                    Fault{FaultKind::kEnded, EndCause::kNavigatorEnded, true},
                    Fault{FaultKind::kCpuTime, EndCause::kNavigatorCpuTime, true},
                    Fault{FaultKind::kMemory, EndCause::kNavigatorMemory, true},
                    Fault{FaultKind::kSilent, EndCause::kNavigatorSilent, true}),
    [](const auto& fault) { return std::string(truth::Info(fault.param.cause).name); });

TEST_P(NavigatorFaults, EndTheDriveWithCauseAndText) {
  FailingParams params;
  params.script->faults = {GetParam().kind, GetParam().kind};
  const DriveResult result = Driven(params);
  EXPECT_EQ(result.outcome, TrialOutcome::kNavigatorFault);
  EXPECT_EQ(CauseOf(result), GetParam().cause);
  EXPECT_THAT(result.detail, StartsWith(std::string(truth::Info(GetParam().cause).sentence)));
  EXPECT_THAT(result.detail, EndsWith(": the reason"));
  EXPECT_EQ(params.script->drives, GetParam().twice ? 2 : 1);
  EXPECT_THAT(result.own_values.navigator, IsEmpty());
  // What was driven up to there is told.
  ExpectWhole(result.record);
  EXPECT_GT(result.record.true_distance_m, 0.05);
  EXPECT_LT(result.record.true_distance_m, 1.0);
  EXPECT_GT(result.record.sim_time_s, 0.0);
}

// One that comes once is forgotten, where the machine may have been short; else it counts.
TEST_P(NavigatorFaults, ThatComeOnceCountWhereTheyAreTheNavigators) {
  FailingParams params;
  params.script->faults = {GetParam().kind};
  const DriveResult result = Driven(params);
  if (GetParam().twice) {
    const DriveResult well = Driven({});
    EXPECT_EQ(well.outcome, TrialOutcome::kGoalReached);
    EXPECT_THAT(Differences(result, well), IsEmpty());
    EXPECT_EQ(result.own_values.navigator, well.own_values.navigator);
    EXPECT_EQ(params.script->drives, 2);
  } else {
    EXPECT_EQ(CauseOf(result), GetParam().cause);
    EXPECT_EQ(params.script->drives, 1);
  }
}

TEST_P(NavigatorFaults, WhereItIsMadeEndTheDriveToo) {
  FailingParams params;
  params.script->where = Where::kMaking;
  params.script->faults = {GetParam().kind, GetParam().kind};
  const DriveResult result = Driven(params);
  EXPECT_EQ(CauseOf(result), GetParam().cause);
  EXPECT_THAT(result.detail, EndsWith(": the reason"));
  EXPECT_EQ(params.script->drives, GetParam().twice ? 2 : 1);
  ExpectWhole(result.record);
  EXPECT_EQ(result.record.true_distance_m, 0.0);
}

TEST_P(NavigatorFaults, WhereItsOwnValuesAreAskedForAreFaultsToo) {
  FailingParams params;
  params.script->where = Where::kCounting;
  params.script->faults = {GetParam().kind, GetParam().kind};
  const DriveResult result = Driven(params);
  EXPECT_EQ(CauseOf(result), GetParam().cause);
  EXPECT_GT(result.record.true_distance_m, 2.0) << "it had arrived";
  ExpectWhole(result.record);
}

// The second fault is that which counts.
TEST(NavigatorFaultTest, AfterAFaultOfTheMachineAnotherOneMayCome) {
  FailingParams params;
  params.script->faults = {FaultKind::kEnded, FaultKind::kNonsense};
  EXPECT_EQ(CauseOf(Driven(params)), EndCause::kNavigatorNonsense);
  EXPECT_EQ(params.script->drives, 2);
}

// The trace is that of the drive that counts.
TEST(NavigatorFaultTest, TheTraceOfADriveThatFailedOnceIsForgotten) {
  FailingParams params;
  params.script->faults = {FaultKind::kEnded};
  const TracedTrial traced = RunTraced(With(params), 0);
  const TracedTrial well = RunTraced(With({}), 0);
  EXPECT_EQ(params.script->drives, 2);
  EXPECT_THAT(Differences(traced.result, well.result), IsEmpty());
  EXPECT_EQ(traced.trace.samples.size(), well.trace.samples.size());
  EXPECT_EQ(traced.trace.events.size(), well.trace.events.size());
  EXPECT_EQ(traced.trace.samples.front().time_s, well.trace.samples.front().time_s);
}

TEST(NavigatorFaultTest, TheTraceTellsTheReason) {
  FailingParams params;
  params.script->faults = {FaultKind::kThrew};
  const TracedTrial traced = RunTraced(With(params), 0);
  const auto ends = EventsOf(traced.trace, "end");
  ASSERT_FALSE(ends.empty());
  EXPECT_EQ(ends.back().detail, "the reason");
}

// What is thrown otherwise is a defect of the simulator or of a navigator of its own.
TEST(NavigatorFaultTest, OtherExceptionsPass) {
  FailingParams params;
  params.script->faults = {FaultKind::kEnded};
  params.script->is_a_fault = false;
  EXPECT_THROW(Driven(params), std::runtime_error);
  EXPECT_EQ(params.script->drives, 1);
}

TEST(NavigatorFaultTest, ADriveThatGoesWellIsDrivenOnce) {
  const FailingParams params;
  const DriveResult result = Driven(params);
  EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached);
  EXPECT_EQ(params.script->drives, 1);
  ASSERT_EQ(result.own_values.navigator.size(), 2U);
  EXPECT_GT(result.own_values.navigator[0], 100.0);
  EXPECT_NEAR(result.own_values.navigator[1], result.record.sim_time_s, 1.0);
}

// Own values are columns of records, of every navigator that a scenario could choose.

constexpr const char* kDecisions = "failing.decisions";
constexpr const char* kLastTime = "failing.last_time_s";

std::size_t ColumnOf(const experiments::DriveExperiment& experiment, const std::string& name) {
  const truth::RecordSchema& schema = experiment.schema();
  for (std::size_t i = 0; i < schema.size(); ++i) {
    if (schema[i].name == name) return i;
  }
  ADD_FAILURE() << "no column " << name;
  return 0;
}

// Of rockyard's navigators ENav has some, before those of others.
constexpr std::size_t kOwnOfEnav = 4;

TEST(OwnValuesTest, AreTheLastColumnsOfARecord) {
  const experiments::DriveExperiment experiment(With({}));
  const truth::RecordSchema& schema = experiment.schema();
  ASSERT_EQ(schema.size(), truth::kDriveColumns.size() + kOwnOfEnav + 2);
  EXPECT_EQ(ColumnOf(experiment, kDecisions), truth::kDriveColumns.size() + kOwnOfEnav);
  EXPECT_EQ(ColumnOf(experiment, kLastTime), truth::kDriveColumns.size() + kOwnOfEnav + 1);
  EXPECT_EQ(schema.back().unit, "s");
  EXPECT_EQ(schema.back().meaning, "when it was asked last");
  const truth::Record record = experiment.Run(1, 0);
  const DriveResult result = RunTrial(With({}), {1, 0});
  ASSERT_EQ(record.values.size(), schema.size());
  EXPECT_EQ(record.values[ColumnOf(experiment, kDecisions)], result.own_values.navigator[0]);
  EXPECT_EQ(record.values[ColumnOf(experiment, kLastTime)], result.own_values.navigator[1]);
  EXPECT_EQ(record.values[0], result.record.*truth::kDriveColumns[0].member);
}

// Cells of a sweep over navigators have the same columns.
TEST(OwnValuesTest, OfANavigatorThatDoesNotDriveAreNone) {
  const experiments::DriveExperiment experiment(
      With({}, {"navigation.navigator=pathfinder", "navigation.pathfinder.time_out_s=5"}));
  const truth::Record record = experiment.Run(1, 0);
  ASSERT_EQ(record.values.size(), truth::kDriveColumns.size() + kOwnOfEnav + 2);
  EXPECT_TRUE(std::isnan(record.values[ColumnOf(experiment, kDecisions)]));
  EXPECT_TRUE(std::isnan(record.values[ColumnOf(experiment, kLastTime)]));
  EXPECT_EQ(record.outcome, TrialOutcome::kNoPath);
}

TEST(OwnValuesTest, OfADriveThatFailedAreNone) {
  FailingParams params;
  params.script->faults = {FaultKind::kThrew};
  const experiments::DriveExperiment experiment(With(params));
  const truth::Record record = experiment.Run(1, 0);
  EXPECT_EQ(record.outcome, TrialOutcome::kNavigatorFault);
  EXPECT_EQ(truth::CauseOf(record), EndCause::kNavigatorThrew);
  EXPECT_FALSE(truth::IsFault(record)) << "the simulator did not fail";
  ASSERT_EQ(record.values.size(), truth::kDriveColumns.size() + kOwnOfEnav + 2);
  EXPECT_TRUE(std::isnan(record.values[ColumnOf(experiment, kDecisions)]));
  EXPECT_TRUE(std::isfinite(record.values[0]));
}

// A scenario of rockyard's own navigators keeps its columns.
TEST(OwnValuesTest, OfOwnNavigatorsEnavAloneHasSome) {
  const experiments::DriveExperiment experiment(Pathfinder("level_sand"));
  EXPECT_EQ(experiment.schema().size(), truth::kDriveColumns.size() + kOwnOfEnav);
  EXPECT_TRUE(experiment.schema().back().name.starts_with("enav."));
}

}  // namespace
}  // namespace rockyard::trial
