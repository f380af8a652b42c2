// A navigator that steers at every tick while images are taken and computed: what happens when,
// what it costs and where data were taken, against times that were worked out by hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "localization/estimator.h"
#include "localization/estimator_set_params.h"
#include "math/angles.h"
#include "messages/point_cloud.h"
#include "navigation/navigator.h"
#include "scenario/shipped.h"
#include "trial/shipped_trials.h"
#include "trial/sight/onboard_calibration.h"
#include "trial/toy_terrain_sensor.h"

namespace rockyard::trial {
namespace {

using messages::MotionCommand;
using messages::MotionKind;

constexpr double kTick_s = 0.05;
constexpr double kCurvature_per_m = 0.1;
// Until the rover is taken to stand: the motors' ramp and clock.stop_time_s.
constexpr double kBrake_s = 0.10 + 0.05;

struct WeaverParams {
  double drive_s = 2.0;  // then it gives up
  bool numbers_its_moves = true;
  navigation::LookReading reads = navigation::LookReading::kPoints;
  double pause_s = 0.0;  // after a look was delivered, before it asks for the next one
  double halts_s = std::numeric_limits<double>::infinity();  // then it stops for one look
  // Drives only so far beyond the pose of the last look that was delivered.
  double judged_m = std::numeric_limits<double>::infinity();
  struct Delivery {
    double time_s = 0.0;
    messages::LookMoment look;
  };
  struct Seen {
    std::vector<Delivery> deliveries;
    std::vector<double> ends_m;  // of its plans, at each tick
    std::vector<double> odometer_m;
  };
  std::shared_ptr<Seen> seen = std::make_shared<Seen>();

  void Visit(core::FieldVisitor&) {}
};

// Curvature 0 and kCurvature by turns, a new look whenever the cameras are free.
class Weaver final : public navigation::Navigator {
 public:
  // With a limit to what was judged, nothing has been at the start.
  explicit Weaver(const WeaverParams& params)
      : params_(params), end_m_(std::isinf(params.judged_m) ? params.judged_m : 0.0) {}

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    WeaverParams::Seen& seen = *params_.seen;
    if (input.look != nullptr) {
      EXPECT_EQ(input.cloud != nullptr, params_.reads == navigation::LookReading::kPoints);
      EXPECT_EQ(input.report == nullptr, params_.reads == navigation::LookReading::kPoints);
      seen.deliveries.push_back({input.time_s, *input.look});
      asks_s_ = input.time_s + params_.pause_s;
      end_m_ = input.look->odometry.distance_m + params_.judged_m;
    }
    seen.ends_m.push_back(end_m_);
    seen.odometer_m.push_back(input.estimate.distance_m);
    if (input.time_s > params_.drive_s - 0.5 * kTick_s) {
      return {.status = navigation::NavigatorStatus::kGaveUp};
    }
    MotionCommand motion{.kind = MotionKind::kArc};
    motion.curvature_per_m = turns_ ? kCurvature_per_m : 0.0;
    motion.end_m = end_m_;
    motion.move = params_.numbers_its_moves ? 1 : 0;
    turns_ = !turns_;
    if (!halted_ && input.time_s > params_.halts_s - 0.5 * kTick_s) {
      halted_ = true;
      return {.look = messages::LookDirection::kAhead, .motion = motion};
    }
    if (input.time_s < asks_s_) return {.motion = motion};
    return {.look = messages::LookDirection::kAhead, .motion = motion, .looks_on_the_move = true};
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}
  // One vote, the chosen one.
  const messages::NavigationView* view() const override { return &view_; }

 private:
  static messages::NavigationView OneVote() {
    messages::NavigationView view;
    view.forward.resize(1);
    view.forward.front().chosen = true;
    return view;
  }

  WeaverParams params_;
  messages::NavigationView view_ = OneVote();
  bool turns_ = false;
  bool halted_ = false;
  double asks_s_ = 0.0;
  double end_m_;
};

struct WitnessParams {
  std::shared_ptr<double> propagated_s = std::make_shared<double>(0.0);

  void Visit(core::FieldVisitor&) {}
};

// Believes to stand where it was placed, with its two frames a metre apart, and counts the time
// over which it was carried on.
class Witness final : public localization::Estimator {
 public:
  Witness(const WitnessParams& params, const localization::EstimatorSetup& setup)
      : params_(params) {
    Place({setup.start.x_m, setup.start.y_m, setup.start.heading_rad});
  }

  void Propagate(const messages::MotionMeasurement& motion) override {
    *params_.propagated_s += motion.duration_s;
  }
  void Feel(const messages::VehicleState& /*felt*/, double /*duration_s*/) override {}
  void Place(const messages::PoseUpdate& update) override {
    estimate_.pose = {update.x_m, update.y_m, update.heading_rad};
    estimate_.odometry = estimate_.pose;
    estimate_.odometry.x_m += 1.0;
  }
  const messages::LocalizationEstimate& estimate() const override { return estimate_; }

 private:
  WitnessParams params_;
  messages::LocalizationEstimate estimate_;
};

DriveParams WeaverDrive(const WeaverParams& weaver, const ToySensorParams& sensor,
                        const Overrides& overrides, const WitnessParams& witness = {}) {
  scenario::Scenario defaults = WithToySensor(sensor);
  defaults.drive.localization.estimators.Add<WitnessParams>(
      {.name = "witness",
       .doc = "counts the time",
       .make = [](const WitnessParams& params, const localization::EstimatorSetup& setup)
           -> std::unique_ptr<localization::Estimator> {
         return std::make_unique<Witness>(params, setup);
       }},
      witness);
  defaults.drive.navigation.navigators.Add<WeaverParams>(
      {.name = "weaver",
       .doc = "steers at each tick",
       .traits = [](const WeaverParams& p) -> navigation::NavigatorTraits {
         return {p.reads, navigation::CostOfLook{}, {}};
       },
       .make = [](const WeaverParams& p, const navigation::NavigatorSetup&)
           -> std::unique_ptr<navigation::Navigator> { return std::make_unique<Weaver>(p); }},
      weaver);
  const Overrides all = {"navigation.navigator=weaver", "sensors.terrain_sensor=toy",
                         "rover.fidelity=quasi_static", "terrain.rocks.kind=none",
                         "terrain.arena.kind=open",     "localization.estimator=oracle",
                         "clock.control_rate_hz=20",    "energy.computing_W=1.5"};
  return scenario::Shipped("pathfinder/nominal", all + overrides, defaults).drive;
}

const Overrides kOverlap = {"clock.overlap.imaging=true", "clock.overlap.computing=true",
                            "clock.overlap.steering=true"};
const ToySensorParams kSlowSensor{.computing_s = 1.5};

// Images take 0.12 s, computing 0.2 s, a tick 0.05 s. Cameras and computer:
//   look 0: images from 0 s, computed from 0.12 to 0.32 s, told at 0.35 s;
//   look 1: images from 0.15 s (the first tick after 0.12), computed from 0.32 to 0.52 s, told at
//           0.55 s;
//   look n from 2 on: images from 0.35 + 0.2 (n - 2) s, when the computer has taken those before;
//           computed from 0.12 + 0.2 n on, told at 0.35 + 0.2 n.
TEST(OverlapDrive, LooksArriveWhenTheyAreReadyAndSayWhereTheyWereTaken) {
  const WeaverParams weaver;
  const ToySensorParams sensor;
  const TracedTrial trial = RunTraced(WeaverDrive(weaver, sensor, kOverlap), 0);
  const auto& deliveries = weaver.seen->deliveries;
  ASSERT_EQ(deliveries.size(), 9U);  // 0.35 + 0.2 n < 2
  for (std::size_t n = 0; n < deliveries.size(); ++n) {
    const auto& [time_s, look] = deliveries[n];
    const auto number = static_cast<double>(n);
    EXPECT_EQ(look.number, static_cast<std::int64_t>(n));
    EXPECT_NEAR(time_s, 0.35 + 0.2 * number, 1e-9);
    const double taken_s = n == 0 ? 0.0 : n == 1 ? 0.15 : 0.35 + 0.2 * (number - 2.0);
    EXPECT_NEAR(look.time_s, taken_s, 1e-9);
    // The oracle believes the truth: the pose of the moment is the one that the sensor saw from,
    // and the trace's of that tick.
    const math::Pose2 truly = math::ToPose2(sensor.poses->at(n));
    EXPECT_EQ(look.estimate.x_m, truly.x_m);
    EXPECT_EQ(look.estimate.y_m, truly.y_m);
    EXPECT_EQ(look.odometry.x_m, truly.x_m);
    if (n == 0) continue;
    const auto tick = static_cast<std::size_t>(std::lround(taken_s / kTick_s));
    EXPECT_EQ(trial.trace.samples.at(tick - 1).pose.x_m, truly.x_m);
    // 0.15 m/s: the rover has driven on since, some centimetres less slip and the motors' ramp.
    const auto told = static_cast<std::size_t>(std::lround(time_s / kTick_s));
    const double way_m = trial.trace.samples.at(told - 1).pose.x_m - truly.x_m;
    EXPECT_GT(way_m, 0.8 * 0.15 * (time_s - taken_s)) << n;
    EXPECT_LT(way_m, 0.15 * (time_s - taken_s)) << n;
  }
}

// Who looks over the navigator's shoulder is shown the place where its points were taken.
TEST(OverlapDrive, EachDeliveryIsShownWithThePlaceWhereItWasTaken) {
  const WeaverParams weaver;
  const ToySensorParams sensor;
  std::vector<math::Vector3> shown;
  truth::Trace trace;
  RunTrial(WeaverDrive(weaver, sensor, kOverlap), {1, 0}, &trace,
           {.step = [&](const WatchedStep& step) { shown.push_back(step.X_WR.translation()); }});
  ASSERT_EQ(shown.size(), weaver.seen->deliveries.size());
  for (std::size_t n = 0; n < shown.size(); ++n) {
    EXPECT_EQ(shown[n], sensor.poses->at(n).translation()) << n;
  }
  EXPECT_EQ(EventsOf(trace, "chosen").size(), 9U);
  EXPECT_EQ(EventsOf(trace, "look").size(), 11U);
}

// Until 2 s: the rover drives all the time. The computer is at work from 0.12 s on; eleven looks
// begin (0, 0.15, then 0.35 to 1.95 s), the last one's images for 0.05 s. At each tick but the
// first the corner wheels turn by the Ackermann angle of the innermost one, atan(c x / (1 - c
// |y|)), at 60 deg/s.
TEST(OverlapDrive, TimeEnergyAndMovesAreThoseOfWhatWentOn) {
  WeaverParams weaver;
  const DriveParams drive = WeaverDrive(weaver, {}, kOverlap);
  const truth::DriveRecord record = RunTrial(drive, {1, 0}).record;
  EXPECT_NEAR(record.sim_time_s, 2.0, 1e-9);
  EXPECT_NEAR(record.drive_time_s, 2.0, 1e-9);
  EXPECT_NEAR(record.compute_time_s, 2.0 - 0.12, 1e-9);
  EXPECT_NEAR(record.imaging_time_s, 10 * 0.12 + 0.05, 1e-9);
  EXPECT_EQ(record.image_sets, 11.0);
  EXPECT_EQ(record.moves, 1.0);
  EXPECT_EQ(record.stops, 1.0);  // the end

  const messages::DriveCalibration wheels =
      OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive);
  double angle_rad = 0.0;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    if (!wheels.steered[i]) continue;
    angle_rad = std::max(angle_rad, std::atan2(kCurvature_per_m * std::abs(wheels.wheel_x_m[i]),
                                               1.0 - kCurvature_per_m * wheels.wheel_y_m[i]));
  }
  const double steer_s = 39 * angle_rad / math::DegToRad(60.0);
  EXPECT_GT(steer_s, 0.1);
  EXPECT_NEAR(record.steer_time_s, steer_s, 1e-9);
  EXPECT_NEAR(record.move_time_s, 2.0, 1e-9);  // what is steered on the move takes no time of it
  const double driving_J = 2.0 * (3.77 + 0.80 + 8.28);
  const double imaging_J = record.imaging_time_s * 0.75;
  const double computing_J = record.compute_time_s * 1.5;
  EXPECT_NEAR(3600.0 * record.imaging_energy_wh, imaging_J, 1e-9);
  EXPECT_NEAR(3600.0 * record.compute_energy_wh, computing_J, 1e-9);
  EXPECT_NEAR(3600.0 * record.energy_wh, driving_J + imaging_J + computing_J + steer_s * 6.70,
              1e-9);

  weaver.numbers_its_moves = false;
  EXPECT_EQ(RunTrial(WeaverDrive(weaver, {}, kOverlap), {1, 0}).record.moves, 40.0);
}

// What the scenario lets overlap does, and nothing else: times that do not overlap add up. The next
// look is asked for when the rover has driven on for a while.
TEST(OverlapDrive, WhatMayNotOverlapDoesNot) {
  for (const bool imaging : {false, true}) {
    for (const bool computing : {false, true}) {
      const auto text = [](bool value) { return std::string(value ? "true" : "false"); };
      const WeaverParams weaver{.drive_s = 4.0, .pause_s = 0.3};
      const TracedTrial trial =
          RunTraced(WeaverDrive(weaver, {},
                                {"clock.overlap.imaging=" + text(imaging),
                                 "clock.overlap.computing=" + text(computing)}),
                    0);
      const truth::DriveRecord& record = trial.result.record;
      const std::string which = text(imaging) + " " + text(computing);
      EXPECT_GT(record.imaging_time_s, 0.3) << which;
      EXPECT_GT(record.compute_time_s, 0.5) << which;
      double alone_s = record.drive_time_s;
      if (!imaging) alone_s += record.imaging_time_s;
      if (!computing) alone_s += record.compute_time_s;
      EXPECT_NEAR(record.sim_time_s, alone_s, 1e-9) << which;
      // It comes to rest for each stage that may not overlap.
      const bool stops = !imaging || !computing;
      EXPECT_EQ(record.stops > 3.0, stops) << which << " " << record.stops;
      EXPECT_GT(weaver.seen->deliveries.size(), 3U) << which;
    }
  }
}

// A report may ask for a second look from one pose, and a light stripe scan takes its time: the
// rover stops, whatever may overlap.
TEST(OverlapDrive, ReportsAndScansStopTheRover) {
  WeaverParams weaver{
      .drive_s = 4.0, .reads = navigation::LookReading::kHazardReport, .pause_s = 0.3};
  const auto reports = RunTrial(WeaverDrive(weaver, {}, kOverlap), {1, 0}).record;
  EXPECT_GT(weaver.seen->deliveries.size(), 3U);
  EXPECT_NEAR(reports.sim_time_s,
              reports.drive_time_s + reports.imaging_time_s + reports.compute_time_s, 1e-9);
  weaver.reads = navigation::LookReading::kPoints;
  weaver.drive_s = 90.0;
  weaver.seen->deliveries.clear();
  const auto scans =
      RunTrial(WeaverDrive(weaver, {}, kOverlap + Overrides{"sensors.terrain_sensor=light_stripe"}),
               {1, 0})
          .record;
  EXPECT_GT(weaver.seen->deliveries.size(), 3U);
  EXPECT_EQ(scans.scan_time_s, 20.0 * scans.scans);
  EXPECT_NEAR(scans.sim_time_s, scans.drive_time_s + scans.scan_time_s, 1e-9);
}

// Operators turn the rover at a mirror line: what it saw before is not told any more, although with
// 1.5 s to compute some of it was under way.
TEST(OverlapDrive, WhatWasSeenBeforeTheRoverWasTurnedIsNotTold) {
  const WeaverParams weaver{.drive_s = 30.0};
  const TracedTrial trial = RunTraced(
      WeaverDrive(weaver, kSlowSensor,
                  kOverlap + Overrides{"terrain.arena.kind=virtual_reflected",
                                       "course.start_y_m=0.6", "course.start_heading_deg=90"}),
      0);
  const std::vector<truth::TraceEvent> reflections = EventsOf(trial.trace, "reflection");
  for (const truth::TraceEvent& event : reflections) {
    for (const WeaverParams::Delivery& delivery : weaver.seen->deliveries) {
      EXPECT_EQ(delivery.time_s > event.time_s, delivery.look.time_s >= event.time_s)
          << event.time_s;
    }
  }
  EXPECT_FALSE(reflections.empty());
  EXPECT_GT(weaver.seen->deliveries.size(), 10U);
}

// With 1.5 s to compute, the look of 0.15 s is under way when the navigator stops for one at 1 s,
// which is told next; what was seen from farther back is not told after it.
TEST(OverlapDrive, WhatWasSeenBeforeTheRoverStoppedForALookIsNotTold) {
  const WeaverParams weaver{.drive_s = 10.0, .halts_s = 1.0};
  RunTrial(WeaverDrive(weaver, kSlowSensor, kOverlap), {1, 0});
  const auto& deliveries = weaver.seen->deliveries;
  ASSERT_GT(deliveries.size(), 3U);
  EXPECT_EQ(deliveries[0].look.number, 2);
  EXPECT_NEAR(deliveries[0].look.time_s, 1.0 + kBrake_s, 1e-9);
  for (std::size_t n = 1; n < deliveries.size(); ++n) {
    EXPECT_EQ(deliveries[n].look.number, deliveries[n - 1].look.number + 1);
    EXPECT_GT(deliveries[n].look.time_s, deliveries[0].look.time_s);
  }
}

// Images that may not be taken on the move are of the place where the rover stands for them.
TEST(OverlapDrive, ImagesThatMayNotOverlapAreTakenWhereTheRoverStands) {
  const WeaverParams weaver{.drive_s = 4.0, .pause_s = 0.3};
  const ToySensorParams sensor;
  const TracedTrial trial =
      RunTraced(WeaverDrive(weaver, sensor, {"clock.overlap.computing=true"}), 0);
  std::vector<math::Vector3> stood;
  for (const truth::TraceRest& rest : trial.trace.rests) {
    if (rest.sample.activity != "image") continue;
    stood.push_back(rest.sample.posture.X_WR.translation());
  }
  ASSERT_EQ(stood.size(), sensor.poses->size());
  EXPECT_GT(stood.size(), 3U);
  for (std::size_t n = 0; n < stood.size(); ++n) {
    EXPECT_EQ(stood[n], sensor.poses->at(n).translation()) << n;
  }
}

TEST(OverlapDrive, AMomentHasThePoseInEitherFrame) {
  const WeaverParams weaver;
  RunTrial(WeaverDrive(weaver, {}, kOverlap + Overrides{"localization.estimator=witness"}), {1, 0});
  ASSERT_FALSE(weaver.seen->deliveries.empty());
  for (const WeaverParams::Delivery& delivery : weaver.seen->deliveries) {
    EXPECT_EQ(delivery.look.odometry.x_m, delivery.look.estimate.x_m + 1.0);
  }
}

// A gyro that drifts while the rover stands does so whatever it stands for.
TEST(OverlapDrive, TheEstimateIsCarriedOnOverEachRest) {
  for (const char* accumulates : {"false", "true"}) {
    const WeaverParams weaver{.drive_s = 4.0, .pause_s = 0.3};
    const WitnessParams witness;
    const auto record =
        RunTrial(WeaverDrive(weaver, {},
                             {"clock.overlap.imaging=true", "localization.estimator=witness",
                              std::string("sensors.gyro.accumulates_at_rest=") + accumulates},
                             witness),
                 {1, 0})
            .record;
    EXPECT_GT(record.compute_time_s, 0.5);
    const bool all = std::string(accumulates) == "true";
    EXPECT_NEAR(*witness.propagated_s,
                all ? record.sim_time_s : record.sim_time_s - record.compute_time_s, 1e-9);
  }
}

// Images of visual odometry take 0.5 s, and work on them 8.8 s. What may not overlap the rover
// stands for, every 10 s, and the estimate is carried on over all of it; else new images are taken
// as soon as the last ones were worked on.
TEST(OverlapDrive, VisualOdometryIsWaitedForWhereItMayNotOverlap) {
  for (const bool images : {false, true}) {
    for (const bool computes : {false, true}) {
      const bool overlaps = images && computes;
      const WeaverParams weaver{.drive_s = 60.0, .pause_s = 100.0};
      const WitnessParams witness;
      DriveParams drive =
          WeaverDrive(weaver, {},
                      {"localization.estimator=witness", "sensors.gyro.accumulates_at_rest=true",
                       "clock.compute.computer=msl_rad750", "clock.compute.acquisition_s=0.5",
                       "terrain.ground.soil.law=bekker"},
                      witness);
      drive.clock.overlap.imaging = images;
      drive.clock.overlap.computing = computes;
      // Behind the checks: the witness does not listen.
      drive.sensors.visual_odometry.enabled = true;
      drive.sensors.visual_odometry.schedule.every_s = overlaps ? 0.1 : 10.0;
      const truth::DriveRecord record = RunTrial(drive, {1, 0}).record;
      EXPECT_NEAR(*witness.propagated_s, record.sim_time_s, 1e-9);
      EXPECT_GE(record.visual_steps, 3.0);
      // The last pair of images may wait for its answer.
      EXPECT_LE((record.visual_steps - 1.0) * 9.3, record.sim_time_s);
      // It brakes for each pair but for the first images, at the start.
      EXPECT_EQ(record.stops >= record.visual_steps, !overlaps) << record.stops;
    }
  }
}

// Without overlap.steering the rover stands to steer by more than the wheel driver allows.
TEST(OverlapDrive, SteersAtRestWhereItMayNotSteerOnTheMove) {
  const Overrides never = {"navigation.wheel_driver.steer_while_driving_deg=0"};
  const WeaverParams weaver{.pause_s = 0.3};
  const auto standing = RunTrial(WeaverDrive(weaver, {}, never), {1, 0}).record;
  const auto rolling =
      RunTrial(WeaverDrive(weaver, {}, never + Overrides{"clock.overlap.steering=true"}), {1, 0})
          .record;
  EXPECT_GT(standing.steer_time_s, 0.0);
  EXPECT_GT(rolling.steer_time_s, 0.0);
  EXPECT_NEAR(standing.sim_time_s,
              standing.drive_time_s + standing.steer_time_s + standing.imaging_time_s +
                  standing.compute_time_s,
              1e-9);
  EXPECT_NEAR(rolling.sim_time_s,
              rolling.drive_time_s + rolling.imaging_time_s + rolling.compute_time_s, 1e-9);
}

// 10 cm beyond the pose of each look are judged. With images that take 1.5 s to compute the rover
// is at their end before it hears of the next: it stops in time, waits, and goes on.
TEST(OverlapDrive, APlanThatIsLateStopsTheRoverInTime) {
  const WeaverParams weaver{.drive_s = 20.0, .judged_m = 0.1};
  const auto late = RunTrial(WeaverDrive(weaver, kSlowSensor, kOverlap), {1, 0}).record;
  const WeaverParams::Seen& seen = *weaver.seen;
  EXPECT_GT(seen.deliveries.size(), 8U);
  for (std::size_t tick = 0; tick < seen.odometer_m.size(); ++tick) {
    EXPECT_LE(seen.odometer_m[tick], seen.ends_m[tick] + 1e-9) << tick;
  }
  EXPECT_GT(late.stops, 4.0);
  EXPECT_GT(late.move_overhead_time_s, 5.0);  // waiting
  EXPECT_GT(late.true_distance_m, 0.3);
  // The control: computed in time, it never stops.
  const WeaverParams ahead{.judged_m = 0.1};
  const auto in_time = RunTrial(WeaverDrive(ahead, {}, kOverlap), {1, 0}).record;
  EXPECT_EQ(in_time.stops, 1.0);  // the end
  EXPECT_EQ(in_time.moves, 1.0);
}

// Navigators that stop to look do so whatever could overlap.
TEST(OverlapDrive, NavigatorsThatStopToLookKeepTheirBits) {
  const Overrides overlap = {"clock.overlap.imaging=true", "clock.overlap.computing=true"};
  const Overrides computer = {"clock.compute.computer=pentium_3_500mhz"};
  EXPECT_EQ(Differences(RunTrial(Gestalt("abundance", computer), {1, 3}),
                        RunTrial(Gestalt("abundance", computer + overlap), {1, 3})),
            std::vector<std::string>{});
  EXPECT_EQ(Differences(RunTrial(Pathfinder("nominal"), {1, 3}),
                        RunTrial(Pathfinder("nominal", overlap), {1, 3})),
            std::vector<std::string>{});
}

}  // namespace
}  // namespace rockyard::trial
