// Symmetries and determinism of the light stripe sensor and of stereo looks, and what they may
// depend on.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "perception/cloud_elevations.h"
#include "perception/hazard_detector.h"
#include "sensing/stripe_scene.h"
#include "stereo_scene.h"

namespace rockyard::sensing {
namespace {

using core::SampleUniform;
using math::Vector3;
using messages::kStripeRows;
using messages::kStripes;
using messages::LookDirection;
using messages::PointCloud;

// Symmetries and determinism of the light stripe sensor.

std::vector<terrain::Rock> RandomRocks(std::uint32_t scene) {
  core::RandomStream stream({20260103, 0}, core::Purpose::kTest, scene);
  std::vector<terrain::Rock> rocks;
  for (int i = 0; i < 8; ++i) {
    const double a = SampleUniform(stream, 0.03, 0.12);
    const double x = SampleUniform(stream, 0.40, 0.80);
    const double y = SampleUniform(stream, -0.5, 0.5);
    rocks.push_back(
        EllipsoidRock(x, y, 0.2 * a, a, 0.7 * a, 0.6 * a, SampleUniform(stream, 0.0, 3.1)));
  }
  return rocks;
}

terrain::Rock Mirrored(terrain::Rock rock) {
  rock.center_W.y() = -rock.center_W.y();
  rock.yaw_rad = -rock.yaw_rad;
  return rock;
}

bool Same(const messages::StripeScan& a, const messages::StripeScan& b) {
  return std::ranges::equal(a.pixels.points(), b.pixels.points(), [](const auto& p, const auto& q) {
    return p.detected == q.detected && p.column_px == q.column_px;
  });
}

TEST(LightStripePropertyTest, MirroredSceneGivesMirroredScan) {
  // The centre stripe belongs to the left camera and has no mirror image.
  const LightStripe sensor(NoiselessParams());
  int found = 0;
  for (std::uint32_t scene = 0; scene < 300; ++scene) {
    const auto rocks = RandomRocks(scene);
    std::vector<terrain::Rock> mirrored;
    for (const terrain::Rock& rock : rocks) mirrored.push_back(Mirrored(rock));
    const auto a = sensor.Scan(FlatWith(rocks), PoseAt(0, 0.02, 0, 0.1), {1, 0}, 0);
    const auto b = sensor.Scan(FlatWith(mirrored), PoseAt(0, -0.02, 0, -0.1), {1, 0}, 0);
    for (std::size_t row = 0; row < kStripeRows; ++row) {
      for (const std::size_t stripe : {0u, 1u, 3u, 4u}) {
        const auto& p = a.pixels[row][stripe];
        const auto& q = b.pixels[row][kStripes - 1 - stripe];
        EXPECT_EQ(p.detected, q.detected);
        // Rounding half a pixel may go either way.
        EXPECT_NEAR(p.column_px, -q.column_px, 1.0);
        found += p.detected;
      }
    }
  }
  EXPECT_GT(found, 3000);
}

TEST(LightStripePropertyTest, MovingSceneAndRoverTogetherChangesNothing) {
  const LightStripe sensor(NoiselessParams());
  const math::Transform X = PoseAt(-3.0, 5.0, 0.0, 2.0);
  for (std::uint32_t scene = 0; scene < 100; ++scene) {
    auto rocks = RandomRocks(scene);
    const auto before = sensor.Scan(FlatWith(rocks), PoseAt(0, 0, 0), {1, 0}, 0);
    for (terrain::Rock& rock : rocks) {
      rock.center_W = X * rock.center_W;
      rock.yaw_rad += 2.0;
    }
    const auto after = sensor.Scan(FlatWith(rocks), X, {1, 0}, 0);
    for (std::size_t i = 0; i < before.pixels.points().size(); ++i) {
      const messages::StripePixel& pixel = after.pixels.points()[i];
      EXPECT_EQ(before.pixels.points()[i].detected, pixel.detected);
      EXPECT_NEAR(before.pixels.points()[i].column_px, pixel.column_px, 1.0);
    }
  }
}

TEST(LightStripePropertyTest, AScanDependsOnItsArgumentsAlone) {
  LightStripeParams params{.wrong_place_probability = 0.2, .missed_probability = 0.2};
  const LightStripe sensor(params);
  const terrain::Terrain terrain = FlatWith(RandomRocks(1));
  const auto first = sensor.Scan(terrain, PoseAt(0, 0, 0), {5, 3}, 17);
  for (int other = 0; other < 5; ++other) sensor.Scan(terrain, PoseAt(0.1, 0, 0), {5, 3}, other);
  EXPECT_TRUE(Same(first, sensor.Scan(terrain, PoseAt(0, 0, 0), {5, 3}, 17)));
  EXPECT_FALSE(Same(first, sensor.Scan(terrain, PoseAt(0, 0, 0), {5, 3}, 18)));
  EXPECT_FALSE(Same(first, sensor.Scan(terrain, PoseAt(0, 0, 0), {5, 4}, 17)));
  EXPECT_FALSE(Same(first, sensor.Scan(terrain, PoseAt(0, 0, 0), {6, 3}, 17)));
}

TEST(LightStripePropertyTest, TheSamePointsAreMisplacedOnEveryTerrain) {
  LightStripeParams params{.wrong_place_probability = 0.3};
  const LightStripe sensor(params);
  const auto nothing_visible = PoseAt(0, 0, 50.0);
  for (std::int64_t number = 0; number < 50; ++number) {
    const auto alone = sensor.Scan(FlatWith({}), nothing_visible, {1, 0}, number);
    const auto rocky = sensor.Scan(FlatWith(RandomRocks(2)), PoseAt(0, 0, 0), {1, 0}, number);
    for (std::size_t i = 0; i < alone.pixels.points().size(); ++i) {
      if (!alone.pixels.points()[i].detected) continue;
      EXPECT_EQ(alone.pixels.points()[i].column_px, rocky.pixels.points()[i].column_px);
    }
  }
}

// Which rocks a straight approach sees, without noise. Section 6 of Matthies 1995: "on average
// rocks must be about 1.5 times higher" than the neighbour threshold to be seen, since the sparse
// points miss their tops. The bounds here are those of the geometry, not of that statement.

// Share of rocks of one height, a third of them below ground, anywhere across the rover's width,
// that are detected by scans every 6.5 cm before its front reaches them.
double ShareSeen(double height_m, int rocks) {
  const LightStripe sensor(NoiselessParams());
  const perception::Triangulator triangulator(sensor.calibration());
  int seen = 0;
  for (int i = 0; i < rocks; ++i) {
    core::RandomStream stream({20260108, static_cast<std::uint32_t>(i)}, core::Purpose::kTest);
    const double c = 0.75 * height_m;
    const double a = c / core::SampleUniform(stream, 0.5, 1.0);
    const double y = core::SampleUniform(stream, -0.24, 0.24);
    const double yaw = core::SampleUniform(stream, 0.0, 3.0);
    const terrain::Terrain field =
        FlatWith({EllipsoidRock(2.0, y, height_m - c, a, 0.85 * a, c, yaw)});
    double x = core::SampleUniform(stream, 0.8, 0.865);
    bool hazard = false;
    for (; !hazard && x + 0.325 < 2.0 - a; x += 0.065) {
      const auto scan = sensor.Scan(field, PoseAt(x, 0, 0), {1, 0}, 0);
      hazard = perception::ReportHazards(triangulator.Elevations(scan), {}).any();
    }
    seen += hazard;
  }
  return static_cast<double>(seen) / rocks;
}

TEST(DetectabilityTest, HigherRocksAreSeenMoreOften) {
  double before = 0.0;
  for (const double height_m : {0.03, 0.05, 0.07, 0.09, 0.12}) {
    const double share = ShareSeen(height_m, 500);
    EXPECT_GE(share, before) << height_m;
    before = share;
  }
  // No two points of a rock and of flat ground differ by more than its height: only points that it
  // hides from a camera can betray a rock below the threshold.
  EXPECT_LT(ShareSeen(0.03, 500), 0.15);
  EXPECT_GT(ShareSeen(0.12, 500), 0.98);
}

// Symmetries of stereo looks, and what they may depend on.

std::vector<terrain::Rock> SomeRocks() {
  return {EllipsoidRock(1.1, 0.3, 0.05, 0.2, 0.15, 0.12, 0.4),
          EllipsoidRock(1.8, -0.4, 0.0, 0.3, 0.2, 0.25, -0.8),
          EllipsoidRock(-1.2, 0.2, 0.1, 0.25, 0.2, 0.2, 1.0),
          EllipsoidRock(2.6, 0.8, 0.0, 0.4, 0.4, 0.35, 0.0)};
}

TEST(StereoPropertyTest, MirroredSceneGivesTheMirroredCloud) {
  std::vector<terrain::Rock> mirrored = SomeRocks();
  for (terrain::Rock& rock : mirrored) {
    rock.center_W.y() *= -1.0;
    rock.yaw_rad *= -1.0;
  }
  const auto look = [](std::vector<terrain::Rock> rocks, double side) {
    const math::Transform X_WR =
        math::MakePose({0.1, 0.1 * side, 0.05}, 0.3 * side, 0.04, 0.06 * side);
    return LookAhead(IdealStereo(), FlatWith(std::move(rocks)), X_WR).points_R;
  };
  std::vector<Vector3> left = look(SomeRocks(), 1.0);
  const std::vector<Vector3> right = look(mirrored, -1.0);
  ASSERT_EQ(left.size(), right.size());
  // Rows come in the same order; within a row, columns from the other end. Each point's mirror
  // image is at most a row's length away in the list.
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Vector3 image(left[i].x(), -left[i].y(), left[i].z());
    const auto first = right.begin() + static_cast<std::ptrdiff_t>(i < 128 ? 0 : i - 128);
    const auto last = right.begin() + static_cast<std::ptrdiff_t>(std::min(i + 129, right.size()));
    EXPECT_TRUE(std::any_of(first, last, [&](const Vector3& p) {
      return (p - image).norm() < 1e-9;
    })) << i;
  }
}

TEST(StereoPropertyTest, RearViewIsTheFrontViewOfTheRoverTurnedAround) {
  // Noise included: it belongs to the look and the pixel.
  const StereoSensor sensor{StereoParams{}};
  const terrain::Terrain terrain = FlatWith(SomeRocks());
  const math::Transform X_WR = math::MakePose({0.1, -0.1, 0.05}, 0.2, 0.03, -0.05);
  math::Transform X_WT = X_WR;
  X_WT.rotate(Eigen::AngleAxisd(std::numbers::pi, Vector3::UnitZ()));
  const PointCloud rear = sensor.Look(terrain, X_WR, {3, 1}, 7, LookDirection::kBehind);
  const PointCloud front = sensor.Look(terrain, X_WT, {3, 1}, 7, LookDirection::kAhead);
  ASSERT_EQ(rear.points_R.size(), front.points_R.size());
  ASSERT_GT(rear.points_R.size(), 5000U);
  for (std::size_t i = 0; i < rear.points_R.size(); ++i) {
    EXPECT_LT((X_WR * rear.points_R[i] - X_WT * front.points_R[i]).norm(), 1e-6);
  }
  EXPECT_EQ(rear.direction, LookDirection::kBehind);
  EXPECT_EQ(front.direction, LookDirection::kAhead);
}

TEST(StereoPropertyTest, ALookIsAPureFunctionOfItsArguments) {
  const StereoSensor sensor{StereoParams{}};
  const terrain::Terrain terrain = FlatWith(SomeRocks());
  const auto look = [&](const StereoSensor& with, std::int64_t number) {
    return with.Look(terrain, PoseAt(0.0, 0.0, 0.0), {5, 2}, number, LookDirection::kAhead);
  };
  const PointCloud third = look(sensor, 3);
  const PointCloud fourth = look(sensor, 4);
  EXPECT_EQ(look(sensor, 3).points_R, third.points_R);
  EXPECT_EQ(look(StereoSensor{StereoParams{}}, 4).points_R, fourth.points_R);
  EXPECT_EQ(third.number, 3);
  EXPECT_NE(third.points_R, fourth.points_R);
  EXPECT_NE(sensor.Look(terrain, PoseAt(0, 0, 0), {5, 3}, 3, LookDirection::kAhead).points_R,
            third.points_R);
}

TEST(StereoPropertyTest, StripeWindowKeepsWhatLiesOverItAndNothingElse) {
  StereoParams params;
  const terrain::Terrain terrain = FlatWith(SomeRocks());
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    params.field_of_view = StereoFieldOfView::kFull;
    const PointCloud full =
        StereoSensor(params).Look(terrain, PoseAt(0, 0, 0), {1, 0}, 0, direction);
    params.field_of_view = StereoFieldOfView::kStripe;
    const PointCloud stripe =
        StereoSensor(params).Look(terrain, PoseAt(0, 0, 0), {1, 0}, 0, direction);
    const double side = direction == LookDirection::kAhead ? 1.0 : -1.0;
    std::vector<Vector3> expected;
    for (const Vector3& p_R : full.points_R) {
      const double ahead_m = side * p_R.x();
      if (ahead_m < 0.425 || ahead_m > 0.625 || std::abs(p_R.y()) > 0.37) continue;
      expected.push_back(p_R);
    }
    EXPECT_EQ(stripe.points_R, expected);
    EXPECT_GT(expected.size(), 500U);
    EXPECT_LT(expected.size(), full.points_R.size() / 2);
  }
}

TEST(StereoPropertyTest, ElevationsFromALookShowARockWhereItIs) {
  // A rock 12 cm high, 0.8 m ahead in the leftmost fifth of the ground that is judged.
  const terrain::Terrain terrain = FlatWith({EllipsoidRock(0.8, 0.48, 0.0, 0.1, 0.1, 0.12)});
  const PointCloud cloud = LookAhead(IdealStereo(), terrain, PoseAt(0, 0, 0));
  const messages::ElevationScan scan = perception::CloudElevations(cloud, {}, {});
  for (const messages::ElevationPoint& point : scan.points.points()) EXPECT_TRUE(point.detected);
  const messages::HazardReport report = perception::ReportHazards(scan, {});
  EXPECT_TRUE(report.stripe_hazard[0]);
  for (std::size_t stripe = 1; stripe < 5; ++stripe) EXPECT_FALSE(report.stripe_hazard[stripe]);
}

}  // namespace
}  // namespace rockyard::sensing
