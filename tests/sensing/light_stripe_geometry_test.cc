// The sensor's layout against what Matthies 1995 states of it: table 3, section 6, figure 13's
// text.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/params_text.h"
#include "sensing/stripe_layout_params.h"
#include "sensing/stripe_scene.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::kStripeRows;

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

}  // namespace
}  // namespace rockyard::sensing
