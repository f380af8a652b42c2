// The closed distance of wheel and rock against alternating projections on the same shapes.
#include <gtest/gtest.h>

#include <cmath>

#include "rover/ellipsoid.h"
#include "rover/part_shapes.h"
#include "rover/quasi_static/wheel_rock_gap.h"
#include "rover/rover_drive.h"

namespace rockyard::rover {
namespace {

// Low-discrepancy numbers in [-1, 1).
double Scatter(int index, double stride) {
  return 2.0 * std::fmod(0.5 + stride * index, 1.0) - 1.0;
}

struct Placement {
  terrain::Rock rock;
  math::Vector3 center_W;
  Eigen::Matrix3d R_WB;
};

Placement MakePlacement(int i) {
  const double a = 0.1 + 0.05 * Scatter(i, 0.7548776662466927);
  Placement placement{MakeRock(0, 0, 0, a, a * (0.85 + 0.1 * Scatter(i, 0.5698402909980532)),
                               a * (0.75 + 0.25 * Scatter(i, 0.6180339887498949))),
                      {},
                      {}};
  placement.rock.yaw_rad = 3.0 * Scatter(i, 0.3247179572447461);
  placement.center_W =
      math::Vector3(0.2 * Scatter(i, 0.8191725133961645), 0.2 * Scatter(i, 0.6710436067037893),
                    0.11 + 0.05 * Scatter(i, 0.5497004779019703));
  placement.R_WB = (Eigen::AngleAxisd(3.0 * Scatter(i, 0.4656712316559), math::Vector3::UnitZ()) *
                    Eigen::AngleAxisd(0.2 * Scatter(i, 0.2451223337533), math::Vector3::UnitX()))
                       .toRotationMatrix();
  return placement;
}

// Distance of the cores less the margin, by ten thousand projections in turn.
double ProjectedGap(const Part& part, const Placement& placement) {
  const Ellipsoid ellipsoid(placement.rock);
  SurfacePoint surface = ellipsoid.Nearest(placement.center_W);
  for (int i = 0; i < 10000; ++i) {
    const math::Vector3 core_W =
        placement.center_W +
        placement.R_WB * NearestOnCore(part, placement.R_WB.transpose() *
                                                 (surface.point_W - placement.center_W));
    surface = ellipsoid.Nearest(core_W);
  }
  return surface.distance_m - part.margin_m;
}

TEST(WheelRockGap, EqualsAlternatingProjections) {
  const RoverGeometryParams params;
  const WheelShape wheel(params);
  const Part part = MakeParts(params)[0];
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const Placement placement = MakePlacement(i);
    const double expected = ProjectedGap(part, placement);
    // Penetrations that the projections can follow, and gaps that a stretch can close.
    if (expected < -0.015 || expected > 0.03) continue;
    const RockSupport rock(placement.rock);
    const WheelRockGap gap = FindGap(wheel, placement.center_W, placement.R_WB.col(1), rock, 1.0,
                                     GuessNormal(placement.center_W, rock));
    EXPECT_NEAR(gap.gap_m, expected, 1e-5) << i;
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

TEST(WheelRockGap, BoundNeverExceedsTheGap) {
  const RoverGeometryParams params;
  const WheelShape wheel(params);
  int bounds = 0;
  for (int i = 0; i < 2000; ++i) {
    const Placement placement = MakePlacement(i);
    const RockSupport rock(placement.rock);
    const math::Vector3 n = GuessNormal(placement.center_W, rock);
    const math::Vector3 axle = placement.R_WB.col(1);
    const double bound = FindGap(wheel, placement.center_W, axle, rock, -1.0, n).gap_m;
    const double gap = FindGap(wheel, placement.center_W, axle, rock, 1.0, n).gap_m;
    EXPECT_LE(bound, gap + 1e-9) << i;
    if (bound < gap - 1e-3) ++bounds;
  }
  EXPECT_GT(bounds, 300);
}

// A normal along the axle, as a side face leaves it, is a start as good as any.
TEST(WheelRockGap, StartsFromASideFace) {
  const RoverGeometryParams params;
  const RockSupport rock(MakeRock(0, 0, 0, 0.1, 0.1, 0.1));
  const math::Vector3 center(0.0, 0.0, 0.3);
  const WheelRockGap gap = FindGap(WheelShape(params), center, math::Vector3::UnitY(), rock, 1.0,
                                   math::Vector3::UnitY());
  EXPECT_NEAR(gap.gap_m, 0.3 - 0.1 - params.wheel_radius_m, 1e-9);
  EXPECT_NEAR(gap.n_W.z(), 1.0, 1e-6);
}

}  // namespace
}  // namespace rockyard::rover
