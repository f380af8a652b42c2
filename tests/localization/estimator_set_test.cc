// An estimator from outside of the module: chosen by its name, and corrected by aids that are late.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
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
  return core::RefusalOf([&] { WithToy().set.Add(DescribeToy(name)); });
}

TEST(EstimatorSet, TheFirstIsChosen) {
  const Group group = WithToy();
  EXPECT_THAT(group.set.names(), ElementsAre("dead_reckoning", "toy"));
  EXPECT_EQ(group.set.chosen().name(), "dead_reckoning");
}

TEST(EstimatorSet, MakesWhatIsNamedWithItsParameters) {
  const Group group = Read(R"({"estimator": "toy", "toy": {"variance_m": 0.5}})");
  const auto estimator = group.set.chosen().Make({.calibration = {.wheel_radius_m = 0.1}});
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

// Aids whose data arrive 2 s after they were taken, against closed forms.

constexpr double kSpeed_m_s = 0.1;
constexpr double kTick_s = 0.1;
constexpr double kQ = 0.01;         // m2/m
constexpr double kR = 0.02 * 0.02;  // of an aid, m2

EstimatorSetup StartSetup() {
  return EstimatorSetup{.calibration = {.wheel_radius_m = 0.1}, .start = {1.0, -2.0, 0.0}};
}

class LateAid : public testing::Test {
 protected:
  void DriveFor(double duration_s) {
    messages::MotionMeasurement motion{.duration_s = kTick_s};
    motion.wheel_turn_rad.fill(kSpeed_m_s * kTick_s / 0.1);
    for (int i = 0; i < std::lround(duration_s / kTick_s); ++i) {
      toy_.Propagate(motion);
      at_once_.Propagate(motion);
    }
  }

  static constexpr int kX = messages::Index(messages::PoseCoordinate::kX);

  static messages::PoseFix Fix(messages::CaptureNumber capture, double x_m) {
    messages::PoseFix fix{.capture = capture, .measured = {}};
    fix.measured.set(kX);
    fix.pose[kX] = x_m;
    fix.covariance *= kR;
    return fix;
  }
  static messages::RelativeMotion Motion(messages::CaptureNumber from, messages::CaptureNumber to,
                                         double x_m) {
    messages::RelativeMotion motion{.from = from, .to = to};
    motion.motion_F[kX] = x_m;
    motion.covariance *= kR;
    return motion;
  }
  static double Variance(const Estimator& estimator) {
    return estimator.estimate().covariance->coeff(kX, kX);
  }

  ToyEstimator toy_{{.variance_m = kQ}, StartSetup()};
  ToyEstimator at_once_{{.variance_m = kQ}, StartSetup()};  // whose aids are not late
};

TEST_F(LateAid, AFixCorrectsByWhatItWasWorthWhenItWasTaken) {
  DriveFor(5.0);
  toy_.Capture(1);
  at_once_.Capture(1);
  EXPECT_EQ(at_once_.Update(Fix(1, 1.53)), AidUse::kUsed);
  DriveFor(2.0);
  EXPECT_NEAR(toy_.estimate().pose.x_m, 1.7, 1e-12);
  EXPECT_EQ(toy_.Update(Fix(1, 1.53)), AidUse::kUsed);

  const double P1 = kQ * 0.5;
  const double gain = P1 / (P1 + kR);
  EXPECT_NEAR(toy_.estimate().pose.x_m, 1.7 + gain * 0.03, 1e-12);
  EXPECT_NEAR(Variance(toy_), kQ * 0.7 - gain * P1, 1e-12);
  EXPECT_NEAR(toy_.estimate().pose.x_m, at_once_.estimate().pose.x_m, 1e-12);
  EXPECT_NEAR(Variance(toy_), Variance(at_once_), 1e-12);
  // The control: taken as a place of now it would throw the rover back.
  const double P2 = kQ * 0.7;
  EXPECT_LT(1.7 + P2 / (P2 + kR) * (1.53 - 1.7), toy_.estimate().pose.x_m - 0.1);
}

TEST_F(LateAid, TheOdometryFrameAndTheOdometerStaySmooth) {
  DriveFor(5.0);
  toy_.Capture(1);
  DriveFor(2.0);
  toy_.Update(Fix(1, 1.53));
  EXPECT_NEAR(toy_.estimate().odometry.x_m, 1.7, 1e-12);
  EXPECT_NEAR(toy_.estimate().odometry.distance_m, 0.7, 1e-12);
  EXPECT_NEAR(toy_.estimate().pose.distance_m, 0.7, 1e-12);
  DriveFor(1.0);
  EXPECT_NEAR(toy_.estimate().odometry.x_m, 1.8, 1e-12);
}

// Motions in a row share their moments; each corrects its own stretch, because the errors of two
// stretches have nothing in common.
TEST_F(LateAid, MotionsInARowCorrectTheirOwnStretches) {
  DriveFor(5.0);
  toy_.Capture(1);
  DriveFor(2.0);
  toy_.Capture(2);
  DriveFor(2.0);
  EXPECT_EQ(toy_.Update(Motion(1, 2, 0.21)), AidUse::kUsed);
  toy_.Forget(1);
  const double d = kQ * 0.2;
  const double gain = d / (d + kR);
  EXPECT_NEAR(toy_.estimate().pose.x_m, 1.9 + gain * 0.01, 1e-12);
  EXPECT_NEAR(Variance(toy_), kQ * 0.9 - gain * d, 1e-12);
  toy_.Capture(3);
  DriveFor(2.0);
  EXPECT_EQ(toy_.Update(Motion(2, 3, 0.18)), AidUse::kUsed);
  EXPECT_NEAR(toy_.estimate().pose.x_m, 2.1 + gain * 0.01 - gain * 0.02, 1e-12);
  EXPECT_NEAR(Variance(toy_), kQ * 1.1 - 2.0 * gain * d, 1e-12);
}

TEST_F(LateAid, WhatIsFarOffOrOfNoKnownMomentIsNotUsed) {
  DriveFor(5.0);
  toy_.Capture(1);
  DriveFor(2.0);
  EXPECT_EQ(toy_.Update(Fix(1, 2.5)), AidUse::kGatedOut);
  EXPECT_EQ(toy_.Update(Fix(2, 1.5)), AidUse::kUnknown);
  messages::PoseFix of_heading = Fix(1, 1.53);
  of_heading.measured.reset(kX);
  EXPECT_EQ(toy_.Update(of_heading), AidUse::kNoInterest);
  EXPECT_EQ(toy_.Update(Motion(1, 2, 0.2)), AidUse::kUnknown);
  EXPECT_NEAR(toy_.estimate().pose.x_m, 1.7, 1e-12);
  toy_.Forget(1);
  EXPECT_EQ(toy_.Update(Fix(1, 1.5)), AidUse::kUnknown);
}

TEST_F(LateAid, WhereOperatorsMovedTheRoverEarlierDataAreOfNoUse) {
  DriveFor(5.0);
  toy_.Capture(1);
  toy_.Place({4.0, 1.0, 0.5});
  EXPECT_EQ(toy_.Update(Fix(1, 1.53)), AidUse::kUnknown);
  EXPECT_EQ(toy_.estimate().pose.x_m, 4.0);
  EXPECT_EQ(toy_.estimate().odometry.x_m, 4.0);
  EXPECT_EQ(Variance(toy_), 0.0);
}

}  // namespace
}  // namespace rockyard::localization
