// What wrong calibrations do to a rover that is true to its description, and what a wrong mount of
// stereo cameras makes of the points that they see.

#include "trial/sight/onboard_calibration.h"

#include <gtest/gtest.h>

#include "math/angles.h"
#include "perception/triangulation.h"
#include "rover/rover_layout_params.h"
#include "sensing/light_stripe.h"
#include "sensing/stereo_sensor.h"
#include "sensing/stripe_layout_params.h"
#include "trial/shipped_trials.h"
#include "trial/sight/terrain_sensing.h"

namespace rockyard::trial {
namespace {

using messages::kStripeRows;
using messages::kStripes;

TEST(OnboardCalibrationTest, NoErrorLeavesTheTruthBitForBit) {
  const rover::RoverParams rover;
  const messages::DriveCalibration truth = rover::MakeDriveCalibration(rover);
  const messages::DriveCalibration drive = OnboardDriveCalibration(rover, {});
  EXPECT_EQ(drive.wheel_radius_m, truth.wheel_radius_m);
  EXPECT_EQ(drive.radius_ratio, truth.radius_ratio);
  EXPECT_EQ(drive.wheel_x_m, truth.wheel_x_m);
  EXPECT_EQ(drive.wheel_y_m, truth.wheel_y_m);
  EXPECT_EQ(drive.steering_offset_rad, 0.0);
  const messages::StripeCalibration sensor = sensing::TrueCalibration({});
  const messages::StripeCalibration stripe = OnboardStripeCalibration({}, {});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(stripe.cameras[i].X_RC.matrix() == sensor.cameras[i].X_RC.matrix());
  }
  for (std::size_t i = 0; i < kStripes; ++i) {
    EXPECT_TRUE(stripe.lasers[i].normal_R == sensor.lasers[i].normal_R);
    EXPECT_TRUE(stripe.lasers[i].axis_R == sensor.lasers[i].axis_R);
  }
}

TEST(OnboardCalibrationTest, DriveErrorsAreWhatIsBelievedTooMuch) {
  const rover::RoverParams rover;
  const messages::DriveCalibration truth = rover::MakeDriveCalibration(rover);
  const messages::DriveCalibration c =
      OnboardDriveCalibration(rover, {.wheel_radius_percent = 2.0,
                                      .wheel_radius_left_right_percent = 4.0,
                                      .track_percent = -5.0,
                                      .wheelbase_percent = 10.0,
                                      .steering_offset_rad = 0.1});
  EXPECT_DOUBLE_EQ(c.wheel_radius_m, 1.02 * truth.wheel_radius_m);
  EXPECT_DOUBLE_EQ(c.steering_offset_rad, 0.1);
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    EXPECT_DOUBLE_EQ(c.radius_ratio[i], i < 3 ? 1.02 : 0.98);
    EXPECT_DOUBLE_EQ(c.wheel_x_m[i], 1.1 * truth.wheel_x_m[i]);
    EXPECT_DOUBLE_EQ(c.wheel_y_m[i], 0.95 * truth.wheel_y_m[i]);
  }
}

// Elevations of flat ground seen by the true sensor and read with a wrong calibration.
messages::ElevationScan FlatGround(const perception::CalibrationErrorParams& errors) {
  sensing::LightStripeParams params{.wrong_place_probability = 0.0};
  const messages::StripeScan scan = sensing::LightStripe(params).Scan(
      terrain::Terrain(terrain::Ground(), {}, {}), math::Transform::Identity(), {1, 0}, 0);
  return perception::Triangulator(OnboardStripeCalibration(params, errors)).Elevations(scan);
}

// What an error adds to the elevation of one point. Both readings start from the same pixel.
double Raised(const perception::CalibrationErrorParams& errors, std::size_t row,
              std::size_t stripe) {
  const messages::ElevationPoint wrong = FlatGround(errors).points[row][stripe];
  const messages::ElevationPoint right = FlatGround({}).points[row][stripe];
  EXPECT_TRUE(wrong.detected && right.detected) << row << ", " << stripe;
  return wrong.elevation_m - right.elevation_m;
}

// The centre laser shines straight ahead from the plane of the cameras' height h: a ray at column
// angle c meets it at distance s = b / sin(c) whatever its depression. The point at depression D,
// read at D + e, is therefore believed at h - s cos(c) sin(D + e) with s cos(c) sin(D) = h:
//   elevation = h (1 - sin(D + e) / sin(D)),  D = atan(h / ahead).
TEST(OnboardCalibrationTest, PitchedCameraRaisesFlatGroundByTheClosedForm) {
  const sensing::LightStripeParams params;
  const messages::StripeCalibration truth = sensing::TrueCalibration(params);
  const double h = params.camera_height_m;
  for (const double pitch_deg : {-3.0, -1.0, 2.0}) {
    perception::CalibrationErrorParams errors;
    errors.left_camera.pitch_rad = math::DegToRad(pitch_deg);
    for (std::size_t row = 0; row < kStripeRows; ++row) {
      const double depression =
          params.camera_pitch_rad + truth.scanline_px[row] * params.row_pitch_rad();
      const double expected =
          h * (1.0 - std::sin(depression + errors.left_camera.pitch_rad) / std::sin(depression));
      EXPECT_NEAR(Raised(errors, row, kStripes / 2), expected, 1e-3 + 0.02 * std::abs(expected));
      EXPECT_EQ(expected > 0.0, pitch_deg < 0.0);
    }
  }
}

TEST(OnboardCalibrationTest, CameraBelievedTooHighRaisesEverythingItSees) {
  perception::CalibrationErrorParams errors;
  errors.right_camera.z_m = 0.01;
  // The right camera sees the two stripes on the right; lines of percept are parallel to the truth.
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    EXPECT_EQ(Raised(errors, row, 0), 0.0);
    EXPECT_NEAR(Raised(errors, row, kStripes - 1), 0.01, 1e-9);
  }
}

// A centre plane turned by e left about its emitter, baseline b to the left camera: the ray that
// met it at x ahead now meets it where y_camera + slope x' = tan(e) x', with slope = -b / x:
//   x' / x = b / (b + x tan(e)), and the elevation is h (1 - x' / x).
TEST(OnboardCalibrationTest, TurnedLaserRaisesFlatGroundByTheClosedForm) {
  const sensing::LightStripeParams params;
  const messages::StripeCalibration truth = sensing::TrueCalibration(params);
  const double h = params.camera_height_m;
  const double b = 0.5 * params.camera_separation_m;
  perception::CalibrationErrorParams errors;
  errors.lasers.angle_rad[kStripes / 2] = math::DegToRad(1.0);
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    const double x =
        h / std::tan(params.camera_pitch_rad + truth.scanline_px[row] * params.row_pitch_rad());
    const double expected = h * (1.0 - b / (b + x * std::tan(math::DegToRad(1.0))));
    EXPECT_NEAR(Raised(errors, row, kStripes / 2), expected, 1e-3 + 0.03 * std::abs(expected));
    EXPECT_EQ(Raised(errors, row, 0), 0.0);
  }
}

// Straight 7 m on level sand with sensors free of noise.
TracedTrial LevelSand(const Overrides& errors) {
  const Overrides quiet{"sensors.encoders.distance_variance_m2_per_m=1.2e-5",
                        "sensors.gyro.heading_variance_deg2_per_m=0", "sensors.gyro.scale=1"};
  return RunTraced(Pathfinder("level_sand", errors + quiet), 0);
}

double BelievedOverTrue(const TracedTrial& trial) {
  return trial.result.record.dead_reckoned_distance_m / trial.result.record.true_distance_m;
}

TEST(OnboardCalibrationTest, WheelRadiusErrorBiasesTheOdometerByItself) {
  const double right = BelievedOverTrue(LevelSand({}));
  for (const double percent : {-3.0, 2.0}) {
    const double wrong = BelievedOverTrue(LevelSand(
        {"perception.calibration.drive.wheel_radius_percent=" + std::to_string(percent)}));
    EXPECT_NEAR(wrong / right, 1.0 + 0.01 * percent, 1e-3);
  }
}

double LargestAside(const truth::Trace& trace) {
  double y_m = 0.0;
  for (const truth::TraceSample& sample : trace.samples) {
    if (std::abs(sample.pose.y_m) > std::abs(y_m)) y_m = sample.pose.y_m;
  }
  return y_m;
}

// Left wheels believed too large run too slowly: the rover bears left until the gyro, which knows,
// has it steered back. Dead reckoning takes the heading from the gyro and is not bent.
TEST(OnboardCalibrationTest, LeftAgainstRightBendsThePathAndNotTheGyrosHeading) {
  const TracedTrial straight = LevelSand({});
  const TracedTrial bent =
      LevelSand({"perception.calibration.drive.wheel_radius_left_right_percent=6"});
  EXPECT_LT(std::abs(LargestAside(straight.trace)), 0.02);
  EXPECT_GT(LargestAside(bent.trace), 0.05);
  for (const truth::TraceSample& sample : bent.trace.samples) {
    EXPECT_NEAR(sample.estimate.heading_rad, sample.pose.heading_rad, math::DegToRad(0.2));
  }
}

// All steered wheels stand to the left: the rover goes aside without turning, unseen by gyro and
// odometer.
TEST(OnboardCalibrationTest, SteeringOffsetCarriesTheRoverAsideUnseen) {
  const TracedTrial trial = LevelSand({"perception.calibration.drive.steering_offset_deg=3"});
  EXPECT_GT(trial.result.record.final_y_m, 0.1);
  EXPECT_NEAR(trial.result.record.believed_y_m, 0.0, 0.1);
}

using math::Vector3;
using messages::LookDirection;
using Points = std::vector<Vector3>;

constexpr core::TrialKey kKey{1, 0};

terrain::Terrain Flat() { return {terrain::Ground(), {}, {}}; }

// What the navigator gets of a first look over flat ground, from a level rover.
Points Seen(const Overrides& overrides, LookDirection direction) {
  const DriveParams drive = Gestalt("abundance", overrides);
  TerrainSensing terrain_sensing(drive);
  RoverCameras cameras(drive, kKey);
  const auto sensor = drive.sensors.terrain_sensors.chosen().MakeSensor(drive, kKey, cameras);
  const LookOrder order = terrain_sensing.Order(direction, {});
  const Percept percept = terrain_sensing.Take(
      order, sensor->Look(Flat(), math::Transform::Identity(), direction, order.number));
  return percept.cloud ? percept.cloud->points_R : Points{};
}

std::string Error(const std::string& what) { return "perception.calibration.stereo_" + what; }

TEST(StereoCalibrationTest, NoErrorLeavesTheCloudBitForBit) {
  const DriveParams drive = Gestalt("abundance");
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    const Points seen = Seen({}, direction);
    const Points measured = sensing::StereoSensor(drive.sensors.stereo)
                                .Look(Flat(), math::Transform::Identity(), kKey, 0, direction)
                                .points_R;
    ASSERT_GT(seen.size(), 1000U);
    EXPECT_TRUE(seen == measured);
  }
}

// Flat ground turns about the lateral axis of the middle of the pair, which keeps its distance h
// from it: with the error e and the mount at c, n . (p - c) = -h with n = (+-sin e, 0, cos e), +
// for cameras that look ahead. A pair believed to look too far down sees the ground fall away.
TEST(StereoCalibrationTest, APitchErrorOfOneDegreeTiltsFlatGroundByOneDegree) {
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    const bool ahead = direction == LookDirection::kAhead;
    const std::string mount = ahead ? "front" : "rear";
    const Overrides ideal{"sensors.stereo.fidelity=ideal"};
    const sensing::StereoParams stereo = Gestalt("abundance").sensors.stereo;
    const double h = ahead ? stereo.front.height_m : stereo.rear.height_m;
    const double way = ahead ? 1.0 : -1.0;
    const Vector3 c(way * (ahead ? stereo.front.ahead_m : stereo.rear.ahead_m), 0.0, h);
    for (const double error_deg : {-1.0, 1.0}) {
      const Points seen = Seen(
          ideal + Overrides{Error(mount + ".pitch_deg=" + std::to_string(error_deg))}, direction);
      ASSERT_GT(seen.size(), 1000U);
      const double error = math::DegToRad(error_deg);
      const Vector3 n(way * std::sin(error), 0.0, std::cos(error));
      for (const Vector3& p : seen) EXPECT_NEAR(n.dot(p - c), -h, 1e-9);
    }
  }
}

TEST(StereoCalibrationTest, ShiftsMovePointsAndTheOtherPairKeepsItsOwn) {
  const Overrides shift{Error("rear.x_m=0.01"), Error("rear.z_m=-0.02")};
  EXPECT_TRUE(Seen(shift, LookDirection::kAhead) == Seen({}, LookDirection::kAhead));
  const Points shifted = Seen(shift, LookDirection::kBehind);
  const Points right = Seen({}, LookDirection::kBehind);
  ASSERT_EQ(shifted.size(), right.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_NEAR((shifted[i] - right[i] - Vector3(0.01, 0.0, -0.02)).norm(), 0.0, 1e-12);
  }
}

// Believed to look e too far left: points turn left about the vertical through level cameras.
TEST(StereoCalibrationTest, AYawErrorTurnsPointsAboutTheMount) {
  const Overrides level{"sensors.stereo.front.pitch_deg=0"};
  const Points right = Seen(level, LookDirection::kAhead);
  const Points turned = Seen(level + Overrides{Error("front.yaw_deg=2")}, LookDirection::kAhead);
  const Vector3 c(Gestalt("abundance").sensors.stereo.front.ahead_m, 0.0, 0.0);
  const Eigen::AngleAxisd left(math::DegToRad(2.0), Vector3::UnitZ());
  ASSERT_GT(right.size(), 1000U);
  ASSERT_EQ(turned.size(), right.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_NEAR((turned[i] - c - left * (right[i] - c)).norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace rockyard::trial
