// Where light and shadow fall in the image.
#include <gtest/gtest.h>

#include <cmath>

#include "image_kit.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;

// Point of flat ground in the light plane of a laser whose image lies on a line.
Vector3 StripeOnLine(const LineView& line, const messages::StripeLaser& fan, int row_px) {
  const messages::Camera& camera = line.Camera(fan.camera);
  const Vector3 along(fan.normal_R.y(), -fan.normal_R.x(), 0.0);
  double near = 0.05;
  double far = 2.0;
  Vector3 point;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (near + far);
    point = Vector3(fan.p_RoE_R.x(), fan.p_RoE_R.y(), 0.0) + middle * along;
    const auto pixel = vision::Project(camera, camera.X_RC.inverse() * point);
    (!pixel || pixel->row_px > row_px ? near : far) = middle;
  }
  return point;
}

// Column, counted from the first one, about which a line's light lies.
double Centroid(const std::vector<double>& rates) {
  double sum = 0.0;
  double moment = 0.0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    sum += rates[i];
    moment += rates[i] * static_cast<double>(i);
  }
  EXPECT_GT(sum, 0.0);
  return moment / sum;
}

// Centroid of a stripe on a line of flat ground, against the projection of the point.
TEST(StripeImage, LiesWhereTheLightPlaneMeetsTheGround) {
  for (const auto lens :
       {messages::Lens::kEquidistantRows, messages::Lens::kEquidistant, messages::Lens::kPinhole}) {
    LightStripeParams params = QuietParams();
    params.lens = lens;
    // A stripe narrower than a pixel has a centroid that leans towards the pixel's middle.
    params.laser.beam_width_rad = 0.006;
    if (lens == messages::Lens::kPinhole) params.focal_length_m = 0.003;
    const LineView line{params, Darkness()};
    for (std::size_t laser = 0; laser < line.calibration.lasers.size(); ++laser) {
      const messages::StripeLaser& fan = line.calibration.lasers[laser];
      for (const int row_px : line.calibration.scanline_px) {
        const auto rates =
            LampRates(line.Render(FlatWith({}), PoseAt(2.0, -1.0, 0.0, 0.7), fan.camera, row_px),
                      static_cast<int>(laser));
        const messages::Camera& camera = line.Camera(fan.camera);
        const auto pixel =
            vision::Project(camera, camera.X_RC.inverse() * StripeOnLine(line, fan, row_px));
        ASSERT_TRUE(pixel.has_value());
        // What is left is the perspective across a stripe of some pixels.
        EXPECT_NEAR(Centroid(rates) - 384.0, pixel->column_px, 0.02) << laser << " " << row_px;
      }
    }
  }
}

// A surface that is higher shifts the stripe by the parallax of the baseline.
TEST(StripeImage, ShiftsWithElevation) {
  const LineView line{QuietParams(), Darkness()};
  const int row_px = line.calibration.scanline_px[1];
  const auto centre = [&](double drop_m) {
    return Centroid(LampRates(line.Render(FlatWith({}), PoseAt(0, 0, drop_m), 0, row_px), 2));
  };
  // Depth s in the scanline plane, baseline b: the column angle is atan(b / s).
  const messages::Camera& camera = line.Camera(0);
  const double depression = line.params.camera_pitch_rad + row_px * camera.row_pitch_rad;
  const auto column = [&](double height) {
    return std::atan(0.06 / (height / std::sin(depression))) / camera.column_pitch_rad;
  };
  EXPECT_NEAR(centre(-0.05) - centre(0.0), column(0.20) - column(0.25), 0.05);
  EXPECT_GT(centre(-0.05) - centre(0.0), 5.0);
}

// With the sun behind it, the rover's shadow ends where the front edge of its panel throws it.
TEST(RoverBody, CastsAShadow) {
  const SunParams sun{.elevation_rad = math::DegToRad(60.0), .azimuth_rad = math::DegToRad(180.0)};
  const rendering::SunLight light = rendering::MakeSunLight(sun, 40e-9);
  const rendering::RoverBody body = MakeRoverBody(rover::RoverGeometryParams{});
  const terrain::Terrain terrain = FlatWith({});
  const rendering::ImageScene scene(terrain, PoseAt(0, 0, 0), light, sun, body, 4.0);
  const double end_m = 0.325 + 0.30 / std::tan(sun.elevation_rad);
  for (const double beyond_m : {-0.005, 0.005}) {
    rendering::SurfacePoint point = scene.Meet(Vector3(end_m + beyond_m, 0.1, 0.1),
                                               -Vector3::UnitZ(), rendering::RoverBody::kFree, {});
    scene.Light({}, point);
    EXPECT_NEAR(point.radiance_w_m2_sr,
                rendering::SunRadiance(light, sun.ground_albedo, Vector3::UnitZ(), beyond_m > 0.0),
                1e-12);
  }
}

// A rock between an outer emitter and its stripe takes the light away, though the camera sees the
// ground beyond.
TEST(StripeImage, RockHidesTheEmitter) {
  const LineView line{QuietParams(), Darkness()};
  const messages::StripeLaser& fan = line.calibration.lasers[0];
  const int row_px = line.calibration.scanline_px[3];
  const Vector3 target = StripeOnLine(line, fan, row_px);
  const Vector3 between = fan.p_RoE_R + 0.6 * (target - fan.p_RoE_R);
  const terrain::Rock rock = EllipsoidRock(between.x(), between.y(), between.z(), 0.02, 0.02, 0.02);
  const auto lit_pixels = [&](const terrain::Terrain& terrain) {
    const auto rates = LampRates(line.Render(terrain, PoseAt(0, 0, 0), 0, row_px), 0);
    const auto pixel = vision::Project(line.Camera(0), line.Camera(0).X_RC.inverse() * target);
    const auto middle = static_cast<std::size_t>(std::lround(pixel->column_px) + 384);
    return rates[middle - 1] + rates[middle] + rates[middle + 1];
  };
  EXPECT_EQ(lit_pixels(FlatWith({rock})), 0.0);
  EXPECT_GT(lit_pixels(FlatWith({})), 0.0);
  // The camera still sees that ground.
  const Vector3 eye = line.Camera(0).X_RC.translation();
  EXPECT_FALSE(FlatWith({rock}).Occluded(eye, target, 0.001));
}

TEST(RoverBody, DistancesToItsParts) {
  const rover::RoverGeometryParams geometry;  // panel at 0.275 .. 0.30 m, wheels of 6.5 cm radius
  const rendering::RoverBody body = MakeRoverBody(geometry);
  EXPECT_NEAR(body.Distance({0.3, 0.0, 1.0}, -Vector3::UnitZ()), 0.7, 1e-12);
  EXPECT_NEAR(body.Normal({0.3, 0.0, 1.0}, -Vector3::UnitZ()).z(), 1.0, 1e-12);
  EXPECT_NEAR(body.Distance({0.3, 0.0, 0.2}, Vector3::UnitZ()), 0.075, 1e-12);
  // Front left wheel: centre at x = 0.26, y = 0.20, z = 0.065.
  EXPECT_NEAR(body.Distance({1.0, 0.2, 0.065}, -Vector3::UnitX()), 1.0 - 0.325, 1e-12);
  EXPECT_NEAR(body.Distance({0.26, 1.0, 0.065}, -Vector3::UnitY()), 0.76, 1e-12);
  EXPECT_EQ(body.Distance({1.0, 0.0, 0.05}, Vector3::UnitX()), rendering::RoverBody::kFree);
  // Out of a part that holds the origin.
  EXPECT_EQ(body.Distance({0.3, 0.0, 0.29}, Vector3::UnitX()), rendering::RoverBody::kFree);
}

// The default layout loses none of its scanlines to the rover's own parts, and no emitter is hidden
// from any point that it measures; a camera lower and further back does lose some.
TEST(RoverBody, LeavesTheDefaultLayoutFree) {
  const auto hidden_edges = [](const LightStripeParams& params) {
    const LineView line{params, Darkness()};
    int hidden = 0;
    for (int camera = 0; camera < 2; ++camera) {
      for (const int row_px : line.calibration.scanline_px) {
        for (const double distance_m : line.View(camera, row_px).body_m) {
          hidden += distance_m < rendering::RoverBody::kFree ? 1 : 0;
        }
      }
    }
    return hidden;
  };
  EXPECT_EQ(hidden_edges(LightStripeParams{}), 0);
  LightStripeParams low{.camera_x_m = 0.22, .camera_height_m = 0.17};
  EXPECT_GT(hidden_edges(low), 0);

  const LineView line{LightStripeParams{}, Darkness()};
  for (const messages::StripeLaser& fan : line.calibration.lasers) {
    for (const int row_px : line.calibration.scanline_px) {
      const Vector3 away = StripeOnLine(line, fan, row_px) - fan.p_RoE_R;
      EXPECT_EQ(line.body.Distance(fan.p_RoE_R, away.normalized()), rendering::RoverBody::kFree);
    }
  }
}

}  // namespace
}  // namespace rockyard::sensing
