// Stereo cameras down to images: their geometry, their mask, their noise.
#include "sensing/stereo_imager.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "rendering/picture/picture_renderer.h"
#include "rendering/picture/picture_scene.h"
#include "rendering/picture/terrain_look.h"
#include "sensing/rover_parts.h"
#include "sensing/stereo_view.h"
#include "stripe_scene.h"

namespace rockyard::sensing {
namespace {

using messages::LookDirection;

constexpr core::TrialKey kKey{7, 3};

StereoParams Images(std::int64_t level) {
  StereoParams params;
  params.fidelity = StereoFidelity::kImage;
  params.columns = 32;
  params.rows = 24;
  params.images.pyramid_level = level;
  return params;
}

StereoImager ImagerOf(const StereoParams& params, const rover::RoverGeometryParams& rover = {}) {
  return {params, {}, {}, rover, kKey};
}

// The point at depth Z on the ray of a pixel of the view, told by another formula, lands on that
// pixel of the reduced left image and f b / Z columns further left in the right one.
TEST(StereoImagerTest, CamerasSeeAsTheViewOfTheRangePointsDoes) {
  for (const std::int64_t level : {0, 2}) {
    const StereoParams params = Images(level);
    const StereoImager imager = ImagerOf(params);
    for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
      const StereoView view = MakeStereoView(params, direction);
      const vision::StereoRig& rig = imager.rig(direction);
      EXPECT_EQ(rig.left.size, (vision::ImageSize{32 << level, 24 << level}));
      const vision::CameraModel left = vision::Reduced(rig.left, 1 << level);
      const vision::CameraModel right = vision::Reduced(rig.right, 1 << level);
      for (const auto& [column, row] : {std::pair{0, 0}, {31, 23}, {10, 17}}) {
        const double depth_m = 0.7 + 0.1 * row;
        const math::Vector3 p_R = view.eye + depth_m * view.Ray(column, row);
        const vision::Pixel seen = *vision::Project(left, p_R);
        EXPECT_NEAR(seen.x(), column, 1e-9);
        EXPECT_NEAR(seen.y(), row, 1e-9);
        const vision::Pixel other = *vision::Project(right, p_R);
        EXPECT_NEAR(other.x(), column - view.focal_px * params.baseline_m / depth_m, 1e-9);
        EXPECT_NEAR(other.y(), row, 1e-9);
      }
    }
  }
}

// The renderer says which surface each pixel shows: the mask has to name the rover's own.
TEST(StereoImagerTest, TheMaskIsWhereAPictureShowsTheRover) {
  StereoParams params = Images(1);
  params.front.ahead_m = -0.2;  // behind the front of the body, above it
  params.front.height_m = 0.6;
  const rover::RoverGeometryParams rover;
  const StereoImager imager = ImagerOf(params, rover);
  const vision::StereoRig& rig = imager.rig(LookDirection::kAhead);
  const rendering::RoverBody body = MakeRoverBody(rover);
  const terrain::Terrain& terrain = Flat();
  // High above the ground: nothing stands between the camera and the rover's parts.
  const math::Transform X_WR = math::MakePose({0.0, 0.0, 1.0}, 0.0, 0.0, 0.0);
  const rendering::PictureScene scene(terrain, {}, {}, 200e-9, {&body, X_WR});
  const rendering::PixelRays rays(rig.left);
  rendering::TerrainLook look(terrain, {}, {}, kKey);
  rendering::Picture picture(rays.columns(), rays.rows());
  rendering::PictureRenderer(scene, {}, rays, X_WR).RenderRows(0, rays.rows(), look, picture);
  int hidden = 0;
  for (int row = 0; row < rays.rows(); ++row) {
    for (int column = 0; column < rays.columns(); ++column) {
      const bool rover_there = picture.surface.At(column, row) == rendering::SurfacePoint::kRover;
      EXPECT_EQ(rig.left_free.At(column, row) == 0, rover_there) << column << ", " << row;
      hidden += rover_there ? 1 : 0;
    }
  }
  EXPECT_GT(hidden, 100);
  EXPECT_LT(hidden, rays.columns() * rays.rows() - 100);
  EXPECT_FALSE(rig.left_free == rig.right_free);
}

double MeanDifference(const vision::GrayImage& a, const vision::GrayImage& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    sum += std::abs(a.values()[i] - b.values()[i]);
  }
  return sum / static_cast<double>(a.values().size());
}

TEST(StereoImagerTest, LooksRepeatBitForBitAndDifferInNoiseFromLookToLook) {
  const StereoImager imager = ImagerOf(Images(1));
  const auto see = [](const StereoImager& by, std::int64_t look,
                      LookDirection direction = LookDirection::kAhead) {
    return by.Expose(Flat(), PoseAt(0.0, 0.0, 0.0, 0.3), look, direction);
  };
  const StereoImages first = see(imager, 5);
  const StereoImages again = see(imager, 5);
  EXPECT_EQ(first.left, again.left);
  EXPECT_EQ(first.right, again.right);
  EXPECT_DOUBLE_EQ(first.exposure_s, again.exposure_s);
  const StereoImages next = see(imager, 6);
  const double noise = MeanDifference(first.left, next.left);
  EXPECT_GT(noise, 0.05);
  EXPECT_LT(noise, 3.0);  // the ground itself is the same
  // The two eyes and the two pairs see other ground.
  EXPECT_GT(MeanDifference(first.left, first.right), noise);
  EXPECT_GT(MeanDifference(first.left, see(imager, 5, LookDirection::kBehind).left), noise);
  // A camera that is noiseless shows the same in both looks, so that it was noise.
  StereoParams quiet = Images(1);
  quiet.images.camera.imager.ccd.full_well_e = 1e7;
  quiet.images.camera.imager.ccd.read_noise_e = 0.0;
  const StereoImager silent = ImagerOf(quiet);
  EXPECT_LT(MeanDifference(see(silent, 5).left, see(silent, 6).left), 0.5 * noise);
}

// A right camera that has turned by e shows what its axis looks at f e columns away: the pair is
// told as it was calibrated, and the disparities are wrong by some f e.
TEST(StereoImagerTest, ADriftedPairIsToldAsItWasCalibrated) {
  StereoParams params = Images(1);
  const StereoImager stiff = ImagerOf(params);
  params.images.drift.yaw_sd_rad = 0.01;
  const StereoImager drifted = ImagerOf(params);
  const math::Transform X_WR = math::Transform::Identity();
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    EXPECT_TRUE(stiff.rig(direction).right_free == drifted.rig(direction).right_free);
    EXPECT_EQ(std::get<vision::Cahv>(drifted.rig(direction).right.lens),
              std::get<vision::Cahv>(stiff.rig(direction).right.lens));
  }
  const auto shift_px = [&](LookDirection direction) {
    const vision::Image<float> a = stiff.TrueDisparities(Flat(), X_WR, direction);
    const vision::Image<float> b = drifted.TrueDisparities(Flat(), X_WR, direction);
    const int column = a.width() / 2;
    const int row = a.height() / 2;
    return static_cast<double>(b.At(column, row) - a.At(column, row));
  };
  const double deviation_px = 2.0 * params.focal_columns_px() * 0.01;
  const double ahead_px = shift_px(LookDirection::kAhead);
  const double behind_px = shift_px(LookDirection::kBehind);
  for (const double px : {ahead_px, behind_px}) {
    EXPECT_GT(std::abs(px), 1e-3 * deviation_px);
    EXPECT_LT(std::abs(px), 6.0 * deviation_px);
  }
  EXPECT_NE(ahead_px, behind_px);
  const StereoImages before = stiff.Expose(Flat(), X_WR, 0, LookDirection::kAhead);
  const StereoImages after = drifted.Expose(Flat(), X_WR, 0, LookDirection::kAhead);
  EXPECT_EQ(before.left, after.left);
  EXPECT_FALSE(before.right == after.right);
}

// All but brightest_share of the pixels are to lie below target_fill of the largest count.
TEST(StereoImagerTest, BothEyesAreExposedForTheTimeThatTheLeftOneAsksFor) {
  const StereoParams params = Images(1);
  const StereoImages images =
      ImagerOf(params).Expose(Flat(), math::Transform::Identity(), 0, LookDirection::kAhead);
  const double limit = 255.0 * params.images.camera.imager.exposure.target_fill;
  for (const vision::GrayImage* image : {&images.left, &images.right}) {
    int above = 0;
    double sum = 0.0;
    for (const std::uint8_t value : image->values()) {
      above += value > limit + 10.0 ? 1 : 0;
      sum += value;
    }
    EXPECT_LT(above, 0.02 * static_cast<double>(image->values().size()));
    EXPECT_GT(sum / static_cast<double>(image->values().size()), 0.4 * limit);
  }
  EXPECT_GT(images.exposure_s, params.images.camera.imager.exposure.shortest_s);
}

}  // namespace
}  // namespace rockyard::sensing
