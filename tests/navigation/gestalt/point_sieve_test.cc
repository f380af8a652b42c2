#include "navigation/gestalt/point_sieve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"
#include "math/point_moments.h"

namespace rockyard::navigation {
namespace {

using math::Vector3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

// A window of 25 by 20 cells around a rover far from the origin.
PointSieve Sieve() {
  return {
      .x = {.origin_m = 0.05,
            .step_m = 0.2,
            .rover_m = -61.0,
            .first = -318,
            .cells = 25,
            .wrap = 7},
      .y =
          {.origin_m = -0.1, .step_m = 0.3, .rover_m = 123.4, .first = 401, .cells = 20, .wrap = 1},
      .largest_xy_m = 2e6,
      .largest_z_m = 1e6,
      .largest_height_m = 10.0,
      .largest_square_m2 = 4.0};
}

// Points around the window, most of them in it, some of them no points at all.
std::vector<Vector3> Points(core::RandomStream& stream, std::size_t count,
                            const math::Transform& X_WR) {
  const std::vector<double> odd = {0.0, -0.0,      1e300,      -1e300,
                                   3e6, kInfinity, -kInfinity, kNotANumber};
  std::vector<Vector3> points_R;
  for (std::size_t i = 0; i < count; ++i) {
    points_R.push_back(X_WR.inverse() * Vector3(core::SampleUniform(stream, -63.8, -58.4),
                                                core::SampleUniform(stream, 120.0, 126.5),
                                                core::SampleUniform(stream, -9.0, 11.0)));
    if (core::SampleBernoulli(stream, 0.1)) {
      points_R.back()[static_cast<Eigen::Index>(3.0 * stream.Uniform())] =
          odd[static_cast<std::size_t>(8.0 * stream.Uniform())];
    }
  }
  return points_R;
}

// One point after the other, to the last bit.
void ExpectSame(const PointSieve& sieve, const std::vector<Vector3>& points_R,
                const math::Transform& X_WR, const SiftedPoints& found) {
  std::size_t taken = 0;
  double first_x = kInfinity, last_x = -kInfinity, first_y = kInfinity, last_y = -kInfinity;
  const auto slot = [](double place, const SieveAxis& axis) {
    return static_cast<std::int64_t>(std::fmod(place + axis.wrap, axis.cells));
  };
  for (std::size_t i = 0; i < points_R.size(); ++i) {
    const Vector3 p_W = X_WR * points_R[i];
    if (!p_W.allFinite() || std::abs(p_W.x()) > 2e6 || std::abs(p_W.y()) > 2e6) continue;
    if (std::abs(p_W.z() - X_WR.translation().z()) > 10.0 || std::abs(p_W.z()) > 1e6) continue;
    const double cell_x = std::floor((p_W.x() - sieve.x.origin_m) / sieve.x.step_m);
    const double cell_y = std::floor((p_W.y() - sieve.y.origin_m) / sieve.y.step_m);
    const double x = cell_x - sieve.x.first;
    const double y = cell_y - sieve.y.first;
    if (x < 0.0 || x >= sieve.x.cells || y < 0.0 || y >= sieve.y.cells) continue;
    const double dx = sieve.x.origin_m + (cell_x + 0.5) * sieve.x.step_m - sieve.x.rover_m;
    const double dy = sieve.y.origin_m + (cell_y + 0.5) * sieve.y.step_m - sieve.y.rover_m;
    if (dx * dx + dy * dy > 4.0) continue;
    ASSERT_LT(taken, found.count);
    ASSERT_EQ(found.taken[taken++], i);
    EXPECT_EQ(found.slots[i], slot(y, sieve.y) * 25 + slot(x, sieve.x));
    EXPECT_EQ(found.x[i], math::ToMomentUnits(p_W.x()));
    EXPECT_EQ(found.y[i], math::ToMomentUnits(p_W.y()));
    EXPECT_EQ(found.z[i], math::ToMomentUnits(p_W.z()));
    first_x = std::min(first_x, x);
    last_x = std::max(last_x, x);
    first_y = std::min(first_y, y);
    last_y = std::max(last_y, y);
  }
  EXPECT_EQ(found.count, taken);
  if (taken == 0) return;
  EXPECT_EQ(found.first_x, first_x);
  EXPECT_EQ(found.last_x, last_x);
  EXPECT_EQ(found.first_y, first_y);
  EXPECT_EQ(found.last_y, last_y);
}

TEST(PointSieveTest, TakesWhatItWouldTakeOneByOne) {
  core::RandomStream stream({3, 0}, core::Purpose::kTest, 40);
  std::size_t taken = 0;
  for (std::size_t count = 0; count <= SiftedPoints::kMost; ++count) {
    const math::Transform X_WR =
        math::MakePose({-61.0, 123.4, 0.7}, core::SampleUniform(stream, -3.0, 3.0), 0.2, -0.1);
    const std::vector<Vector3> points_R = Points(stream, count, X_WR);
    SiftedPoints found;
    Sift(Sieve(), points_R, X_WR, found);
    ExpectSame(Sieve(), points_R, X_WR, found);
    taken += found.count;
  }
  EXPECT_GT(taken, 1000U);
  EXPECT_LT(taken, 6000U);
}

}  // namespace
}  // namespace rockyard::navigation
