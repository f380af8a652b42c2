// Hand-computed scans. In R the cameras and emitters sit at x = 0.27 m, z = 0.25 m; after rounding
// to image rows the four scanlines look down at 58.1845, 48.4182, 40.9307 and 35.2337 degrees and
// meet flat ground at x = 0.4251, 0.4918, 0.5583 and 0.6240 m.
#include <gtest/gtest.h>

#include <cmath>

#include "sensing/stripe_scene.h"

namespace rockyard::sensing {
namespace {

using messages::ElevationScan;
using messages::kStripeRows;
using messages::kStripes;

using RowValues = std::array<double, kStripeRows>;

constexpr RowValues kDepression_deg{58.1845, 48.4182, 40.9307, 35.2337};

// Half a pixel of elevation on flat ground: depth s = height / sin(depression), depth per pixel
// s^2 pitch / (b cos^2(column)) with the smallest baseline, 5 cm, and its column of 0.28 rad.
double HalfPixel_m(std::size_t row, double elevation_m = 0.0) {
  const double sine = std::sin(math::DegToRad(kDepression_deg[row]));
  const double depth_m = (0.25 - elevation_m) / sine;
  return 0.5 * sine * depth_m * depth_m * 0.0024143 / (0.05 * 0.92);
}

// From the origin.
ElevationScan Seen(const terrain::Terrain& terrain,
                   const LightStripeParams& params = NoiselessParams()) {
  return Elevations(params, terrain, PoseAt(0, 0, 0));
}

// Which points of the centre stripe are detected, nearest first.
std::array<bool, kStripeRows> CentreDetected(const ElevationScan& scan) {
  std::array<bool, kStripeRows> detected{};
  for (std::size_t row = 0; row < kStripeRows; ++row) detected[row] = scan.points[row][2].detected;
  return detected;
}

void ExpectRows(const ElevationScan& scan, const RowValues& expected) {
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    for (std::size_t stripe = 0; stripe < kStripes; ++stripe) {
      SCOPED_TRACE(testing::Message() << "row " << row << " stripe " << stripe);
      ASSERT_TRUE(scan.points[row][stripe].detected);
      EXPECT_NEAR(scan.points[row][stripe].elevation_m, expected[row],
                  HalfPixel_m(row, expected[row]));
    }
  }
}

int CountDetected(const ElevationScan& scan) {
  int count = 0;
  for (const auto& point : scan.points.points()) count += point.detected;
  return count;
}

TEST(LightStripeSceneTest, FlatGround) { ExpectRows(Seen(FlatWith({})), {0, 0, 0, 0}); }

TEST(LightStripeSceneTest, FlatGroundBelowARaisedRover) {
  ExpectRows(Elevations(NoiselessParams(), FlatWith({}), PoseAt(3, -2, 0.1, 1.2)),
             {-0.1, -0.1, -0.1, -0.1});
}

TEST(LightStripeSceneTest, ElevationsCountFromTheDatumPlane) {
  LightStripeParams params = NoiselessParams();
  params.datum_z_m = 0.02;
  ExpectRows(Seen(FlatWith({}), params), {-0.02, -0.02, -0.02, -0.02});
}

TEST(LightStripeSceneTest, PitchedRoverSeesTheGroundRise) {
  // Nose down by 5 degrees about the origin of R: ground at z_R = x_R tan(5 deg).
  math::Transform X_WR = math::Transform::Identity();
  const double pitch = math::DegToRad(5.0);
  X_WR.linear() = Eigen::AngleAxisd(pitch, math::Vector3::UnitY()).toRotationMatrix();
  // x = 0.27 + (0.25 - z) / tan(depression), z = x tan(5 deg).
  RowValues expected{};
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    const double cot = 1.0 / std::tan(math::DegToRad(kDepression_deg[row]));
    const double t = std::tan(pitch);
    expected[row] = t * (0.27 + 0.25 * cot) / (1.0 + t * cot);
  }
  ExpectRows(Elevations(NoiselessParams(), FlatWith({}), X_WR), expected);
}

TEST(LightStripeSceneTest, StepUp) {
  // A vertical face at x = 0.48: rows beyond it land on it at z = 0.25 - 0.21 tan(depression).
  const terrain::Wall face{math::Vector3::UnitX(), 0.48};
  ExpectRows(Seen(FlatWith({}, {face})), {0.0, 0.01332, 0.06790, 0.10168});
}

TEST(LightStripeSceneTest, PitBehindARoundedEdge) {
  // The rover stands on a ridge 0.1 m high, elliptic in x with half width 0.5 m and endless in y;
  // the nearest row lands on its flank, the others in the pit.
  const auto ridge = EllipsoidRock(0, 0, 0, 0.5, 1e6, 0.1);
  ExpectRows(Elevations(NoiselessParams(), FlatWith({ridge}), PoseAt(0, 0, 0.1)),
             {-0.06276, -0.1, -0.1, -0.1});
}

TEST(LightStripeSceneTest, DeepPitIsMissed) {
  // The ground lies below the lowest searched elevation.
  EXPECT_EQ(CountDetected(Elevations(NoiselessParams(), FlatWith({}), PoseAt(0, 0, 0.31))), 0);
}

TEST(LightStripeSceneTest, TallRockBetweenStripesIsNotSeen) {
  // 20 cm high and 10 cm wide between the centre and the left inner stripe.
  const auto rock = EllipsoidRock(0.60, 0.09, 0, 0.05, 0.05, 0.2);
  ExpectRows(Seen(FlatWith({rock})), {0, 0, 0, 0});
}

TEST(LightStripeSceneTest, TallRockOnAStripeIsSeenBelowItsTop) {
  const auto far = EllipsoidRock(0.625, 0, 0, 0.05, 0.05, 0.2);
  auto scan = Seen(FlatWith({far}));
  EXPECT_NEAR(scan.points[2][2].elevation_m, 0.0, HalfPixel_m(2));
  EXPECT_NEAR(scan.points[3][2].elevation_m, 0.03406, HalfPixel_m(3));
  const auto near = EllipsoidRock(0.50, 0, 0, 0.05, 0.05, 0.2);
  scan = Seen(FlatWith({near}));
  const RowValues expected{0.0, 0.04564, 0.08934, 0.11628};
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    EXPECT_NEAR(scan.points[row][2].elevation_m, expected[row], HalfPixel_m(row));
    EXPECT_NEAR(scan.points[row][1].elevation_m, 0.0, HalfPixel_m(row));
    EXPECT_NEAR(scan.points[row][3].elevation_m, 0.0, HalfPixel_m(row));
  }
}

TEST(LightStripeSceneTest, RockThatHidesAPointFromTheCamera) {
  // The left camera (y = 0.06) sees the farthest point of stripe 1 (0.624, 0.185) across
  // (0.40, 0.106, 0.158). A thin rock stands there, clear of the light plane (y = 0.137).
  const auto rock = EllipsoidRock(0.40, 0.10, 0, 0.02, 0.02, 0.2);
  const auto hidden = Seen(FlatWith({rock}));
  EXPECT_FALSE(hidden.points[3][1].detected);
  EXPECT_TRUE(hidden.points[3][0].detected);
  // Too low to reach the line of sight.
  const auto low = EllipsoidRock(0.40, 0.10, 0, 0.02, 0.02, 0.12);
  const auto seen = Seen(FlatWith({low}));
  ASSERT_TRUE(seen.points[3][1].detected);
  EXPECT_NEAR(seen.points[3][1].elevation_m, 0.0, HalfPixel_m(3));
}

TEST(LightStripeSceneTest, RockThatHidesAPointFromTheLaser) {
  // With emitters 5 cm lower, light reaches the farthest central point 0.0995 m above x = 0.45,
  // where the camera's scanline passes at 0.123 m. A rock top lies between.
  LightStripeParams params = NoiselessParams();
  params.emitter_height_m = 0.20;
  params.search_high_m = 0.15;
  const auto scan_with_top = [&](double top_m) {
    const auto rock = EllipsoidRock(0.45, 0, top_m - 0.5, 0.02, 0.02, 0.5);
    return Seen(FlatWith({rock}), params);
  };
  EXPECT_FALSE(scan_with_top(0.11).points[3][2].detected);
  const auto clear = scan_with_top(0.09);
  ASSERT_TRUE(clear.points[3][2].detected);
  EXPECT_NEAR(clear.points[3][2].elevation_m, 0.0, HalfPixel_m(3));
}

TEST(LightStripeSceneTest, LoweredEmittersMeasureFlatGround) {
  LightStripeParams params = NoiselessParams();
  params.emitter_height_m = 0.20;
  params.emitter_x_m = 0.25;
  ExpectRows(Seen(FlatWith({}), params), {0, 0, 0, 0});
}

TEST(LightStripeSceneTest, FanLimits) {
  // A fan of 0.3 rad about the mean of 58.2 and 35.2 degrees lights 38.1 to 55.3 degrees.
  LightStripeParams params = NoiselessParams();
  params.fan_rad = 0.3;
  EXPECT_EQ(CentreDetected(Seen(FlatWith({}), params)), (std::array{false, true, true, false}));
}

TEST(LightStripeSceneTest, MaximumRange) {
  // Central points lie 0.300, 0.339, 0.386 and 0.437 m from the camera 6 cm aside.
  LightStripeParams params = NoiselessParams();
  params.max_range_m = 0.36;
  EXPECT_EQ(CentreDetected(Seen(FlatWith({}), params)), (std::array{true, true, false, false}));
}

TEST(LightStripeSceneTest, FieldOfViewLimits) {
  // A lens of 12 mm sees 0.37 rad to each side; the farthest outer point lies at 0.62 rad.
  LightStripeParams params = NoiselessParams();
  params.focal_length_m = 0.012;
  const auto scan = Seen(FlatWith({}), params);
  EXPECT_FALSE(scan.points[3][0].detected);
  EXPECT_FALSE(scan.points[3][4].detected);
  EXPECT_TRUE(scan.points[3][2].detected);
}

TEST(LightStripeSceneTest, SensorInsideARockSeesNothing) {
  const auto rock = EllipsoidRock(0.3, 0, 0, 0.3, 0.5, 0.4);
  EXPECT_EQ(CountDetected(Seen(FlatWith({rock}))), 0);
}

}  // namespace
}  // namespace rockyard::sensing
