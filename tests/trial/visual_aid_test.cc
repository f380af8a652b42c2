// Visual odometry of a drive: when it looks, what the estimator is told and when, what it costs.

#include "trial/aids/visual_aid.h"

#include <cmath>

#include "core/refusals.h"
#include "trial/clock/compute_profile.h"
#include "trial/eyes/visual_eyes.h"
#include "trial/referee/slip_onset.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using messages::CaptureNumber;
using messages::Index;
using messages::PoseCoordinate;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kErrorModel = "sensors.visual_odometry.error_model.";
const std::string kNoWayError = R"({"still_m":0,"per_m":0,"per_turn_m":0})";
const std::string kNoTurnError = R"({"still_deg":0,"metre_deg":0,"per_turn":0})";
const Overrides kExact{
    "sensors.visual_odometry.enabled=true",  "localization.estimator=visual_odometry",
    "rover.fidelity=quasi_static",           "terrain.arena.kind=open",
    kErrorModel + "failure.intercept=-1000", kErrorModel + "along=" + kNoWayError,
    kErrorModel + "across=" + kNoWayError,   kErrorModel + "up=" + kNoWayError,
    kErrorModel + "tilt=" + kNoTurnError,    kErrorModel + "heading=" + kNoTurnError};

DriveParams Seeing(const Overrides& more = {}) { return Pathfinder("nominal", kExact + more); }

// Tells what it is told, and believes whatever a test sets.
class Listener final : public localization::Estimator {
 public:
  void Propagate(const messages::MotionMeasurement& /*motion*/) override {}
  void Feel(const messages::VehicleState& /*felt*/, double /*duration_s*/) override {}
  void Place(const messages::PoseUpdate& /*update*/) override {}
  void Capture(CaptureNumber capture) override { captured.push_back(capture); }
  void Forget(CaptureNumber capture) override { forgotten.push_back(capture); }
  localization::AidUse Update(const messages::PoseFix& /*fix*/) override {
    return localization::AidUse::kNoInterest;
  }
  localization::AidUse Update(const messages::RelativeMotion& motion) override {
    motions.push_back(motion);
    return localization::AidUse::kUsed;
  }
  const messages::LocalizationEstimate& estimate() const override { return believed; }

  messages::LocalizationEstimate believed;
  std::vector<CaptureNumber> captured;
  std::vector<CaptureNumber> forgotten;
  std::vector<messages::RelativeMotion> motions;
};

class VisualAidTest : public testing::Test {
 protected:
  explicit VisualAidTest(const Overrides& more = {}) : drive_(Seeing(more)) {}

  static math::Transform At(double x_m, double heading_rad) {
    return math::MakePose({x_m, 0.0, 0.0}, heading_rad, 0.0, 0.0);
  }
  void Believe(double way_m, double heading_rad) {
    listener_.believed.odometry.distance_m = way_m;
    listener_.believed.odometry.heading_rad = heading_rad;
  }

  // Images of a rover that truly stands there.
  bool Look(const math::Transform& X_WR, double time_s, double ready_s) {
    const VisualStep step = odometry_.Read(eyes_.Look(X_WR), aid_.Expected(listener_.believed));
    truth_.OnLook(step.number, math::ToPose2(X_WR));
    return aid_.Take(step, time_s, ready_s, listener_);
  }

  DriveParams drive_;
  terrain::Terrain terrain_{terrain::Ground(), {}, {}};
  RoverCameras cameras_{drive_, {1, 0}};
  VisualEyes eyes_{drive_, {1, 0}, terrain_, cameras_};
  VisualReader odometry_{drive_, {1, 0}};
  SlipOnset truth_{drive_.perception.visual_odometry.slip_check};
  CaptureCounter captures_;
  VisualAid aid_{drive_, captures_};
  Listener listener_;
};

TEST_F(VisualAidTest, IsDueAtTheStartAndThenByWayOrTurn) {
  EXPECT_TRUE(aid_.IsDue(listener_.believed, 0.0));
  EXPECT_FALSE(Look(At(0.0, 0.0), 0.0, 0.0));  // nothing to compare it with
  EXPECT_FALSE(aid_.IsDue(listener_.believed, 1e6));
  Believe(0.74, math::DegToRad(17.9));
  EXPECT_FALSE(aid_.IsDue(listener_.believed, 1e6));
  Believe(0.76, 0.0);
  EXPECT_TRUE(aid_.IsDue(listener_.believed, 0.0));
  Believe(0.0, math::DegToRad(-18.1));
  EXPECT_TRUE(aid_.IsDue(listener_.believed, 0.0));
}

TEST_F(VisualAidTest, TellsTheMotionWhenItIsReady) {
  Look(At(0.0, 0.3), 0.0, 0.0);
  Believe(1.0, 0.0);
  EXPECT_TRUE(Look(At(0.8, 0.4), 10.0, 170.0));
  Believe(5.0, 0.0);
  EXPECT_FALSE(aid_.IsDue(listener_.believed, 11.0));  // the computer is busy
  EXPECT_FALSE(aid_.Tick(169.0, listener_));
  EXPECT_TRUE(aid_.Tick(170.0, listener_));
  EXPECT_FALSE(aid_.Tick(171.0, listener_));
  ASSERT_EQ(listener_.motions.size(), 1U);
  const messages::RelativeMotion& motion = listener_.motions[0];
  EXPECT_EQ(motion.from, 0);
  EXPECT_EQ(motion.to, 1);
  EXPECT_NEAR(motion.motion_F[Index(PoseCoordinate::kX)], 0.8 * std::cos(0.3), 1e-12);
  EXPECT_NEAR(motion.motion_F[Index(PoseCoordinate::kY)], -0.8 * std::sin(0.3), 1e-12);
  EXPECT_NEAR(motion.motion_F[Index(PoseCoordinate::kHeading)], 0.1, 1e-12);
  // The way since then counts from the last images.
  EXPECT_TRUE(aid_.IsDue(listener_.believed, 171.0));
  EXPECT_EQ(aid_.counts().steps, 1);
  EXPECT_EQ(aid_.counts().used, 1);
  EXPECT_EQ(aid_.counts().failures, 0);
}

// Turns of 6 deg against a keyframe that is given up after 10 deg.
TEST_F(VisualAidTest, GivesUpAKeyframeThatItTurnedAwayFrom) {
  for (int i = 0; i <= 3; ++i) {
    Look(At(0.0, math::DegToRad(6.0 * i)), i, i);
    aid_.Tick(i, listener_);
  }
  ASSERT_EQ(listener_.motions.size(), 3U);
  EXPECT_EQ(listener_.motions[1].from, 0);
  EXPECT_EQ(listener_.motions[2].from, 2);
}

// Half a metre up 0.2 rad, by what the rover believed of its attitude at the first images.
TEST_F(VisualAidTest, LevelsTheMotionByTheAttitudeAtTheKeyframe) {
  const math::Transform X_WR = math::MakePose({0.0, 0.0, 0.0}, 0.0, -0.2, 0.0);
  listener_.believed.attitude.pitch_rad = -0.2;
  Look(X_WR, 0.0, 0.0);
  listener_.believed.attitude.pitch_rad = 0.0;
  Look(X_WR * Eigen::Translation3d(0.5, 0.0, 0.0), 1.0, 1.0);
  ASSERT_TRUE(aid_.Tick(1.0, listener_));
  EXPECT_NEAR(listener_.motions[0].motion_F[Index(PoseCoordinate::kX)], 0.5 * std::cos(0.2), 1e-12);
}

// Steps of 0.2 m against a keyframe that is given up after 0.5 m.
TEST_F(VisualAidTest, KeepsTheMomentOfTheKeyframeAndForgetsTheOthers) {
  for (int i = 0; i <= 4; ++i) {
    Look(At(0.2 * i, 0.0), i, i);
    aid_.Tick(i, listener_);
  }
  EXPECT_THAT(listener_.captured, ElementsAre(0, 1, 2, 3, 4));
  ASSERT_EQ(listener_.motions.size(), 4U);
  for (const int i : {0, 1, 2}) EXPECT_EQ(listener_.motions[static_cast<std::size_t>(i)].from, 0);
  EXPECT_NEAR(listener_.motions[2].motion_F[Index(PoseCoordinate::kX)], 0.6, 1e-12);
  EXPECT_EQ(listener_.motions[3].from, 3);
  EXPECT_NEAR(listener_.motions[3].motion_F[Index(PoseCoordinate::kX)], 0.2, 1e-12);
  EXPECT_THAT(listener_.forgotten, ElementsAre(1, 2, 0, 4));
  EXPECT_EQ(aid_.counts().keyframes, 2);
}

TEST_F(VisualAidTest, BeginsAnewWhereTheRoverWasMoved) {
  Look(At(0.0, 0.0), 0.0, 0.0);
  Look(At(0.7, 0.0), 1.0, 5.0);
  eyes_.Renew();
  aid_.OnPlaced();
  EXPECT_FALSE(aid_.Tick(6.0, listener_));
  EXPECT_TRUE(aid_.IsDue(listener_.believed, 6.0));
  EXPECT_FALSE(Look(At(3.0, 1.0), 6.0, 6.0));
  EXPECT_TRUE(Look(At(3.5, 1.0), 7.0, 7.0));
  EXPECT_TRUE(aid_.Tick(7.0, listener_));
  ASSERT_EQ(listener_.motions.size(), 1U);
  EXPECT_EQ(listener_.motions[0].from, 2);
}

class SlippingAidTest : public VisualAidTest {
 protected:
  SlippingAidTest()
      : VisualAidTest({"perception.visual_odometry.slip_check.enabled=true",
                       "perception.visual_odometry.slip_check.limit=0.5",
                       "perception.visual_odometry.slip_check.min_way_m=0.2"}) {}

  // Images at the true x, of a rover whose wheels believe in another one.
  std::optional<SlipReading> SlipAt(double true_x_m, double rolled_x_m, double time_s) {
    listener_.believed.odometry.x_m = rolled_x_m;
    Look(At(true_x_m, 0.0), time_s, time_s);
    aid_.Tick(time_s, listener_);
    return aid_.TakeSlip();
  }
};

TEST_F(SlippingAidTest, HoldsWhatTheWheelsRolledAgainstWhatWasSeen) {
  EXPECT_FALSE(SlipAt(0.0, 0.0, 0.0));
  EXPECT_FALSE(SlipAt(0.0, 0.19, 1.0)) << "too short a way";
  const std::optional<SlipReading> slip = SlipAt(0.1, 0.4, 2.0);
  ASSERT_TRUE(slip);
  EXPECT_NEAR(slip->seen.slip, 0.75, 1e-9);
  EXPECT_TRUE(slip->seen.exceeded);
  EXPECT_TRUE(truth_.TrulyExceeded(*slip));
  EXPECT_FALSE(aid_.TakeSlip()) << "once a motion";
}

// Back by 0.3 m without slip. Held against the keyframe before the alarm, of which the wheels have
// come to stand 0.1 m ahead and the rover 0.2 m behind, it would be slip; 0.25 m back as well.
TEST_F(SlippingAidTest, CountsTheWayOfAnAlarmOnce) {
  const auto drive = [this](bool anew) {
    SlipAt(0.0, 0.0, 0.0);
    EXPECT_TRUE(SlipAt(0.1, 0.4, 1.0)->seen.exceeded);
    if (anew) eyes_.Renew();
    if (anew) aid_.BeginAnew(listener_);
    EXPECT_EQ(aid_.IsDue(listener_.believed, 1.0), anew);
    EXPECT_FALSE(anew && SlipAt(0.1, 0.4, 2.0));
    return SlipAt(-0.55, -0.25, 3.0);
  };
  const std::optional<SlipReading> after = drive(true);
  ASSERT_TRUE(after);
  EXPECT_NEAR(after->seen.slip, 0.0, 1e-9);
  EXPECT_FALSE(after->seen.exceeded);
  EXPECT_FALSE(truth_.TrulyExceeded(*after));
  // The keyframe and the pair after it are forgotten, the new keyframe is kept.
  EXPECT_THAT(listener_.forgotten, ElementsAre(1, 0, 2));
  EXPECT_EQ(listener_.motions.back().from, 2);
}

class BlindAidTest : public VisualAidTest {
 protected:
  BlindAidTest() : VisualAidTest({"sensors.visual_odometry.error_model.failure.intercept=1000"}) {}
};

TEST_F(BlindAidTest, TellsNothingWhereNoMotionIsFound) {
  for (int i = 0; i <= 3; ++i) {
    Look(At(0.2 * i, 0.0), i, i);
    EXPECT_FALSE(aid_.Tick(i, listener_));
  }
  EXPECT_TRUE(listener_.motions.empty());
  EXPECT_EQ(aid_.counts().steps, 3);
  EXPECT_EQ(aid_.counts().failures, 3);
  EXPECT_EQ(aid_.counts().keyframes, 4);  // the next pair starts from the one that failed
  EXPECT_THAT(listener_.forgotten, ElementsAre(0, 1, 2));
}

class ErringAidTest : public VisualAidTest {
 protected:
  ErringAidTest() : VisualAidTest({"sensors.visual_odometry.error_model.along.per_m=0.01"}) {}
};

// A rover that stands is seen anew by every pair of images, each with an error of its own.
TEST_F(ErringAidTest, ErrsAnewInEveryPair) {
  for (int i = 0; i <= 3; ++i) {
    Look(At(i == 0 ? 0.0 : 0.4, 0.0), i, i);
    aid_.Tick(i, listener_);
  }
  ASSERT_EQ(listener_.motions.size(), 3U);
  const auto x_m = [this](std::size_t i) {
    return listener_.motions[i].motion_F[Index(PoseCoordinate::kX)];
  };
  EXPECT_NE(x_m(0), x_m(1));
  EXPECT_NE(x_m(1), x_m(2));
  EXPECT_NEAR(x_m(0), 0.4, 6.0 * 0.004);
}

constexpr double kTurn_rad = math::DegToRad(40.0);

// Small images of flat ground, whose features are looked for near where the prediction puts them.
class ImageAidTest : public VisualAidTest {
 protected:
  ImageAidTest()
      : VisualAidTest({"sensors.visual_odometry.fidelity=image",
                       "sensors.visual_odometry.pyramid_level=0",
                       "sensors.stereo.images.pyramid_level=0",
                       "perception.visual_odometry.matcher.search_columns_px=6",
                       "perception.visual_odometry.matcher.search_rows_px=6"}) {}

  // The motions of a rover that turns and believes in another turn.
  std::size_t MotionsWhereItBelieves(double heading_rad, double true_rad) {
    Look(At(0.0, 0.0), 0.0, 0.0);
    Believe(0.0, heading_rad);
    Look(At(0.0, true_rad), 1.0, 1.0);
    aid_.Tick(1.0, listener_);
    return listener_.motions.size();
  }
};

TEST_F(ImageAidTest, FindsTheMotionThatWheelsAndGyroPredict) {
  ASSERT_EQ(MotionsWhereItBelieves(kTurn_rad, kTurn_rad), 1U);
  EXPECT_NEAR(listener_.motions[0].motion_F[Index(PoseCoordinate::kHeading)], kTurn_rad,
              math::DegToRad(0.5));
}

TEST_F(ImageAidTest, BeginsAnewWithAKeyframe) {
  const math::Transform nowhere = math::Transform::Identity();
  EXPECT_TRUE(odometry_.Read(eyes_.Look(At(0.0, 0.0)), nowhere).keyframe);
  EXPECT_TRUE(odometry_.Read(eyes_.Look(At(0.0, 0.0)), nowhere).result.motion);
  odometry_.Renew();
  const VisualStep anew = odometry_.Read(eyes_.Look(At(0.0, 0.0)), nowhere);
  EXPECT_TRUE(anew.keyframe);
  EXPECT_FALSE(anew.result.motion);
}

// Terrain sensing and visual odometry count their looks apart and share no noise of pixels; the
// scene is one.
TEST_F(ImageAidTest, NoTwoUsesOfTheCamerasShareTheirNoise) {
  const auto take = [this](CameraUse use, std::int64_t number) {
    return cameras_.Expose(use, terrain_, At(0.0, 0.0), messages::LookDirection::kAhead, number)
        .left;
  };
  EXPECT_EQ(take(CameraUse::kMotion, 0), take(CameraUse::kMotion, 0));
  EXPECT_NE(take(CameraUse::kMotion, 0), take(CameraUse::kTerrain, 0));
  EXPECT_NE(take(CameraUse::kMotion, 0), take(CameraUse::kMotion, 1));
}

TEST(VisualParams, ImagesOfTwoEyesInOnePlaceAreRefused) {
  const Overrides images{"sensors.visual_odometry.fidelity=image"};
  const Overrides ideal{"sensors.stereo.fidelity=ideal"};
  EXPECT_NO_THROW(Seeing(images));
  EXPECT_NO_THROW(Seeing(ideal));
  EXPECT_THAT(core::RefusalOf([&] { Seeing(images + ideal); }),
              HasSubstr("sensors.visual_odometry.fidelity"));
}

// Windows of 15 px reach 7 px from their feature.
TEST(VisualParams, WindowsThatReachBeyondTheImageAreRefused) {
  const std::string border = "perception.visual_odometry.detector.border_px";
  EXPECT_NO_THROW(Seeing({border + "=7"}));
  EXPECT_THAT(core::RefusalOf([&] { Seeing({border + "=6"}); }), HasSubstr(border));
}

// Windows that are compared as they are find no such turn.
TEST_F(ImageAidTest, FindsNoneWhereTheyPredictAnother) {
  EXPECT_EQ(MotionsWhereItBelieves(0.0, kTurn_rad), 0U);
}

// A smaller turn is found by looking everywhere.
TEST_F(ImageAidTest, LooksElsewhereThanTheyPredict) {
  const double turn_rad = math::DegToRad(20.0);
  ASSERT_EQ(MotionsWhereItBelieves(0.0, turn_rad), 1U);
  EXPECT_NEAR(listener_.motions[0].motion_F[Index(PoseCoordinate::kHeading)], turn_rad,
              math::DegToRad(0.5));
}

class TimedAidTest : public VisualAidTest {
 protected:
  TimedAidTest() : VisualAidTest({"sensors.visual_odometry.schedule.every_s=0.2"}) {}
};

TEST_F(TimedAidTest, IsDueByTime) {
  Look(At(0.0, 0.0), 3.0, 3.0);
  EXPECT_FALSE(aid_.IsDue(listener_.believed, 3.19));
  EXPECT_TRUE(aid_.IsDue(listener_.believed, 3.21));
}

TEST(VisualTimeOfTest, IsAsPublished) {
  const auto on = [](Computer computer) { return VisualTimeOf({.computer = computer}); };
  EXPECT_EQ(on(Computer::kNone).computing_s, 0.0);
  EXPECT_EQ(on(Computer::kNone).imaging_s, 0.0);
  EXPECT_EQ(on(Computer::kMer).computing_s, 160.0);
  EXPECT_NEAR(on(Computer::kMsl).computing_s, 8.8, 1e-12);
  EXPECT_NEAR(on(Computer::kFpga).computing_s, 0.1, 1e-12);
  EXPECT_EQ(on(Computer::kRad6000).computing_s, 160.0);
  // 0.37 s of stereo against 6.42 s (Goldberg 2002 table 3).
  EXPECT_NEAR(on(Computer::kPentium3).computing_s, 160.0 * 0.37 / 6.42, 0.15);
  EXPECT_NEAR(on(Computer::kMer).imaging_s, 8.974, 1e-12);
  ComputeParams slower{.computer = Computer::kMer};
  slower.visual_time_factor = 0.75;
  EXPECT_EQ(VisualTimeOf(slower).computing_s, 120.0);
}

// Wheels and gyro err, and a camera that sees every motion does not: what remains is what they did
// since the last images.
TEST(VisualDrive, EndsWhereItBelievesToBe) {
  for (std::uint32_t trial = 0; trial < 5; ++trial) {
    const DriveResult seeing = RunTrial(Seeing(), {9, trial});
    EXPECT_LT(seeing.record.position_error_m, 0.15);
    EXPECT_GT(seeing.record.visual_steps, seeing.record.true_distance_m / 1.1);
    EXPECT_EQ(seeing.record.visual_failures, 0.0);
    EXPECT_EQ(seeing.record.visual_gated_out, 0.0);
  }
  // The control: nothing is found, so that wheels and gyro are all there is.
  double blind_m = 0.0;
  for (std::uint32_t trial = 0; trial < 5; ++trial) {
    const DriveResult blind = RunTrial(
        Seeing({"sensors.visual_odometry.error_model.failure.intercept=1000"}), {9, trial});
    EXPECT_EQ(blind.record.visual_failures, blind.record.visual_steps);
    blind_m += blind.record.position_error_m / 5.0;
  }
  EXPECT_GT(blind_m, 0.4);
}

// On MER's computer every step takes 160 s at rest, and each pair of images their acquisition.
TEST(VisualDrive, TakesTheTimeOfItsComputer) {
  const DriveResult mer = RunTrial(
      Seeing({"clock.compute.computer=mer_rad6000", "clock.compute.acquisition_s=10"}), {9, 0});
  ASSERT_GT(mer.record.visual_steps, 3.0);
  EXPECT_NEAR(mer.record.compute_time_s, 160.0 * mer.record.visual_steps, 1e-6);
  EXPECT_NEAR(mer.record.imaging_time_s, 10.0 * (mer.record.visual_steps + 1.0), 1e-6);
}

// Beside the drive it costs its energy and no time, and what is late is used all the same.
TEST(VisualDrive, GoesOnWhileTheComputerWorks) {
  const Overrides msl{"clock.compute.computer=msl_rad750", "clock.compute.acquisition_s=0.5"};
  const Overrides overlap{"clock.overlap.imaging=true", "clock.overlap.computing=true"};
  const DriveResult beside = RunTrial(Seeing(msl + overlap), {9, 0});
  EXPECT_NEAR(beside.record.compute_time_s, 8.8 * beside.record.visual_steps, 1e-6);
  EXPECT_LT(beside.record.position_error_m, 0.3);
  const auto sum_s = [](const truth::DriveRecord& record) {
    return record.scan_time_s + record.move_time_s + record.compute_time_s + record.imaging_time_s;
  };
  const DriveResult rests = RunTrial(Seeing(msl), {9, 0});
  EXPECT_NEAR(rests.record.sim_time_s, sum_s(rests.record), 1e-6 * rests.record.sim_time_s);
  EXPECT_GT(sum_s(beside.record), beside.record.sim_time_s + 8.0);
}

TEST(VisualDrive, IsRefusedWhereNobodyListensOrNothingIsEverDue) {
  const auto refused = [](const Overrides& overrides, const std::string& path) {
    EXPECT_THAT(core::RefusalOf([&] { Seeing(overrides); }), HasSubstr(path));
  };
  refused({"localization.estimator=dead_reckoning"}, "localization.estimator");
  refused({"localization.estimator=visual_odometry", "sensors.aids.sun.enabled=true"},
          "localization.estimator");
  refused({"sensors.visual_odometry.schedule.every_m=0",
           "sensors.visual_odometry.schedule.every_deg=0"},
          "sensors.visual_odometry.schedule");
}

}  // namespace
}  // namespace rockyard::trial
