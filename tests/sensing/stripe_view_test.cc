// Which lenses, images and layouts the cameras can work with.
#include <gtest/gtest.h>

#include <cmath>

#include "image_kit.h"
#include "rover/rover_layout_params.h"
#include "sensing/light_stripe.h"
#include "sensing/stripe_layout_params.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using messages::Lens;

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

}  // namespace
}  // namespace rockyard::sensing
