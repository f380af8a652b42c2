// The closed distance of wheel and rock against alternating projections on the same shapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "rover/part_shapes.h"
#include "rover/quasi_static/wheel_rock_gap.h"
#include "rover/rock_body.h"
#include "rover/rover_drive.h"
#include "terrain/rock.h"

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
  const RockBody body(placement.rock);
  SurfacePoint surface = body.Nearest(placement.center_W);
  for (int i = 0; i < 10000; ++i) {
    const math::Vector3 core_W =
        placement.center_W +
        placement.R_WB * NearestOnCore(part, placement.R_WB.transpose() *
                                                 (surface.point_W - placement.center_W));
    const math::Vector3 before_W = surface.point_W;
    surface = body.Nearest(core_W);
    if (surface.point_W == before_W) break;
  }
  return surface.distance_m - part.margin_m;
}

// How many of these placements were compared. Projections see the flank of a rock that
// `ends_at_ground` go on below its base: those are left out.
template <typename PlacementAt>
int CompareWithProjections(int placements, bool ends_at_ground, const PlacementAt& at) {
  const RoverGeometryParams params;
  const WheelShape wheel(params);
  const Part part = MakeParts(params)[0];
  int compared = 0;
  for (int i = 0; i < placements; ++i) {
    const Placement placement = at(i);
    const double expected = ProjectedGap(part, placement);
    // Penetrations that the projections can follow, and gaps that a stretch can close.
    if (expected < -0.015 || expected > 0.03) continue;
    const RockSupport rock(placement.rock);
    const WheelRockGap gap = FindGap(wheel, placement.center_W, placement.R_WB.col(1), rock, 1.0,
                                     rock.GuessNormal(placement.center_W));
    if (ends_at_ground && (gap.p_W - gap.gap_m * gap.n_W).z() < 1e-6) continue;
    EXPECT_NEAR(gap.gap_m, expected, 1e-5) << i;
    ++compared;
  }
  return compared;
}

TEST(WheelRockGap, EqualsAlternatingProjections) {
  EXPECT_GT(CompareWithProjections(2000, false, MakePlacement), 300);
}

TEST(WheelRockGap, BoundNeverExceedsTheGap) {
  const RoverGeometryParams params;
  const WheelShape wheel(params);
  int bounds = 0;
  for (int i = 0; i < 2000; ++i) {
    const Placement placement = MakePlacement(i);
    const RockSupport rock(placement.rock);
    const math::Vector3 n = rock.GuessNormal(placement.center_W);
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

// A cap in the place of an ellipsoid: the same outline on the ground, half of its full height above
// it.
Placement MakeCapPlacement(int i, double pointedness) {
  Placement placement = MakePlacement(i);
  const terrain::Rock& round = placement.rock;
  terrain::Rock cap =
      terrain::ShapeRock({.diameter_m = 2.0 * round.semi_axes_m.x(),
                          .width_ratio = round.semi_axes_m.y() / round.semi_axes_m.x(),
                          .half_height_m = round.semi_axes_m.z(),
                          .height_m = 1.2 * round.semi_axes_m.z()},
                         pointedness);
  cap.yaw_rad = round.yaw_rad;
  placement.rock = cap;
  return placement;
}

class CapGap : public testing::TestWithParam<double> {};

// Caps of ellipsoids, nearly a paraboloid on both sides (A = 1 +- 0.002), hyperboloids.
INSTANTIATE_TEST_SUITE_P(Pointedness, CapGap,
                         testing::Values(0.45, 0.55, 0.5825, 0.5842, 0.75, 0.87, 0.95, 0.98));

// The farthest of many points of the surface and of the base's rim.
double FarthestAlong(const terrain::Rock& rock, const math::Vector3& n) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(rock.yaw_rad, math::Vector3::UnitZ()).toRotationMatrix();
  const double A = rock.cap_growth;
  double farthest_m = -1.0;
  constexpr int kLevels = 400;
  constexpr int kSides = 720;
  for (int i = 0; i <= kLevels; ++i) {
    const double s = std::pow(static_cast<double>(i) / kLevels, 2);
    const double rho = std::sqrt(A * s + (1.0 - A) * s * s);
    for (int j = 0; j < kSides; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / kSides;
      const math::Vector3 p(rho * std::cos(angle), rho * std::sin(angle), 1.0 - s);
      farthest_m = std::max(farthest_m, n.dot(R * p.cwiseProduct(rock.semi_axes_m)));
    }
  }
  return farthest_m;
}

TEST_P(CapGap, SupportIsTheFarthestPoint) {
  constexpr double kTolerance_m = 2e-5;
  int missed_by_another = 0;
  for (int i = 0; i < 40; ++i) {
    const terrain::Rock rock = MakeCapPlacement(i, GetParam()).rock;
    const math::Vector3 n =
        math::Vector3(Scatter(i, 0.21), Scatter(i, 0.37), 0.5 + Scatter(i, 0.59)).normalized();
    const double brute_m = FarthestAlong(rock, n);
    EXPECT_NEAR(RockSupport(rock).Along(n), brute_m, kTolerance_m) << i;
    // Negative control: a rock pointed a little more or less.
    const terrain::Rock another = MakeCapPlacement(i, GetParam() - 0.05).rock;
    missed_by_another += std::abs(RockSupport(another).Along(n) - brute_m) > 5.0 * kTolerance_m;
  }
  EXPECT_GT(missed_by_another, 10);
}

TEST_P(CapGap, EqualsAlternatingProjections) {
  const auto cap = [](int i) { return MakeCapPlacement(i, GetParam()); };
  EXPECT_GT(CompareWithProjections(300, true, cap), 30);
}

// Straight above the top the first normal is the answer, and no step leaves it: an arc of the
// search has one end then.
TEST_P(CapGap, StaysAtAFirstNormalThatIsTheAnswer) {
  const RoverGeometryParams params;
  const WheelShape wheel(params);
  for (int i = 0; i < 20; ++i) {
    const terrain::Rock rock = MakeCapPlacement(i, GetParam()).rock;
    const double top_m = rock.center_W.z() + rock.semi_axes_m.z();
    for (const double gap_m : {-0.005, 0.0, 0.02}) {
      const math::Vector3 center_W(0.0, 0.0, top_m + params.wheel_radius_m + gap_m);
      const WheelRockGap gap = FindGap(wheel, center_W, math::Vector3::UnitY(), RockSupport(rock),
                                       1.0, math::Vector3::UnitZ());
      EXPECT_NEAR(gap.gap_m, gap_m, 1e-12) << i;
      EXPECT_NEAR(gap.n_W.z(), 1.0, 1e-12) << i;
    }
  }
}

// Whatever the pose and the first normal: the distance of the rock's own point from the core is an
// upper bound of the gap, f(n) a lower one, and both meet where the search has found its end.
TEST_P(CapGap, BoundsMeetForRandomPoses) {
  const RoverGeometryParams params;
  const WheelShape wheel(params);
  const Part part = MakeParts(params)[0];
  int searched = 0;
  int open = 0;
  for (int i = 0; i < 100000; ++i) {
    const Placement placement = MakeCapPlacement(i, GetParam());
    const RockSupport rock(placement.rock);
    const math::Vector3 start =
        i % 2 == 0 ? rock.GuessNormal(placement.center_W)
                   : math::Vector3(Scatter(i, 0.21), Scatter(i, 0.37), 1.0).normalized();
    const WheelRockGap gap =
        FindGap(wheel, placement.center_W, placement.R_WB.col(1), rock, 1.0, start);
    // Penetrations beyond the margin have no nearest points.
    if (gap.gap_m < -0.75 * part.margin_m || gap.gap_m > 0.05) continue;
    ++searched;
    const math::Vector3 on_rock_W = gap.p_W - gap.gap_m * gap.n_W;
    const math::Vector3 core_W =
        placement.center_W +
        placement.R_WB *
            NearestOnCore(part, placement.R_WB.transpose() * (on_rock_W - placement.center_W));
    const double upper_m = (core_W - on_rock_W).norm() - part.margin_m;
    if (upper_m - gap.gap_m > 1e-5) ++open;
  }
  EXPECT_GT(searched, 30000);
  // At the border between side face and rim the search may end too early, as it does with
  // ellipsoids.
  EXPECT_LE(open, 2);
}

}  // namespace
}  // namespace rockyard::rover
