// Properties of the map that hold on any ground.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "navigation/gestalt/clouds.h"

namespace rockyard::navigation {
namespace {

using math::Transform;
using math::Vector3;

// Points without order in the window of HandParams, around its middle, with a hole, a block and a
// slope; `height` scales z.
std::vector<Vector3> RandomPoints(std::uint32_t trial, double height, double gap_m) {
  core::RandomStream stream({61, trial}, core::Purpose::kTest, 1);
  const double tilt = core::SampleUniform(stream, -0.1, 0.1);
  const double noise = core::SampleUniform(stream, 0.0, 0.05);
  const double rock = core::SampleUniform(stream, 0.0, 0.25);
  std::vector<Vector3> points;
  for (int i = 0; i < 4000; ++i) {
    const double x = core::SampleUniform(stream, -1.9, 1.9);
    const double y = core::SampleUniform(stream, -1.9, 1.9);
    if (std::hypot(x - 0.8, y + 0.4) < gap_m) continue;
    const double z = tilt * x + (std::hypot(x + 0.7, y - 0.6) < 0.3 ? rock : 0.0) +
                     core::SampleNormal(stream, 0.0, noise);
    points.push_back({x, y, height * z});
  }
  return points;
}

GoodnessGrid GridOf(const GestaltMapParams& params, std::vector<Vector3> points) {
  messages::PointCloud cloud{.points_R = std::move(points)};
  return MapOf(params, cloud).Evaluate();
}

// The window of HandParams with its middle cell around the origin: turning by quarters and
// mirroring map it on itself.
GestaltMapParams CentredParams() {
  GestaltMapParams params = HandParams();
  params.grid.x0_m = -0.1;
  params.grid.y0_m = -0.1;
  params.grid.xN_m = 4.1;
  params.grid.yN_m = 4.1;
  params.tests.pitch = true;
  return params;
}

TEST(GestaltPropertyTest, OrderOfPointsDoesNotMatter) {
  for (std::uint32_t trial = 0; trial < 10; ++trial) {
    std::vector<Vector3> points = RandomPoints(trial, 1.0, 0.5);
    const GoodnessGrid first = GridOf(HandParams(), points);
    std::reverse(points.begin(), points.end());
    EXPECT_EQ(GridOf(HandParams(), points).cells, first.cells);
    std::sort(points.begin(), points.end(),
              [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
    EXPECT_EQ(GridOf(HandParams(), points).cells, first.cells);
  }
}

// Where both maps have a plane, higher ground is never better. Both readings of roughness.
TEST(GestaltPropertyTest, GoodnessDoesNotRiseWithHeight) {
  int fell = 0;
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    GestaltMapParams params = HandParams();
    params.tests.pitch = trial % 2 == 0;
    params.tests.step = trial % 3 != 0;
    params.roughness_fraction = 0.3;
    params.eigen_ratio = 1.0;  // whatever the heights, the test is passed
    if (trial % 4 == 1) params.roughness_formula = RoughnessFormula::kDivided;
    GoodnessGrid lower = GridOf(params, RandomPoints(trial, 0.5, 0.0));
    for (const double height : {0.7, 1.0, 1.5, 2.0, 3.0}) {
      const GoodnessGrid higher = GridOf(params, RandomPoints(trial, height, 0.0));
      for (std::size_t i = 0; i < lower.cells.size(); ++i) {
        ASSERT_EQ(higher.cells[i].known, lower.cells[i].known);
        ASSERT_LE(higher.cells[i].goodness, lower.cells[i].goodness) << trial << " " << height;
        fell += higher.cells[i].goodness < lower.cells[i].goodness ? 1 : 0;
      }
      lower = higher;
    }
  }
  EXPECT_GT(fell, 5000);
}

// A world turned by 90 degrees has the turned map, bit for bit; with outliers too, as no two cells
// of random ground are equally far from a plane.
TEST(GestaltPropertyTest, QuarterTurnTurnsTheMap) {
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    std::vector<Vector3> points = RandomPoints(trial, 1.0, 0.4);
    GestaltMapParams params = CentredParams();
    if (trial % 2 == 1) params.patch = PatchSize::kLength;
    params.outliers_per_cell = trial % 3;
    const auto grid_of = [&params](const std::vector<Vector3>& cloud_points) {
      messages::PointCloud cloud;
      cloud.points_R = cloud_points;
      GestaltMap map(params);
      map.BeginCycle(0.0, 0.0);
      map.Add(cloud, Transform::Identity());
      return map.Evaluate();
    };
    const GoodnessGrid before = grid_of(points);
    std::vector<Vector3> turned, mirrored;
    for (const Vector3& p : points) {
      turned.push_back({-p.y(), p.x(), p.z()});
      mirrored.push_back({p.x(), -p.y(), p.z()});
    }
    const GoodnessGrid after = grid_of(turned);
    const GoodnessGrid mirror = grid_of(mirrored);
    for (int iy = 0; iy < 21; ++iy) {
      for (int ix = 0; ix < 21; ++ix) {
        ASSERT_EQ(after.Cell(20 - iy, ix), before.Cell(ix, iy)) << trial;
        ASSERT_EQ(mirror.Cell(ix, 20 - iy), before.Cell(ix, iy)) << trial;
      }
    }
  }
}

// Lifting all ground and moving the world by whole cells change nothing, also far from the origin.
TEST(GestaltPropertyTest, OriginDoesNotMatter) {
  GestaltMapParams params = HandParams();
  params.tests.pitch = true;
  params.grid.xstep_m = params.grid.ystep_m = 0.25;  // exact in binary
  const std::vector<Vector3> points = RandomPoints(3, 1.0, 0.4);
  const auto grid_at = [&](const Vector3& offset) {
    messages::PointCloud cloud;
    for (const Vector3& p : points) {
      // To 2^-20 m, so that moving rounds nothing away.
      const Vector3 rounded = (p * 1048576.0).array().round() / 1048576.0;
      cloud.points_R.push_back(rounded + offset);
    }
    GestaltMap map(params);
    map.BeginCycle(offset.x() + 0.1, offset.y() + 0.1);
    map.Add(cloud, Transform(Eigen::Translation3d(0.0, 0.0, 0.0)));
    return map.Evaluate().cells;
  };
  const auto here = grid_at({0.0, 0.0, 0.0});
  EXPECT_EQ(grid_at({0.0, 0.0, 5.0}), here);
  EXPECT_EQ(grid_at({1000.0, -500.0, 3.0}), here);
  EXPECT_EQ(grid_at({20000.25, 31000.5, -7.0}), here);
}

// A single point more can make a cell known, and no cell unknown.
TEST(GestaltPropertyTest, MoreDataNeverMakeACellUnknown) {
  GestaltMapParams params = HandParams();
  params.tests.rough = false;  // its plane may fail with more data, as it should
  params.failed_fit = FailedFit::kSkipPlaneTests;
  const std::vector<Vector3> points = RandomPoints(5, 1.0, 0.8);
  std::vector<Vector3> few;
  GoodnessGrid before = GridOf(params, few);
  for (std::size_t i = 0; i < points.size(); i += 100) {
    few.insert(few.end(), points.begin() + static_cast<std::ptrdiff_t>(i),
               points.begin() + static_cast<std::ptrdiff_t>(std::min(i + 100, points.size())));
    const GoodnessGrid after = GridOf(params, few);
    for (std::size_t k = 0; k < after.cells.size(); ++k) {
      EXPECT_TRUE(after.cells[k].known || !before.cells[k].known);
    }
    before = after;
  }
}

}  // namespace
}  // namespace rockyard::navigation
