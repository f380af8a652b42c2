// Chords along curved scanlines against the curve itself, and what the sensor makes of them.

#include <gtest/gtest.h>

#include <algorithm>

#include "sensing/stripe_layout_params.h"
#include "sensing/stripe_light.h"
#include "sensing/stripe_scene.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::Lens;

LightStripeParams WithLens(Lens lens, double focal_length_m) {
  LightStripeParams params = NoiselessParams();
  params.lens = lens;
  params.focal_length_m = focal_length_m;
  return params;
}

double DistanceToSegment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const double share = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - share * (b - a)).norm();
}

double DistanceToChords(const Vector3& p, const std::vector<Vector3>& vertices) {
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    nearest = std::min(nearest, DistanceToSegment(p, vertices[i], vertices[i + 1]));
  }
  return nearest;
}

struct Sensor {
  Lens lens;
  double focal_length_m;
};

class ScanCurveTest : public testing::TestWithParam<Sensor> {
 protected:
  LightStripeParams params_ = WithLens(GetParam().lens, GetParam().focal_length_m);
  messages::StripeCalibration calibration_ = TrueCalibration(params_);
};

TEST_P(ScanCurveTest, ChordsLieOnTheCurve) {
  for (std::size_t row = 0; row < calibration_.size().rows; ++row) {
    for (std::size_t stripe = 0; stripe < calibration_.size().stripes; ++stripe) {
      const ScanCurve curve(calibration_, row, stripe);
      ASSERT_GE(curve.vertices().size(), 2u);
      const auto& laser = calibration_.lasers[stripe];
      const auto& camera = calibration_.cameras[static_cast<std::size_t>(laser.camera)];
      const Vector3 eye_R = camera.X_RC.translation();
      // Densely along the searched part, a twentieth of a pixel apart.
      for (double column = curve.searched().first; column <= curve.searched().last;
           column += 0.05) {
        const Vector3 ray_R =
            camera.X_RC.linear() *
            vision::PixelRay(camera, {column, static_cast<double>(calibration_.scanline_px[row])});
        const Vector3 p_R =
            eye_R + laser.normal_R.dot(laser.p_RoE_R - eye_R) / laser.normal_R.dot(ray_R) * ray_R;
        EXPECT_LT(DistanceToChords(p_R, curve.vertices()), ScanCurve::kChordError_m)
            << row << " " << stripe << " " << column;
      }
      for (const Vector3& vertex_R : curve.vertices()) {
        EXPECT_NEAR(laser.normal_R.dot(vertex_R - laser.p_RoE_R), 0.0, 1e-9);
      }
      EXPECT_LE(curve.vertices().size(), 12u) << "what a scan costs";
    }
  }
}

TEST_P(ScanCurveTest, FlatGroundHasElevationZero) {
  const LightStripe sensor(params_);
  const perception::Triangulator triangulator(sensor.calibration());
  const auto scan = sensor.Scan(FlatWith({}), PoseAt(0, 0, 0), {1, 0}, 0);
  for (std::size_t row = 0; row < calibration_.size().rows; ++row) {
    for (std::size_t stripe = 0; stripe < calibration_.size().stripes; ++stripe) {
      const auto& pixel = scan.pixels[row][stripe];
      ASSERT_TRUE(pixel.detected) << row << " " << stripe;
      const double below = triangulator.Elevation(row, stripe, pixel.column_px - 0.6).elevation_m;
      const double above = triangulator.Elevation(row, stripe, pixel.column_px + 0.6).elevation_m;
      EXPECT_LT(std::min(below, above), 0.0) << row << " " << stripe;
      EXPECT_GT(std::max(below, above), 0.0) << row << " " << stripe;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sensors, ScanCurveTest,
                         testing::Values(Sensor{Lens::kEquidistant, 0.0048},
                                         Sensor{Lens::kEquidistant, 0.0040},
                                         Sensor{Lens::kPinhole, 0.0048},
                                         Sensor{Lens::kEquidistantRows, 0.0048}));

TEST(ScanCurveTest, RowsOfPlanesAreStraight) {
  for (const Lens lens : {Lens::kPinhole, Lens::kEquidistantRows}) {
    EXPECT_EQ(ScanCurve(TrueCalibration(WithLens(lens, 0.0048)), 3, 0).vertices().size(), 2u);
  }
  // Negative control: a radially symmetric lens bends them by more than a chord's error.
  const auto calibration = TrueCalibration(WithLens(Lens::kEquidistant, 0.0048));
  EXPECT_GT(ScanCurve(calibration, 3, 0).vertices().size(), 2u);
}

// Rows of lenses that see behind themselves meet the light plane in several stretches: the curve is
// the one in front, without the gaps between.
TEST(ScanCurveTest, TakesOneStretchOfSeveral) {
  const auto calibration = TrueCalibration(WithLens(Lens::kEquidistant, 0.0018));
  for (std::size_t row = 0; row < calibration.size().rows; ++row) {
    for (std::size_t stripe = 0; stripe < calibration.size().stripes; ++stripe) {
      const ScanCurve curve(calibration, row, stripe);
      const auto ground_R =
          StripePoint(calibration, calibration.lasers[stripe], calibration.scanline_px[row]);
      ASSERT_TRUE(ground_R);
      EXPECT_LT(DistanceToChords(*ground_R, curve.vertices()), ScanCurve::kChordError_m)
          << row << " " << stripe;
    }
  }
  // Views that wrap around, which parameters refuse, have curves, too.
  for (const double focal_length_m : {0.0005, 0.001, 0.0013, 0.0016}) {
    const auto wrapped = TrueCalibration(WithLens(Lens::kEquidistant, focal_length_m));
    for (std::size_t stripe = 0; stripe < wrapped.size().stripes; ++stripe) {
      EXPECT_GE(ScanCurve(wrapped, 0, stripe).vertices().size(), 2u) << focal_length_m;
    }
  }
}

// The chords of separable rows find what the straight path of the sensor finds.
TEST(ScanCurveTest, AgreesWithStraightLines) {
  const LightStripe sensor(NoiselessParams());
  const terrain::Terrain terrain = FlatWith({EllipsoidRock(0.5, 0.05, 0.0, 0.1, 0.1, 0.08)});
  const auto scan = sensor.Scan(terrain, PoseAt(0, 0, 0), {1, 0}, 0);
  const std::vector<int> rocks{0};
  int on_rock = 0;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t stripe = 0; stripe < 5; ++stripe) {
      const ScanCurve curve(sensor.calibration(), row, stripe);
      const auto hit_W = curve.FirstHit(terrain, PoseAt(0, 0, 0), rocks);
      ASSERT_TRUE(hit_W);
      on_rock += hit_W->z() > 0.01;
      if (!scan.pixels[row][stripe].detected) continue;  // hidden from the camera
      const auto& camera =
          sensor.calibration()
              .cameras[static_cast<std::size_t>(sensor.calibration().lasers[stripe].camera)];
      const auto seen = vision::Project(camera, camera.X_RC.inverse() * *hit_W);
      ASSERT_TRUE(seen);
      EXPECT_NEAR(seen->column_px, scan.pixels[row][stripe].column_px, 0.51);
      EXPECT_NEAR(seen->row_px, sensor.calibration().scanline_px[row], 0.01);
      EXPECT_NEAR(curve.searched().first, sensor.searched(row, stripe).first, 1.0);
      EXPECT_NEAR(curve.searched().last, sensor.searched(row, stripe).last, 1.0);
    }
  }
  EXPECT_GE(on_rock, 2);
}

}  // namespace
}  // namespace rockyard::sensing
