// Symmetries of stereo looks, and what they may depend on.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "perception/cloud_elevations.h"
#include "perception/hazard_detector.h"
#include "stereo_scene.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::LookDirection;
using messages::PointCloud;

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
