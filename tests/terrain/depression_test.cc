// Ditches and pits against closed forms, finite differences and rays sampled finely.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "math/angles.h"
#include "terrain/ground.h"
#include "terrain/relief.h"

namespace rockyard::terrain {
namespace {

using math::Vector3;

constexpr core::TrialKey kKey{5, 1};

// A ditch 0.5 m wide, 0.3 m deep and 4 m long along y at x = 2, and a pit with a floor.
GroundParams DitchAndPit() {
  return GroundParams{
      .ditches = {.x_m = {2.0},
                  .y_m = {0.5},
                  .direction_deg = {90.0},
                  .length_m = {4.0},
                  .width_m = {0.5},
                  .depth_m = {0.3},
                  .flank_m = {0.2}},
      .pits = {
          .x_m = {-1.0}, .y_m = {-1.0}, .diameter_m = {1.2}, .depth_m = {0.25}, .flank_m = {0.4}}};
}

TEST(DepressionTest, DitchIsAsDeepAndWideAsListed) {
  const Ground ground(DitchAndPit(), kKey);
  EXPECT_FALSE(ground.IsPlane());
  EXPECT_DOUBLE_EQ(ground.Height(2.0, 0.5), -0.3);
  EXPECT_DOUBLE_EQ(ground.Height(2.04, 1.7), -0.3);     // the floor is 0.1 m wide
  EXPECT_NEAR(ground.Height(2.15, 0.5), -0.15, 1e-12);  // half way up the flank
  EXPECT_NEAR(ground.Height(1.85, 0.5), -0.15, 1e-12);
  EXPECT_EQ(ground.Height(2.25, 0.5), 0.0);
  EXPECT_EQ(ground.Height(1.75, 0.5), 0.0);
  // Its round ends reach from y = -1.5 to 2.5 m.
  EXPECT_EQ(ground.Height(2.0, 2.51), 0.0);
  EXPECT_LT(ground.Height(2.0, 2.45), 0.0);
  EXPECT_NEAR(ground.Height(2.0, 2.25 + 0.15), -0.15, 1e-12);
  EXPECT_EQ(ground.Height(2.0, -1.51), 0.0);
  EXPECT_LT(ground.Height(2.0, -1.45), 0.0);
}

TEST(DepressionTest, IsNearADiscThatItReachesInto) {
  const Ground ground(DitchAndPit(), kKey);
  for (const double radius_m : {0.0, 0.1, 1.0}) {
    EXPECT_TRUE(ground.HasDepressionNear(2.0 + 0.24 + radius_m, 0.5, radius_m)) << radius_m;
    EXPECT_FALSE(ground.HasDepressionNear(2.0 + 0.26 + radius_m, 0.5, radius_m)) << radius_m;
    EXPECT_TRUE(ground.HasDepressionNear(-1.0, -1.0 - 0.59 - radius_m, radius_m)) << radius_m;
    EXPECT_FALSE(ground.HasDepressionNear(-1.0, -1.0 - 0.61 - radius_m, radius_m)) << radius_m;
  }
}

TEST(DepressionTest, DirectionTurnsFromXTowardsY) {
  GroundParams params = DitchAndPit();
  params.ditches.direction_deg = {30.0};
  const Ground ground(params, kKey);
  const double c = std::cos(math::DegToRad(30.0));
  EXPECT_DOUBLE_EQ(ground.Height(2.0 + 1.5 * c, 0.5 + 1.5 * 0.5), -0.3);
  EXPECT_EQ(ground.Height(2.0 + 1.5 * c, 0.5 - 1.5 * 0.5), 0.0);
}

TEST(DepressionTest, DitchWithoutAnEndGoesOn) {
  GroundParams params = DitchAndPit();
  params.ditches.length_m = {0.0};
  const Ground ground(params, kKey);
  EXPECT_NEAR(ground.Height(2.0, 900.0), -0.3, 1e-9);
  EXPECT_NEAR(ground.Height(2.0, -900.0), -0.3, 1e-9);
}

TEST(DepressionTest, FlanksWithoutAListMeetInTheMiddle) {
  GroundParams params = DitchAndPit();
  params.ditches.flank_m.clear();
  const Ground ground(params, kKey);
  EXPECT_DOUBLE_EQ(ground.Height(2.0, 0.5), -0.3);
  EXPECT_NEAR(ground.Height(2.125, 0.5), -0.15, 1e-12);
}

// V = 2 pi D (r0^2/2 + r0 e/2 + e^2/7) with the floor's radius r0 and the flank e.
TEST(DepressionTest, VolumeOfAPit) {
  const Ground ground(DitchAndPit(), kKey);
  constexpr double kStep_m = 0.002;
  double volume_m3 = 0.0;
  for (double x = -1.6 + 0.5 * kStep_m; x < -0.4; x += kStep_m) {
    for (double y = -1.6 + 0.5 * kStep_m; y < -0.4; y += kStep_m) {
      volume_m3 -= kStep_m * kStep_m * ground.Height(x, y);
    }
  }
  const double expected_m3 =
      2.0 * std::numbers::pi * 0.25 * (0.2 * 0.2 / 2.0 + 0.2 * 0.4 / 2.0 + 0.4 * 0.4 / 7.0);
  EXPECT_NEAR(volume_m3, expected_m3, 1e-6);
}

TEST(DepressionTest, TheDeepestCountsWhereTwoCross) {
  GroundParams params = DitchAndPit();
  params.pits.x_m = {2.0};
  params.pits.y_m = {0.5};
  const Ground both(params, kKey);
  EXPECT_DOUBLE_EQ(both.Height(2.0, 0.5), -0.3);    // ditch 0.3 m, pit 0.25 m
  EXPECT_NEAR(both.Height(2.2, 0.5), -0.25, 1e-3);  // the pit's floor ends here
  EXPECT_LT(both.Normal(2.2, 0.5).head<2>().norm(), 1e-9);
}

TEST(DepressionTest, SlopeAndRoughnessGoOnBelow) {
  GroundParams params = DitchAndPit();
  params.slope_rad = 0.1;
  params.roughness_rms_m = 0.02;
  GroundParams whole = params;
  whole.ditches = {};
  whole.pits = {};
  EXPECT_NEAR(Ground(params, kKey).Height(2.0, 0.7), Ground(whole, kKey).Height(2.0, 0.7) - 0.3,
              1e-12);
}

// Normals are those of the heights; bounds hold and are reached, to the grid of the search.
TEST(DepressionTest, SlopesAndBoundsAgreeWithHeights) {
  const GroundParams params = DitchAndPit();
  const DepressionField field(ListDepressions(params.ditches, params.pits));
  constexpr double kStep_m = 1e-5;
  double steepest = 0.0;
  double most_bent_per_m = 0.0;
  core::RandomStream stream({3, 0}, core::Purpose::kTest, 1);
  for (int i = 0; i < 60000; ++i) {
    const bool pit = i % 2 == 0;
    const double x = core::SampleUniform(stream, pit ? -1.7 : 1.7, pit ? -0.3 : 2.3);
    const double y = core::SampleUniform(stream, pit ? -1.7 : -1.6, pit ? -0.3 : 2.6);
    const ReliefSample at = field.Sample(x, y);
    const ReliefSample right = field.Sample(x + kStep_m, y);
    const ReliefSample left = field.Sample(x - kStep_m, y);
    const ReliefSample up = field.Sample(x, y + kStep_m);
    const ReliefSample down = field.Sample(x, y - kStep_m);
    ASSERT_NEAR((right.height_m - left.height_m) / (2.0 * kStep_m), at.slope_x, 1e-6);
    ASSERT_NEAR((up.height_m - down.height_m) / (2.0 * kStep_m), at.slope_y, 1e-6);
    steepest = std::max(steepest, std::hypot(at.slope_x, at.slope_y));
    // The larger eigenvalue, by size, of the symmetric matrix of second derivatives.
    const double xx = right.slope_x - left.slope_x, yy = up.slope_y - down.slope_y;
    const double bend = std::abs(xx + yy) / 2.0 +
                        std::hypot((xx - yy) / 2.0, right.slope_y - left.slope_y);
    most_bent_per_m = std::max(most_bent_per_m, bend / (2.0 * kStep_m));
  }
  EXPECT_LE(steepest, field.MaxSlope());
  EXPECT_GT(steepest, 0.999 * field.MaxSlope());
  EXPECT_LE(most_bent_per_m, 1.001 * field.MaxCurvature());
  EXPECT_GT(most_bent_per_m, 0.99 * field.MaxCurvature());
}

// The first point of the ray in steps of 0.1 mm that is not above the ground.
std::optional<double> Walk(const Ground& ground, const Vector3& origin_W, const Vector3& ray_W,
                           double max_distance_m) {
  for (double t = 0.0; t <= max_distance_m; t += 1e-4) {
    const Vector3 p_W = origin_W + t * ray_W;
    if (p_W.z() <= ground.Height(p_W.x(), p_W.y())) return t;
  }
  return std::nullopt;
}

TEST(DepressionTest, RaysMeetWhatASmallStepFinds) {
  GroundParams params = DitchAndPit();
  // A second ditch across the first, and a slope.
  params.ditches = {.x_m = {2.0, 2.0},
                    .y_m = {0.5, 0.3},
                    .direction_deg = {90.0, 10.0},
                    .length_m = {4.0, 0.0},
                    .width_m = {0.5, 0.4},
                    .depth_m = {0.3, 0.2},
                    .flank_m = {0.2, 0.1}};
  params.slope_rad = 0.05;
  const Ground ground(params, kKey);
  core::RandomStream stream({4, 0}, core::Purpose::kTest, 1);
  int met = 0;
  int below_the_edge = 0;
  for (int i = 0; i < 600; ++i) {
    const Vector3 origin_W(core::SampleUniform(stream, -2.0, 4.0),
                           core::SampleUniform(stream, -2.0, 3.0),
                           core::SampleUniform(stream, 0.3, 0.8));
    const Vector3 toward_W(core::SampleUniform(stream, 0.5, 3.0),
                           core::SampleUniform(stream, -0.5, 2.0), -0.2);
    const Vector3 ray_W = (toward_W - origin_W).normalized();
    const auto expected_m = Walk(ground, origin_W, ray_W, 4.0);
    const auto distance_m = ground.CastRay(origin_W, ray_W, 4.0);
    ASSERT_EQ(distance_m.has_value(), expected_m.has_value()) << i;
    if (!distance_m) continue;
    ++met;
    ASSERT_NEAR(*distance_m, *expected_m, 1.1e-4) << i;
    const Vector3 p_W = origin_W + *distance_m * ray_W;
    below_the_edge += p_W.z() < std::tan(0.05) * p_W.x() - 0.05 ? 1 : 0;
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(below_the_edge, 100);
}

TEST(DepressionTest, DistanceCountsFromTheSegment) {
  const Depression ditch{.x_m = 1.0, .y_m = 2.0, .direction_rad = 0.0, .half_length_m = 3.0};
  EXPECT_DOUBLE_EQ(ditch.Distance_m(3.5, 2.5), 0.5);
  EXPECT_DOUBLE_EQ(ditch.Distance_m(7.0, 6.0), 5.0);  // 3 beyond the end, 4 across
  EXPECT_DOUBLE_EQ(ditch.Distance_m(-5.0, 2.0), 3.0);
}

}  // namespace
}  // namespace rockyard::terrain
