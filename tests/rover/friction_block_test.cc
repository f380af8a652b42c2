// Friction of one contact against the conditions that define it.
#include "rover/multibody/friction_block.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rockyard::rover {
namespace {

struct Case {
  double a0, a1, a01;
};
constexpr Case kCases[] = {{1.0, 1.0, 0.0}, {3.0, 0.5, 0.0}, {2.0, 1.0, 0.9}, {0.2, 40.0, -2.5}};

TEST(FrictionBlock, StopsTheContactWhereTheBoundAllows) {
  for (const Case& c : kCases) {
    FrictionBlock block;
    block.Set(c.a0, c.a1, c.a01);
    const auto [p0, p1] = block.Solve({0.3, -0.4}, 0.0, 100.0);
    EXPECT_NEAR(c.a0 * p0 + c.a01 * p1, 0.3, 1e-12);
    EXPECT_NEAR(c.a01 * p0 + c.a1 * p1, -0.4, 1e-12);
  }
}

// On the bound the velocity that remains, A p - b, is opposite to p: cross product zero, scalar
// product negative. From calls before, another bound or direction, nothing is left.
TEST(FrictionBlock, OpposesSlidingOnTheBound) {
  for (const Case& c : kCases) {
    FrictionBlock block;
    block.Set(c.a0, c.a1, c.a01);
    for (const double most : {1e-6, 0.01, 0.05, 0.002}) {
      for (int i = 0; i < 24; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 24.0;
        const double b0 = 5.0 * std::cos(angle);
        const double b1 = 5.0 * std::sin(angle);
        const auto [p0, p1] = block.Solve({b0, b1}, 0.0, most);
        EXPECT_NEAR(std::hypot(p0, p1) / most, 1.0, 1e-8);
        const double v0 = c.a0 * p0 + c.a01 * p1 - b0;
        const double v1 = c.a01 * p0 + c.a1 * p1 - b1;
        const double size = std::hypot(v0, v1) * most;
        EXPECT_NEAR((v0 * p1 - v1 * p0) / size, 0.0, 1e-8);
        EXPECT_LT((v0 * p0 + v1 * p1) / size, -0.999);
      }
    }
  }
}

// Within the bound a soft contact yields in proportion to its impulse, A p - b = -c p, also after
// calls with another softness; on the bound c changes nothing.
TEST(FrictionBlock, YieldsWithinTheBoundAsSoftAsAsked) {
  for (const Case& c : kCases) {
    FrictionBlock block;
    block.Set(c.a0, c.a1, c.a01);
    for (const double softness : {0.0, 0.3, 5.0, 0.3}) {
      const auto [p0, p1] = block.Solve({0.3, -0.4}, softness, 100.0);
      EXPECT_NEAR(c.a0 * p0 + c.a01 * p1 - 0.3, -softness * p0, 1e-12);
      EXPECT_NEAR(c.a01 * p0 + c.a1 * p1 + 0.4, -softness * p1, 1e-12);
      FrictionBlock rigid;
      rigid.Set(c.a0, c.a1, c.a01);
      const auto bounded = block.Solve({30.0, -40.0}, softness, 1e-3);
      const auto expected = rigid.Solve({30.0, -40.0}, 0.0, 1e-3);
      EXPECT_NEAR(bounded[0], expected[0], 1e-10);
      EXPECT_NEAR(bounded[1], expected[1], 1e-10);
      block.Set(c.a0, c.a1, c.a01);
    }
  }
}

TEST(FrictionBlock, NoBoundNoFriction) {
  FrictionBlock block;
  const auto [p0, p1] = block.Solve({1.0, 2.0}, 0.0, 0.0);
  EXPECT_EQ(p0, 0.0);
  EXPECT_EQ(p1, 0.0);
}

}  // namespace
}  // namespace rockyard::rover
