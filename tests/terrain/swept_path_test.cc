// First contact of a straight front with a rock: by hand and against walks around outlines.
#include "terrain/swept_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"

namespace rockyard::terrain {
namespace {

Rock RockAt(double x_m, double y_m, double a_m, double b_m, double yaw_rad) {
  Rock rock;
  rock.center_W = {x_m, y_m, 0.0};
  rock.semi_axes_m = {a_m, b_m, 0.1};
  rock.yaw_rad = yaw_rad;
  return rock;
}

TEST(SweptPathTest, FirstContactIsTheLeastXOfTheOutlineInThePath) {
  // A circle of 0.2 m ahead; beside the path but for its flank; out of reach.
  EXPECT_NEAR(FirstContact(RockAt(1.0, 0.0, 0.2, 0.2, 0.3), 0.0, 0.24).value(), 0.8, 1e-12);
  // At y = 0.24 the circle around y = 0.34 begins at 1 - sqrt(0.2^2 - 0.1^2).
  EXPECT_NEAR(FirstContact(RockAt(1.0, 0.34, 0.2, 0.2, 0.0), 0.0, 0.24).value(),
              1.0 - std::sqrt(0.03), 1e-12);
  EXPECT_FALSE(FirstContact(RockAt(1.0, 0.45, 0.2, 0.2, 0.0), 0.0, 0.24).has_value());
}

// Any ellipse against a fine walk around its outline.
TEST(SweptPathTest, AgreesWithAWalkAroundTheOutline) {
  core::RandomStream stream({7, 0}, core::Purpose::kTest);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const double a = 0.05 + 0.4 * stream.Uniform();
    const double b = a * (0.3 + 0.7 * stream.Uniform());
    const Rock rock = RockAt(2.0, stream.Uniform() - 0.5, a, b, 3.0 * stream.Uniform());
    double least = 1e9;
    constexpr int kSteps = 20000;
    for (int k = 0; k < kSteps; ++k) {
      const double t = 2.0 * std::numbers::pi * k / kSteps;
      const double u = a * std::cos(t);
      const double w = b * std::sin(t);
      const double y = rock.center_W.y() + u * std::sin(rock.yaw_rad) + w * std::cos(rock.yaw_rad);
      if (std::abs(y) > 0.2) continue;
      least = std::min(least, 2.0 + u * std::cos(rock.yaw_rad) - w * std::sin(rock.yaw_rad));
    }
    const auto contact = FirstContact(rock, 0.0, 0.2);
    ASSERT_EQ(contact.has_value(), least < 1e8) << i;
    if (!contact) continue;
    ++met;
    EXPECT_NEAR(*contact, least, 2e-3) << i;
  }
  EXPECT_GT(met, 100);
}

}  // namespace
}  // namespace rockyard::terrain
