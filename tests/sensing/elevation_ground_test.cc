// What sensors see of an elevation model against the analytic ground that was sampled to it, at
// three cells: within the error of the interpolation, which elevation_model.h states.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "math/pose.h"
#include "sensing/light_stripe.h"
#include "sensing/stereo_imager.h"
#include "stereo_scene.h"
#include "stripe_scene.h"
#include "terrain/analytic_ground.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using terrain::AnalyticGround;
using terrain::AnalyticGrounds;

constexpr std::array kCells_m{0.25, 0.125, 0.0625};

terrain::Terrain On(const AnalyticGround& ground, double cell_m) {
  return {terrain::GroundOn(terrain::Sampled(ground.height, cell_m)), {}, {}};
}

// A rover that stands near the middle of the model, tilted a little against the ground.
math::Transform Stance(const AnalyticGround& ground) {
  return math::MakePose({1.0, 0.3, ground.height(1.0, 0.3) + 0.02}, 0.4, 0.05, -0.03);
}

TEST(ElevationGround, RangesOfStereoLieOnTheAnalyticGround) {
  for (const AnalyticGround& ground : AnalyticGrounds()) {
    for (const double cell_m : kCells_m) {
      const math::Transform X_WR = Stance(ground);
      int seen = 0;
      double worst_m = 0.0;
      for (const Vector3& p_R : LookAhead(IdealStereo(), On(ground, cell_m), X_WR).points_R) {
        const Vector3 p_W = X_WR * p_R;
        if (std::abs(p_W.y()) > 2.5 || p_W.x() > 5.5) continue;
        ++seen;
        worst_m = std::max(worst_m, std::abs(p_W.z() - ground.height(p_W.x(), p_W.y())));
      }
      EXPECT_GT(seen, 1000) << ground.name;
      EXPECT_LE(worst_m, ground.Bound_m(cell_m) + 1e-9) << ground.name << ' ' << cell_m;
    }
  }
}

// How far a point of a light plane, on the viewing ray of a column, lies above the analytic ground.
class StripeGap {
 public:
  StripeGap(const LightStripe& sensor, std::size_t row, std::size_t stripe,
            const math::Transform& X_WR, const terrain::HeightAt& height)
      : laser_(sensor.calibration().lasers[stripe]),
        camera_(sensor.calibration().cameras[static_cast<std::size_t>(laser_.camera)]),
        scanline_px_(static_cast<double>(sensor.calibration().scanline_px[row])),
        X_WR_(X_WR),
        height_(height) {}

  double operator()(double column_px) const {
    const Vector3 ray =
        camera_.X_RC.linear() * vision::PixelRay(camera_, {column_px, scanline_px_});
    const Vector3 eye = camera_.X_RC.translation();
    const double along = laser_.normal_R.dot(laser_.p_RoE_R - eye) / laser_.normal_R.dot(ray);
    const Vector3 p_W = X_WR_ * Vector3(eye + along * ray);
    return p_W.z() - height_(p_W.x(), p_W.y());
  }

 private:
  const messages::StripeLaser& laser_;
  const messages::Camera& camera_;
  double scanline_px_;
  const math::Transform& X_WR_;
  const terrain::HeightAt& height_;
};

// A stripe is found in a whole column: within half of one the analytic ground crosses its plane.
TEST(ElevationGround, LightStripesLieOnTheAnalyticGround) {
  const LightStripe sensor(NoiselessParams());
  for (const AnalyticGround& ground : AnalyticGrounds()) {
    for (const double cell_m : kCells_m) {
      const math::Transform X_WR = Stance(ground);
      const auto scan = sensor.Scan(On(ground, cell_m), X_WR, {1, 0}, 0);
      const double bound_m = ground.Bound_m(cell_m) + 1e-9;
      int found = 0;
      for (std::size_t row = 0; row < messages::kStripeRows; ++row) {
        for (std::size_t stripe = 0; stripe < messages::kStripes; ++stripe) {
          const messages::StripePixel& pixel = scan.pixels[row][stripe];
          if (!pixel.detected) continue;
          ++found;
          const StripeGap gap(sensor, row, stripe, X_WR, ground.height);
          const auto [low, high] =
              std::minmax(gap(pixel.column_px - 0.5), gap(pixel.column_px + 0.5));
          EXPECT_LE(low, bound_m) << ground.name << ' ' << row << ' ' << stripe;
          EXPECT_GE(high, -bound_m) << ground.name << ' ' << row << ' ' << stripe;
        }
      }
      EXPECT_GE(found, 12) << ground.name;
    }
  }
}

// Nearer than 1.5 m, where the pictures show the model and not what lies beyond its edges.
float LargestDifference(const vision::Image<float>& a, const vision::Image<float>& b,
                        float nearer_px, int& both) {
  float largest = 0.0f;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const float difference = std::abs(a.values()[i] - b.values()[i]);
    if (std::isnan(difference) || a.values()[i] < nearer_px) continue;
    ++both;
    largest = std::max(largest, difference);
  }
  return largest;
}

// Pictures of a plane that was sampled are those of the plane. On hills disparities come nearer to
// those of a fine model as fast as the heights do, until the last bits of float.
TEST(ElevationGround, DisparitiesOfPicturesAreThoseOfTheAnalyticGround) {
  StereoParams params;
  params.fidelity = StereoFidelity::kImage;
  const StereoImager imager(params, {}, {}, {}, {1, 0});
  const auto disparities = [&](const terrain::Terrain& terrain, const math::Transform& X_WR) {
    return imager.TrueDisparities(terrain, X_WR, messages::LookDirection::kAhead);
  };
  const double focal_px =
      0.5 * static_cast<double>(params.image_columns()) / std::tan(0.5 * params.horizontal_fov_rad);
  const auto nearer_px = static_cast<float>(focal_px * params.baseline_m / 1.5);
  int both = 0;
  const AnalyticGround plane = AnalyticGrounds().front();
  const terrain::GroundParams slope{.slope_rad = std::atan(std::hypot(0.15, 0.1)),
                                    .slope_direction_rad = std::atan2(-0.1, 0.15)};
  EXPECT_LT(LargestDifference(disparities(On(plane, 0.25), Stance(plane)),
                              disparities({terrain::Ground(slope, {}), {}, {}}, Stance(plane)),
                              nearer_px, both),
            1e-4f);
  EXPECT_GT(both, 10000);

  const AnalyticGround hills = AnalyticGrounds().back();
  const vision::Image<float> fine = disparities(On(hills, 1.0 / 32.0), Stance(hills));
  std::vector<float> errors_px;
  for (const double cell_m : {0.5, 0.25, 0.125}) {
    errors_px.push_back(
        LargestDifference(disparities(On(hills, cell_m), Stance(hills)), fine, nearer_px, both));
  }
  EXPECT_GT(errors_px[0], 0.05f) << "a control: coarse models differ";
  EXPECT_GT(errors_px[0] / errors_px[1], 8.0f);
  EXPECT_GT(errors_px[1] / errors_px[2], 8.0f);
}

}  // namespace
}  // namespace rockyard::sensing
