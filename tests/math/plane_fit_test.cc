// Moments of points and planes through them, in closed form.

#include "math/plane_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/random.h"
#include "math/point_moments.h"

namespace rockyard::math {
namespace {

PointMoments MomentsOf(const std::vector<Vector3>& points) {
  PointMoments moments;
  for (const Vector3& p : points) {
    moments.AddPoint(ToMomentUnits(p.x()), ToMomentUnits(p.y()), ToMomentUnits(p.z()));
  }
  return moments;
}

// n x n points a step apart around `centre` on the plane z = slope_x x + slope_y y, alternately
// raised and lowered by `bump`.
std::vector<Vector3> Board(int n, double step, const Vector3& centre, double slope_x,
                           double slope_y, double bump) {
  std::vector<Vector3> points;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = (i - 0.5 * (n - 1)) * step;
      const double y = (j - 0.5 * (n - 1)) * step;
      const double z = slope_x * x + slope_y * y + ((i + j) % 2 == 0 ? bump : -bump);
      points.push_back(centre + Vector3(x, y, z));
    }
  }
  return points;
}

TEST(PointMomentsTest, UnitsRoundToTheNearestAndMirror) {
  EXPECT_EQ(ToMomentUnits(0.2), 200000);
  EXPECT_EQ(ToMomentUnits(1.4e-6), 1);
  EXPECT_EQ(ToMomentUnits(-1.6e-6), -2);
  for (const double x : {1e-7, 4.9e-7, 1.23456789, 77.7777777}) {
    EXPECT_EQ(ToMomentUnits(-x), -ToMomentUnits(x));
  }
}

TEST(PointMomentsTest, HoldTheTenSums) {
  const PointMoments m = MomentsOf({{1e-6, 2e-6, 3e-6}, {4e-6, 5e-6, 6e-6}});
  const std::array<std::uint64_t, PointMoments::kSize> sums = {2, 5, 7, 9, 17, 29, 45, 22, 27, 36};
  EXPECT_EQ(m.sums, sums);
}

TEST(PointMomentsTest, DoNotDependOnOrderAndTakeBack) {
  core::RandomStream stream({21, 0}, core::Purpose::kTest, 1);
  std::vector<Vector3> points;
  for (int i = 0; i < 500; ++i) {
    points.push_back(
        {core::SampleUniform(stream, -5, 5), core::SampleUniform(stream, -5, 5), stream.Uniform()});
  }
  const PointMoments forward = MomentsOf(points);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(MomentsOf(points), forward);
  PointMoments both = forward;
  both += MomentsOf({{1, 2, 3}});
  EXPECT_NE(both, forward);
  both -= MomentsOf({{1, 2, 3}});
  EXPECT_EQ(both, forward);
}

// A board of n x n points of step d has variance d^2 (n^2 - 1)/12 along each axis.
TEST(PointSpreadTest, BoardInClosedForm) {
  for (const double far : {0.0, 123.0, 50000.0}) {  // squares wrap from 4 km on
    const PointSpread spread =
        Spread(MomentsOf(Board(8, 0.1, {far, -far, 0.5 * far}, 0.0, 0.0, 0.004)));
    EXPECT_EQ(spread.count, 64);
    EXPECT_NEAR(spread.mean_m.x(), far, 1e-11);
    EXPECT_NEAR(spread.mean_m.z(), 0.5 * far, 1e-11);
    const double variance = 0.01 * 63.0 / 12.0;
    EXPECT_NEAR(spread.covariance_m2.xx, variance, 1e-14) << far;
    EXPECT_NEAR(spread.covariance_m2.yy, variance, 1e-14) << far;
    EXPECT_NEAR(spread.covariance_m2.zz, 1.6e-5, 1e-15) << far;
    EXPECT_NEAR(spread.covariance_m2.xy, 0.0, 1e-14) << far;
  }
}

// Shifting all points by whole units changes no bit.
TEST(PointSpreadTest, DoesNotDependOnTheOrigin) {
  core::RandomStream stream({22, 0}, core::Purpose::kTest, 1);
  PointMoments here, there;
  for (int i = 0; i < 200; ++i) {
    const auto x = static_cast<std::int64_t>(stream.Uniform() * 1e6);
    const auto y = static_cast<std::int64_t>(stream.Uniform() * 1e6);
    const auto z = static_cast<std::int64_t>(stream.Uniform() * 3e5);
    here.AddPoint(x, y, z);
    there.AddPoint(x + 7'000'000'000, y - 9'000'000'000, z + 4'000'000'000);
  }
  const SymmetricMatrix3 a = Spread(here).covariance_m2;
  const SymmetricMatrix3 b = Spread(there).covariance_m2;
  EXPECT_NEAR(a.xx, b.xx, 1e-15);
  EXPECT_NEAR(a.zz, b.zz, 1e-15);
  EXPECT_NEAR(a.yz, b.yz, 1e-15);
}

// Points merged as they are or by sets of three sizes: the same mean and covariance but for
// rounding.
TEST(PointSpreadTest, MergedSetsAreOneSet) {
  core::RandomStream stream({23, 0}, core::Purpose::kTest, 1);
  PointMoments all;
  std::vector<PointSpread> spreads;
  for (const int size : {1, 20, 500}) {
    PointMoments set;
    for (int i = 0; i < size; ++i) {
      const auto x = static_cast<std::int64_t>((stream.Uniform() + size) * 1e6);
      const auto y = static_cast<std::int64_t>(stream.Uniform() * 2e6 - 1e3 * size);
      const auto z = x / 3 + static_cast<std::int64_t>(stream.Uniform() * 3e5);
      set.AddPoint(x, y, z);
    }
    spreads.push_back(Spread(set));
    all += set;
  }
  const PointSpread merged = Merged(spreads);
  const PointSpread whole = Spread(all);
  EXPECT_EQ(merged.count, 521);
  EXPECT_LT((merged.mean_m - whole.mean_m).norm(), 1e-11);
  const SymmetricMatrix3& a = merged.covariance_m2;
  const SymmetricMatrix3& b = whole.covariance_m2;
  const double size_m2 = b.xx;  // the largest
  EXPECT_NEAR(a.xx, b.xx, 1e-13 * size_m2);
  EXPECT_NEAR(a.yy, b.yy, 1e-13 * size_m2);
  EXPECT_NEAR(a.zz, b.zz, 1e-13 * size_m2);
  EXPECT_NEAR(a.xy, b.xy, 1e-13 * size_m2);
  EXPECT_NEAR(a.xz, b.xz, 1e-13 * size_m2);
  EXPECT_NEAR(a.yz, b.yz, 1e-13 * size_m2);
}

// Points on z = a x + b y: no residual; normal (-a, -b, 1)/sqrt(1 + a^2 + b^2), slope
// atan sqrt(a^2 + b^2).
TEST(PlaneFitTest, TiltedPlane) {
  for (const double a : {0.0, 0.1, -0.5, 2.0, 8.0}) {
    const double b = 0.3 * a;
    const PlaneFit fit =
        FitPlane(Spread(MomentsOf(Board(6, 0.2, {3, 4, 5}, a, b, 0))).covariance_m2);
    EXPECT_LT(fit.residual_m, 1e-6) << a;
    EXPECT_NEAR(fit.Slope_rad(), std::atan(std::hypot(a, b)), 1e-6) << a;
    EXPECT_LT((fit.normal - Vector3(-a, -b, 1).normalized()).norm(), 1e-6) << a;
    EXPECT_GT(fit.eigen_ratio, 1e9) << a;
  }
}

// A chessboard of +-bump across the plane: the residual is the bump, as the pattern of an even
// board has no part along x, y or 1.
TEST(PlaneFitTest, ResidualIsRootMeanSquareDistance) {
  const SymmetricMatrix3 level =
      Spread(MomentsOf(Board(8, 0.1, {0, 0, 0}, 0, 0, 0.02))).covariance_m2;
  const PlaneFit fit = FitPlane(level);
  EXPECT_NEAR(fit.residual_m, 0.02, 1e-12);
  EXPECT_NEAR(fit.eigen_ratio, (0.01 * 63.0 / 12.0) / 4e-4, 1e-8);
}

// No better plane exists: neither a tilted nor a shifted one has a smaller sum of squares.
TEST(PlaneFitTest, IsTheLeastOfItsNeighbours) {
  core::RandomStream stream({23, 0}, core::Purpose::kTest, 1);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Vector3> points;
    for (int i = 0; i < 40; ++i) {
      points.push_back({stream.Uniform(), stream.Uniform(), 0.5 * stream.Uniform()});
    }
    const PointSpread spread = Spread(MomentsOf(points));
    const PlaneFit fit = FitPlane(spread.covariance_m2);
    const auto rms = [&](const Vector3& normal, double offset) {
      double sum = 0.0;
      for (const Vector3& p : points) {
        const double d = normal.dot(p - spread.mean_m) - offset;
        sum += d * d;
      }
      return std::sqrt(sum / 40.0);
    };
    EXPECT_NEAR(rms(fit.normal, 0.0), fit.residual_m, 2e-6);
    for (const Vector3& turn : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(-1, 1, 0)}) {
      const Vector3 other = (fit.normal + 0.01 * turn).normalized();
      EXPECT_GT(rms(other, 0.0), rms(fit.normal, 0.0)) << trial;
    }
    EXPECT_GT(rms(fit.normal, 0.01), rms(fit.normal, 0.0)) << trial;
  }
}

// Along a line the two smaller eigenvalues are equal: no plane.
TEST(PlaneFitTest, DegeneratePointsHaveNoPlane) {
  std::vector<Vector3> line;
  for (int i = 0; i < 10; ++i) line.push_back({0.1 * i, 0.2 * i, 0.05 * i});
  EXPECT_LT(FitPlane(Spread(MomentsOf(line)).covariance_m2).eigen_ratio, 2.0);
  EXPECT_EQ(FitPlane(Spread(MomentsOf({{1, 2, 3}})).covariance_m2).eigen_ratio, 1.0);
  EXPECT_EQ(FitPlane({}).residual_m, 0.0);
  EXPECT_EQ(FitPlane({1, 1, 0, 0, 0, 0}).eigen_ratio, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace rockyard::math
