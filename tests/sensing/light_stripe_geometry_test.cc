// What the light stripe sensor looks at and sees: its layout against what Matthies 1995 states,
// lenses and images that its cameras can work with, and scans computed by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/params_text.h"
#include "image_kit.h"
#include "rover/rover_layout_params.h"
#include "sensing/light_stripe.h"
#include "sensing/stripe_layout_params.h"
#include "sensing/stripe_scene.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::ElevationScan;
using messages::kStripeRows;
using messages::kStripes;
using messages::Lens;

// The sensor's layout against what Matthies 1995 states of it: table 3, section 6, figure 13's
// text.

// Where the row's scanline plane and the stripe's light plane meet the datum plane, in R.
Vector3 GroundPoint(const messages::StripeCalibration& calibration, std::size_t row,
                    std::size_t stripe) {
  const messages::StripeLaser& laser = calibration.lasers[stripe];
  const auto& camera = calibration.cameras[static_cast<std::size_t>(laser.camera)];
  const double angle = calibration.scanline_px[row] * camera.row_pitch_rad;
  const Vector3 scanline = camera.X_RC.linear() * Vector3(std::sin(angle), 0.0, std::cos(angle));
  Eigen::Matrix3d planes;
  planes.row(0) = scanline;
  planes.row(1) = laser.normal_R;
  planes.row(2) = Vector3::UnitZ();
  return planes.partialPivLu().solve(Vector3(scanline.dot(camera.X_RC.translation()),
                                             laser.normal_R.dot(laser.p_RoE_R),
                                             calibration.datum_z_m));
}

TEST(LightStripeGeometryTest, FieldsOfViewAreThoseOfAnFThetaLens) {
  const LightStripeParams rocky;
  EXPECT_NEAR(768 * rocky.column_pitch_rad(), 1.854, 5e-4);
  EXPECT_NEAR(484 * rocky.row_pitch_rad(), 1.375, 5e-4);
  LightStripeParams mfex{.focal_length_m = 0.004};
  // Table 3 rounds 2.225 x 1.65 rad to 2.2 x 1.6, and gives 2.9 x 3.4 mrad per pixel.
  EXPECT_NEAR(768 * mfex.column_pitch_rad(), 2.2, 0.03);
  EXPECT_NEAR(484 * mfex.row_pitch_rad(), 1.6, 0.051);
  EXPECT_NEAR(1e3 * mfex.column_pitch_rad(), 2.9, 0.05);
  EXPECT_NEAR(1e3 * mfex.row_pitch_rad(), 3.4, 0.05);
}

TEST(LightStripeGeometryTest, PointsLandWhereThePaperSays) {
  const auto calibration = TrueCalibration({});
  // "about 30 cm in front of the rover", half of its 65 cm length ahead of the centre.
  const Vector3 centre = GroundPoint(calibration, 3, 2);
  EXPECT_NEAR(centre.x() - 0.325, 0.30, 0.002);
  EXPECT_NEAR(centre.y(), 0.0, 1e-12);
  // "about 13 cm beyond each side", half of its 48 cm width from the centre line.
  EXPECT_NEAR(GroundPoint(calibration, 3, 0).y() - 0.24, 0.13, 0.002);
  EXPECT_NEAR(GroundPoint(calibration, 3, 4).y() + 0.24, -0.13, 0.002);
}

TEST(LightStripeGeometryTest, RowsAreRoundedToImageRows) {
  const LightStripeParams params;
  const auto calibration = TrueCalibration(params);
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    // Half a row moves the point by half a pitch times (h^2 + d^2) / h.
    const double d = params.front_x_m + params.row_ahead_m[row] - params.camera_x_m;
    const double h = params.camera_height_m;
    const double bound = 0.5 * params.row_pitch_rad() * (h * h + d * d) / h;
    EXPECT_NEAR(GroundPoint(calibration, row, 2).x(), params.front_x_m + params.row_ahead_m[row],
                1.01 * bound);
  }
}

TEST(LightStripeGeometryTest, BaselinesAreWithinTheTable) {
  const auto calibration = TrueCalibration({});
  EXPECT_NEAR(
      (calibration.cameras[0].X_RC.translation() - calibration.cameras[1].X_RC.translation())
          .norm(),
      0.12, 1e-12);
  for (const messages::StripeLaser& laser : calibration.lasers) {
    const auto& camera = calibration.cameras[static_cast<std::size_t>(laser.camera)];
    const double baseline = (camera.X_RC.translation() - laser.p_RoE_R).norm();
    EXPECT_GE(baseline, 0.05 - 1e-12);
    EXPECT_LE(baseline, 0.10 + 1e-12);
  }
}

// Seen from a camera, a point at depth s of the scanline plane on a ray that leaves the emitter,
// a baseline b aside, has tan(column) = b/s + const. One pixel is ds = s^2 / b / cos^2(column).
double DepthPerPixel(double depth_m, double baseline_m, double column_rad, double pitch_rad) {
  const double cosine = std::cos(column_rad);
  return depth_m * depth_m / baseline_m / (cosine * cosine) * pitch_rad;
}

class ResolutionTest : public testing::TestWithParam<double> {};

TEST_P(ResolutionTest, OnePixelIsTheClosedForm) {
  LightStripeParams params = NoiselessParams();
  params.camera_separation_m = 2.0 * GetParam();  // centre stripe: half of it is the baseline
  const LightStripe sensor(params);
  const perception::Triangulator triangulator(sensor.calibration());
  messages::StripeScan scan = sensor.Scan(FlatWith({}), PoseAt(0, 0, 0), {1, 0}, 0);
  const double column = scan.pixels[3][2].column_px;
  const double before = triangulator.Elevations(scan).points[3][2].elevation_m;
  scan.pixels[3][2].column_px = column + 1.0;
  const double after = triangulator.Elevations(scan).points[3][2].elevation_m;

  const double depression =
      params.camera_pitch_rad + sensor.calibration().scanline_px[3] * params.row_pitch_rad();
  const double depth = (params.camera_height_m - before) / std::sin(depression);
  const double expected =
      std::sin(depression) * DepthPerPixel(depth, GetParam(),
                                           (column + 0.5) * params.column_pitch_rad(),
                                           params.column_pitch_rad());
  EXPECT_NEAR(std::abs(after - before), expected, 0.03 * expected);
}

INSTANTIATE_TEST_SUITE_P(Baselines, ResolutionTest, testing::Values(0.05, 0.10));

std::vector<core::Problem> ProblemsOf(const std::string& json) {
  return core::ProblemsIn([&] { core::ReadText<LightStripeParams>(json); });
}

TEST(LightStripeParamsTest, DefaultsAreConsistent) {
  EXPECT_TRUE(ProblemsOf(R"({"fan_rad": 1.0})").empty());
}

TEST(LightStripeParamsTest, ImpossibleLayoutsAreErrors) {
  const auto blames = [](const std::string& json, const std::string& path) {
    return std::ranges::count(ProblemsOf(json), path, &core::Problem::path) > 0;
  };
  EXPECT_TRUE(blames(R"({"fan_rad": 0.3})", "fan_rad"));
  EXPECT_TRUE(blames(R"({"focal_length_m": 0.012})", "outer_stripe_y_m"));
  EXPECT_TRUE(blames(R"({"camera_pitch_deg": 0.0})", "camera_pitch_deg"));
  EXPECT_TRUE(blames(R"({"max_range_m": 0.4})", "max_range_m"));
  EXPECT_TRUE(blames(R"({"search_high_m": 0.26})", "search_high_m"));
  EXPECT_TRUE(blames(R"({"camera_x_m": 0.5})", "row_ahead_m"));
}

// Which lenses, images and layouts the cameras can work with.

void ExpectAccepted(const std::string& json) {
  LightStripeParams params;
  EXPECT_NO_THROW(core::ReadParams(core::ParseJson(json, "test"), params)) << json;
}

// Points of the array that a noiseless scan of flat ground finds.
std::size_t FoundOnFlatGround(const LightStripeParams& params) {
  const auto scan = LightStripe(params).Scan(FlatWith({}), PoseAt(0, 0, 0), {1, 0}, 0);
  std::size_t found = 0;
  for (const auto& pixel : scan.pixels.points()) found += pixel.detected;
  return found;
}

TEST(StripeViewTest, StripePointsAreImagedOnTheirRow) {
  for (const Lens lens : {Lens::kEquidistantRows, Lens::kEquidistant, Lens::kPinhole}) {
    LightStripeParams params{.lens = lens};
    const messages::StripeCalibration calibration = TrueCalibration(params);
    for (const messages::StripeLaser& laser : calibration.lasers) {
      const auto& camera = calibration.cameras[static_cast<std::size_t>(laser.camera)];
      for (const int row_px : calibration.scanline_px) {
        const auto point_R = StripePoint(calibration, laser, row_px);
        ASSERT_TRUE(point_R);
        EXPECT_NEAR(point_R->z(), calibration.datum_z_m, 1e-12);
        EXPECT_NEAR(laser.normal_R.dot(*point_R - laser.p_RoE_R), 0.0, 1e-12);
        const auto seen = vision::Project(camera, camera.X_RC.inverse() * *point_R);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->row_px, row_px, 1e-6);
      }
    }
  }
}

TEST(StripeViewTest, LensesWithoutDirectionsForTheCornersAreRefused) {
  // 8.9 x 6.6 mm: half of the width is 90 deg at 2.833 mm, the half diagonal 180 deg at 1.764 mm.
  for (const char* focal_m : {"0.0005", "0.001", "0.0013", "0.0016", "0.00176"}) {
    ExpectRefused(std::string(R"({"lens": "equidistant", "focal_length_m": )") + focal_m + "}",
                  "focal_length_m");
  }
  ExpectRefused(R"({"lens": "equidistant", "active_width_m": 0.1})", "focal_length_m");
  ExpectRefused(R"({"lens": "equidistant_rows", "focal_length_m": 0.00283})", "focal_length_m");
  for (const char* json : {R"({"lens": "equidistant", "focal_length_m": 0.00177})",
                           R"({"lens": "equidistant_rows", "focal_length_m": 0.00284})"}) {
    ExpectAccepted(json);
    LightStripeParams params = NoiselessParams();
    core::ReadParams(core::ParseJson(json, "test"), params);
    params.wrong_place_probability = 0.0;
    EXPECT_EQ(FoundOnFlatGround(params), 20U) << json;
  }
}

// Rows of 484 count from -242 to 241.
TEST(StripeViewTest, RowsEndWithTheImage) {
  const LightStripeParams defaults;
  const double nearest_rad = std::atan2(0.25, 0.325 + 0.10 - 0.27);
  const auto with_nearest_row_at = [&](double row_px) {
    const double pitch_rad = nearest_rad - row_px * defaults.row_pitch_rad();
    return R"({"camera_pitch_deg": )" + std::to_string(math::RadToDeg(pitch_rad)) + "}";
  };
  ExpectRefused(with_nearest_row_at(241.8), "camera_pitch_deg");
  ExpectAccepted(with_nearest_row_at(241.2));

  // A picture of the geometric sensor shows what of the five lines 239 to 243 is in the image.
  LightStripeParams params;
  core::ReadParams(core::ParseJson(with_nearest_row_at(241.2), "test"), params);
  const StripeImager imager(params, SunParams{}, rover::RoverGeometryParams{});
  const auto images = imager.Expose(FlatWith({}), PoseAt(0, 0, 0), {2, 9}, 0);
  const messages::ImageBand& nearest = images.exposures[0].lit[0];
  EXPECT_EQ(nearest.first_row, 239);
  EXPECT_EQ(nearest.rows, 3);
}

// A pinhole's image position grows with the slope, not with the angle: 8.9 mm at 4.8 mm see 42.8
// deg to each side, an f-theta lens 53.1 deg.
TEST(StripeViewTest, ColumnsAreCheckedByTheLens) {
  ExpectRefused(R"({"lens": "pinhole", "outer_stripe_y_m": 0.6})", "outer_stripe_y_m");
  ExpectAccepted(R"({"lens": "pinhole"})");
  ExpectAccepted(R"({"lens": "equidistant"})");
  ExpectAccepted(R"({"lens": "equidistant_rows", "outer_stripe_y_m": 0.6})");
  ExpectRefused(R"({"lens": "equidistant_rows", "outer_stripe_y_m": 0.9})", "outer_stripe_y_m");

  // What is refused would have found nothing of the outer stripes.
  LightStripeParams params = NoiselessParams();
  params.lens = Lens::kPinhole;
  EXPECT_EQ(FoundOnFlatGround(params), 20U);
  params.outer_stripe_y_m = 0.6;
  EXPECT_LT(FoundOnFlatGround(params), 20U);
}

TEST(StripeViewTest, HugeImagesAreRefused) {
  ExpectRefused(R"({"columns": 16384, "rows": 16384})", "columns");
  ExpectRefused(R"({"columns": 4097, "rows": 4096})", "columns");
  ExpectAccepted(R"({"columns": 4096, "rows": 4096})");
}

// The panel of Rocky 3.2 ends at x = 0.325 m and z = 0.30 m.
TEST(StripeViewTest, BodyHidesWhatLooksThroughIt) {
  const auto boxes_R = rover::BodyBoxes({});
  const auto is_hidden = [&](double x_m, double camera_height_m, double emitter_height_m) {
    LightStripeParams params;
    params.camera_x_m = params.emitter_x_m = x_m;
    params.camera_height_m = camera_height_m;
    params.emitter_height_m = emitter_height_m;
    return IsHiddenBy(params, boxes_R);
  };
  EXPECT_FALSE(is_hidden(0.27, 0.25, 0.25));
  EXPECT_TRUE(is_hidden(0.27, 0.40, 0.35));
  EXPECT_TRUE(is_hidden(0.27, 0.40, 0.25));
  EXPECT_TRUE(is_hidden(0.27, 0.25, 0.35));
  EXPECT_FALSE(is_hidden(0.33, 0.40, 0.35));  // ahead of it
  // 1 mm above the panel, where the ray to the nearest row falls by 3 m/m and that to the farthest
  // by 1 m/m: free from 0.3 mm behind its front edge on, hidden from 1 mm on.
  EXPECT_FALSE(is_hidden(0.3249, 0.301, 0.25));
  EXPECT_TRUE(is_hidden(0.31, 0.301, 0.25));
}

// A thin beam follows a scanline over raised ground only where both lie in one plane.
TEST(StripeViewTest, ThinBeamsTakeScanlinesThatArePlanes) {
  ExpectRefused(R"({"lens": "equidistant", "laser": {"fan": "three_scanlines"}})", "lens");
  ExpectAccepted(R"({"lens": "pinhole", "laser": {"fan": "three_scanlines"}})");
  ExpectAccepted(R"({"lens": "equidistant_rows", "laser": {"fan": "three_scanlines"}})");
}

// Hand-computed scans. In R the cameras and emitters sit at x = 0.27 m, z = 0.25 m; after rounding
// to image rows the four scanlines look down at 58.1845, 48.4182, 40.9307 and 35.2337 degrees and
// meet flat ground at x = 0.4251, 0.4918, 0.5583 and 0.6240 m.

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
  ExpectRows(Seen(FlatWith({EllipsoidRock(0.60, 0.09, 0, 0.05, 0.05, 0.2)})), {0, 0, 0, 0});
}

TEST(LightStripeSceneTest, TallRockOnAStripeIsSeenBelowItsTop) {
  auto scan = Seen(FlatWith({EllipsoidRock(0.625, 0, 0, 0.05, 0.05, 0.2)}));
  EXPECT_NEAR(scan.points[2][2].elevation_m, 0.0, HalfPixel_m(2));
  EXPECT_NEAR(scan.points[3][2].elevation_m, 0.03406, HalfPixel_m(3));
  scan = Seen(FlatWith({EllipsoidRock(0.50, 0, 0, 0.05, 0.05, 0.2)}));
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
  const auto hidden = Seen(FlatWith({EllipsoidRock(0.40, 0.10, 0, 0.02, 0.02, 0.2)}));
  EXPECT_FALSE(hidden.points[3][1].detected);
  EXPECT_TRUE(hidden.points[3][0].detected);
  // Too low to reach the line of sight.
  const auto seen = Seen(FlatWith({EllipsoidRock(0.40, 0.10, 0, 0.02, 0.02, 0.12)}));
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
    return Seen(FlatWith({EllipsoidRock(0.45, 0, top_m - 0.5, 0.02, 0.02, 0.5)}), params);
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
  EXPECT_EQ(CountDetected(Seen(FlatWith({EllipsoidRock(0.3, 0, 0, 0.3, 0.5, 0.4)}))), 0);
}

}  // namespace
}  // namespace rockyard::sensing
