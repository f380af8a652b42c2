// Triangulation by hand: one camera at the origin of R looking along x, one light plane beside it.
#include "perception/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rockyard::perception {
namespace {

using math::Vector3;

// Light plane parallel to the optical axis, 0.1 m to the left.
messages::StripeCalibration Parallel() {
  messages::StripeCalibration calibration;
  for (auto& camera : calibration.cameras) {
    camera.column_pitch_rad = 0.001;
    camera.row_pitch_rad = 0.001;
  }
  calibration.lasers.resize(messages::kStripes);
  for (auto& laser : calibration.lasers) {
    laser.p_RoE_R = Vector3(0.0, 0.1, 0.0);
    laser.normal_R = Vector3::UnitY();
  }
  calibration.scanline_px = {600, 500, 400, 300};
  return calibration;
}

messages::ElevationScan ElevationsAt(const messages::StripeCalibration& calibration,
                                     double column_px) {
  messages::StripeScan scan;
  scan.number = 12;
  for (messages::StripePixel& pixel : scan.pixels.points()) {
    pixel = {.detected = true, .column_px = column_px};
  }
  return Triangulator(calibration).Elevations(scan);
}

TEST(TriangulationTest, ElevationOfAKnownPoint) {
  // Column -200 looks 0.2 rad to the left: depth 0.1 / tan(0.2), elevation -depth sin(row angle).
  const auto scan = ElevationsAt(Parallel(), -200.0);
  EXPECT_EQ(scan.number, 12);
  const double depth = 0.1 / std::tan(0.2);
  EXPECT_NEAR(scan.points[0][0].elevation_m, -depth * std::sin(0.6), 1e-12);
  EXPECT_NEAR(scan.points[3][4].elevation_m, -depth * std::sin(0.3), 1e-12);
}

TEST(TriangulationTest, CountsFromTheDatumPlane) {
  auto calibration = Parallel();
  calibration.datum_z_m = -0.2;
  const double above = ElevationsAt(calibration, -200.0).points[0][0].elevation_m;
  EXPECT_NEAR(above - ElevationsAt(Parallel(), -200.0).points[0][0].elevation_m, 0.2, 1e-12);
}

TEST(TriangulationTest, RaysThatMeetTheLightBehindOrNowhereAreNoDetections) {
  EXPECT_FALSE(ElevationsAt(Parallel(), 200.0).points[1][1].detected);
  EXPECT_FALSE(ElevationsAt(Parallel(), 0.0).points[1][1].detected);
}

TEST(TriangulationTest, UsesTheCameraOfTheStripe) {
  auto calibration = Parallel();
  calibration.cameras[1].X_RC.translation() = Vector3(0.0, 0.05, 0.3);
  calibration.lasers[2].camera = 1;
  const auto scan = ElevationsAt(calibration, -200.0);
  EXPECT_NEAR(scan.points[0][2].elevation_m, 0.3 - 0.05 / std::tan(0.2) * std::sin(0.6), 1e-12);
  EXPECT_NEAR(scan.points[0][1].elevation_m, -0.1 / std::tan(0.2) * std::sin(0.6), 1e-12);
}

// The short form for planar scanlines against rays that meet light planes in space.
TEST(TriangulationTest, ElevationIsThatOfThePoint) {
  messages::StripeCalibration calibration = Parallel();
  calibration.datum_z_m = 0.03;
  for (auto& camera : calibration.cameras) {
    camera.X_RC.translation() = Vector3(0.27, -0.06, 0.25);
    camera.X_RC.linear() =
        (Eigen::AngleAxisd(0.1, Vector3::UnitZ()) * Eigen::AngleAxisd(0.7, Vector3::UnitY()))
            .toRotationMatrix();
  }
  calibration.lasers[1].normal_R = Vector3(0.3, 0.9, 0.1).normalized();
  for (const auto lens : {messages::Lens::kEquidistantRows, messages::Lens::kEquidistant}) {
    for (auto& camera : calibration.cameras) camera.lens = lens;
    const Triangulator triangulator(calibration);
    for (double column = -380.0; column <= 380.0; column += 20.0) {
      const auto point = triangulator.Point(2, 1, column);
      const auto elevation = triangulator.Elevation(2, 1, column);
      ASSERT_EQ(elevation.detected, point.has_value());
      if (point) {
        // Relative to the distance: rays that hardly meet the light plane meet it far away.
        EXPECT_NEAR(elevation.elevation_m, point->z() - 0.03, 1e-12 * (1.0 + point->norm()));
      }
    }
  }
}

TEST(TriangulationTest, MissingStaysMissing) {
  const auto scan = Triangulator(Parallel()).Elevations({});
  for (const auto& point : scan.points.points()) EXPECT_FALSE(point.detected);
}

}  // namespace
}  // namespace rockyard::perception
