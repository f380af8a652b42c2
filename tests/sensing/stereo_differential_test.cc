// Stereo images against plain ray casting, in random fields and at random poses.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "sensing/stereo_depth.h"
#include "stereo_scene.h"

namespace rockyard::sensing {
namespace {

// The same image as StereoScene, pixel by pixel through the terrain's own ray casting.
DepthImage ReferenceInverseDepths(const terrain::Terrain& terrain, const StereoView& view_W,
                                  double max_range_m) {
  DepthImage image = DepthImage::Zero(view_W.rows, view_W.columns);
  for (int row = 0; row < view_W.rows; ++row) {
    for (int column = 0; column < view_W.columns; ++column) {
      const math::Vector3 ray_W = view_W.Ray(column, row);
      const auto hit = terrain.CastRay(view_W.eye, ray_W.normalized(), max_range_m);
      if (hit && hit->distance_m > 0.0) image(row, column) = ray_W.norm() / hit->distance_m;
    }
  }
  return image;
}

void ReferenceHideFromRightEye(const terrain::Terrain& terrain, const StereoView& view_W,
                               DepthImage& image) {
  constexpr double kMargin_m = 0.0005;
  for (int row = 0; row < view_W.rows; ++row) {
    for (int column = 0; column < view_W.columns; ++column) {
      double& pixel = image(row, column);
      if (pixel <= 0.0) continue;
      const math::Vector3 p_W = view_W.eye + view_W.Ray(column, row) / pixel;
      // The image begins half a pixel left of the middle of its first column.
      const bool outside = view_W.focal_px * view_W.baseline_m * pixel > column + 0.5;
      if (outside || terrain.Occluded(view_W.right_eye, p_W, kMargin_m)) pixel = 0.0;
    }
  }
}

struct Scene {
  terrain::Terrain terrain;
  math::Transform X_WR;
  messages::LookDirection direction;
};

// Rocks of all sizes, some beside and above the cameras, sloping ground, and walls.
Scene RandomScene(std::uint32_t number, bool rough) {
  using core::SampleUniform;
  core::RandomStream stream({20260501, 0}, core::Purpose::kTest, number);
  terrain::GroundParams ground{.slope_rad = SampleUniform(stream, 0.0, 0.25),
                               .slope_direction_rad = SampleUniform(stream, -3.0, 3.0)};
  if (rough) ground.roughness_rms_m = 0.03;
  const terrain::Ground surface(ground, {1, number});
  std::vector<terrain::Rock> rocks;
  for (int i = 0; i < 60; ++i) {
    const double a = SampleUniform(stream, 0.02, i < 5 ? 0.6 : 0.2);
    const double x = SampleUniform(stream, -4.0, 4.0);
    const double y = SampleUniform(stream, -4.0, 4.0);
    const double b = a * SampleUniform(stream, 0.6, 1.0);
    const double c = a * SampleUniform(stream, 0.4, 1.2);
    const double z = surface.Height(x, y) + c * SampleUniform(stream, -0.5, 0.4);
    rocks.push_back(EllipsoidRock(x, y, z, a, b, c, SampleUniform(stream, 0.0, 3.1)));
  }
  const double side = SampleUniform(stream, 1.0, 3.0);
  std::vector<terrain::Wall> walls{{math::Vector3::UnitY(), side}, {-math::Vector3::UnitX(), 2.0}};
  const double x = SampleUniform(stream, -0.5, 0.5);
  const double y = SampleUniform(stream, -0.3, 0.3);
  const double heading = SampleUniform(stream, -3.1, 3.1);
  const double pitch = SampleUniform(stream, -0.3, 0.3);
  const double roll = SampleUniform(stream, -0.3, 0.3);
  return {{surface, std::move(rocks), std::move(walls)},
          math::MakePose({x, y, surface.Height(x, y) + 0.05}, heading, pitch, roll),
          number % 2 == 0 ? messages::LookDirection::kAhead : messages::LookDirection::kBehind};
}

struct Tally {
  int pixels = 0;
  int shown = 0;
  int hidden = 0;  // seen by the left eye alone
  int differ = 0;  // depth of the left eye by more than 1e-9 m, or shown and not
  int hiding_differs = 0;
};

Tally Compare(int scenes, bool rough, const StereoParams& params, double range_m) {
  Tally tally;
  for (int number = 0; number < scenes; ++number) {
    const Scene scene = RandomScene(static_cast<std::uint32_t>(number), rough);
    const StereoView view_W = MakeStereoView(params, scene.direction).From(scene.X_WR);
    const StereoScene fast(scene.terrain, view_W, params.max_range_m);
    DepthImage actual = fast.InverseDepths();
    DepthImage expected = ReferenceInverseDepths(scene.terrain, view_W, range_m);
    const auto shown = actual > 0.0 && expected > 0.0;
    const DepthImage apart_m = shown.select(actual.inverse() - expected.inverse(),
                                            DepthImage::Zero(view_W.rows, view_W.columns));
    tally.pixels += static_cast<int>(actual.size());
    tally.shown += static_cast<int>((expected > 0.0).count());
    tally.differ +=
        static_cast<int>(((actual > 0.0) != (expected > 0.0) || apart_m.abs() > 1e-9).count());
    const DepthImage left = expected;
    actual = left;
    fast.HideFromRightEye(actual);
    ReferenceHideFromRightEye(scene.terrain, view_W, expected);
    tally.hidden += static_cast<int>((left > 0.0 && expected == 0.0).count());
    tally.hiding_differs += static_cast<int>(((actual > 0.0) != (expected > 0.0)).count());
  }
  return tally;
}

StereoParams SmallImage() { return StereoParams{.columns = 96, .rows = 64}; }

TEST(StereoDifferentialTest, AgreesWithPlainRayCastingOnPlaneGround) {
  const Tally tally = Compare(60, false, SmallImage(), 4.0);
  EXPECT_GT(tally.shown, tally.pixels / 2);
  EXPECT_GT(tally.hidden, 5000);
  EXPECT_EQ(tally.differ, 0);
  // Points that a rock's limb hides by just the margin.
  EXPECT_LE(tally.hiding_differs, 2);
}

TEST(StereoDifferentialTest, AgreesWithPlainRayCastingOnRoughGround) {
  const Tally tally = Compare(6, true, SmallImage(), 4.0);
  EXPECT_GT(tally.shown, tally.pixels / 2);
  EXPECT_EQ(tally.differ, 0);
  EXPECT_GT(tally.hidden, 500);
  EXPECT_LE(tally.hiding_differs, tally.hidden / 20);
}

TEST(StereoDifferentialTest, TellsAnImageWithAnotherRange) {
  // Negative control: one millimetre of range shows.
  EXPECT_GT(Compare(6, false, SmallImage(), 3.999).differ, 0);
}

}  // namespace
}  // namespace rockyard::sensing
