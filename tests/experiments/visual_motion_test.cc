// The experiment on motions that visual odometry measures: its sums against numbers worked out by
// hand, and its runs against the error model that they are made from.
#include "experiments/visual_motion/visual_motion.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <string>

#include "core/random.h"
#include "core/refusals.h"
#include "experiments/scenario_experiment.h"
#include "scenario/shipped.h"

namespace rockyard::experiments {
namespace {

using testing::HasSubstr;

scenario::Scenario Steps(const std::vector<std::string>& overrides) {
  return scenario::Shipped("visual_odometry/steps_hazcam", overrides);
}

// The columns of a run added up over runs 0 to count - 1.
std::map<std::string, double> SumsOf(const Experiment& experiment, std::uint64_t count) {
  std::map<std::string, double> sums;
  for (std::uint64_t run = 0; run < count; ++run) {
    const truth::Record record = Measure(experiment, 1, run);
    for (std::size_t i = 0; i < experiment.schema().size(); ++i) {
      sums[experiment.schema()[i].name] += record.values[i];
    }
  }
  return sums;
}

StudiedStep StepAhead(double way_m) {
  StudiedStep step;
  step.X_WF.translation().x() = 5.0;
  step.X_WF.linear() = Eigen::AngleAxisd(1.0, math::Vector3::UnitZ()).toRotationMatrix();
  step.X_WS = step.X_WF * math::MakePose({way_m, 0.0, 0.0}, 0.0, 0.0, 0.0);
  return step;
}

vision::MotionResult Measured(const math::Vector3& way_m, double heading_rad, double sd) {
  vision::MotionResult seen;
  vision::Motion motion;
  motion.X_FS = math::MakePose(way_m, heading_rad, 0.0, 0.0);
  motion.covariance = sd * sd * vision::MotionCovariance::Identity();
  seen.motion = motion;
  return seen;
}

TEST(VisualSumsTest, AddsErrorsInTheFirstFrame) {
  VisualSums sums;
  AddStep(StepAhead(0.5), Measured({0.52, -0.01, 0.03}, 0.02, 0.01), sums);
  EXPECT_EQ(sums.steps, 1.0);
  EXPECT_EQ(sums.found, 1.0);
  EXPECT_NEAR(sums.along_m.sum, 0.02, 1e-12);
  EXPECT_NEAR(sums.across_m.sum, -0.01, 1e-12);
  EXPECT_NEAR(sums.up_m.squares, 0.0009, 1e-12);
  EXPECT_NEAR(sums.heading_deg.sum, math::RadToDeg(0.02), 1e-9);
  EXPECT_NEAR(sums.position_m, std::sqrt(0.0004 + 0.0001 + 0.0009), 1e-12);
  EXPECT_NEAR(sums.nees, (0.0004 + 0.0001 + 0.0009 + 0.0004) / 1e-4, 1e-6);
  EXPECT_EQ(sums.wrong, 0.0);  // far beyond its statement, and less than 5 cm and 2 deg
}

TEST(VisualSumsTest, TellsWrongMotionsFromUnsureOnes) {
  VisualSums sums;
  AddStep(StepAhead(0.5), Measured({0.6, 0.0, 0.0}, 0.0, 0.001), sums);
  EXPECT_EQ(sums.wrong, 1.0);
  AddStep(StepAhead(0.5), Measured({0.6, 0.0, 0.0}, 0.0, 0.1), sums);
  EXPECT_EQ(sums.wrong, 1.0);
  AddStep(StepAhead(0.5), Measured({0.5, 0.0, 0.0}, 0.1, 0.001), sums);
  EXPECT_EQ(sums.wrong, 2.0);
  AddStep(StepAhead(0.5), {}, sums);
  EXPECT_EQ(sums.steps, 4.0);
  EXPECT_EQ(sums.found, 3.0);
}

// By the error model the covariance is right: over 2000 motions the sum of e' P^-1 e lies within
// the two-sided 99.98 % of chi-squared. Seed 1. Twice the errors do not.
TEST(VisualMotionExperimentTest, FindsTheErrorsOfTheModel) {
  const std::vector<std::string> model{
      "sensors.visual_odometry.fidelity=error_model", "visual_motion.steps_per_run=100",
      "sensors.visual_odometry.error_model.failure.intercept=-1000"};
  const auto sums = SumsOf(*MakeExperiment(Steps(model)), 20);
  EXPECT_EQ(sums.at("steps"), 2000.0);
  EXPECT_EQ(sums.at("found"), 2000.0);
  const double low = core::ChiSquaredQuantile(1e-4, 12000);
  const double high = core::ChiSquaredQuantile(1.0 - 1e-4, 12000);
  EXPECT_GT(sums.at("nees"), low);
  EXPECT_LT(sums.at("nees"), high);
  EXPECT_GT(4.0 * sums.at("nees"), high);
}

// Run i belongs to cell i modulo their number; the last factor changes fastest.
TEST(VisualMotionExperimentTest, CoversItsCells) {
  const auto experiment = MakeExperiment(
      Steps({"sensors.visual_odometry.fidelity=error_model", "visual_motion.steps_m=[0, 0.5]",
             "visual_motion.turns_deg=[0, 6, 12]", "visual_motion.soil_graininess=[0.5]"}));
  const auto& schema = experiment->schema();
  ASSERT_EQ(schema[1].name, "step_m");
  ASSERT_EQ(schema[2].name, "turn_deg");
  ASSERT_EQ(schema[3].name, "soil_graininess");
  const truth::Record record = experiment->Run(1, 11);
  EXPECT_EQ(record.values[0], 5.0);
  EXPECT_EQ(record.values[1], 0.5);
  EXPECT_EQ(record.values[2], 12.0);
  EXPECT_EQ(experiment->Run(1, 11).values, record.values);
  EXPECT_NE(experiment->Run(2, 11).values, record.values);
}

// Two rendered motions, by the whole pipeline.
TEST(VisualMotionExperimentTest, MeasuresRenderedMotions) {
  const auto sums =
      SumsOf(*MakeExperiment(Steps({"visual_motion.steps_per_run=2", "visual_motion.steps_m=[0.25]",
                                    "visual_motion.turns_deg=[6]"})),
             1);
  EXPECT_EQ(sums.at("found"), 2.0);
  EXPECT_EQ(sums.at("wrong"), 0.0);
  EXPECT_LT(sums.at("position_m"), 2.0 * 0.005);
  EXPECT_GT(sums.at("consistent"), 2.0 * 30.0);
}

TEST(VisualMotionParamsTest, BadScenariosSayWhatIsWrong) {
  const auto refused = [](const std::vector<std::string>& overrides, const std::string& path) {
    EXPECT_THAT(core::RefusalOf([&] { Steps(overrides); }), HasSubstr(path));
  };
  refused({"visual_motion.steps_m=[]"}, "visual_motion.steps_m");
  refused({"visual_motion.turns_deg=[]"}, "visual_motion.steps_m");
  refused({"terrain.ground.slope_deg=3", "terrain.rocks.pointedness=0"},
          "terrain.ground.slope_deg");
}

}  // namespace
}  // namespace rockyard::experiments
