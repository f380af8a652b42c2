// The quasi-static rover against the multibody one: the same commands in the same fields.
#include <gtest/gtest.h>

#include <algorithm>

#include "fields.h"

namespace rockyard::rover {
namespace {

constexpr double kTick_s = 0.05;

double Roll(const math::Transform& X) { return std::atan2(X.linear()(2, 1), X.linear()(2, 2)); }

double Percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Differences {
  std::vector<double> pitch_rad, roll_rad, bogie_rad;  // every tick
  std::vector<double> distance_m, heading_rad;         // at the end of each drive
};

// Straight over ten fields of rocks up to 22 cm, 20 s each.
Differences Compare(const RoverParams& multibody, const RoverParams& quasi_static,
                    double pointedness = 0.0) {
  Differences differences;
  for (int field = 0; field < 10; ++field) {
    const terrain::Terrain terrain = ScatteredRocks(0.00415, 0.22, field, pointedness);
    const auto a = MakeRover(multibody, terrain);
    const auto b = MakeRover(quasi_static, terrain);
    a->Place({});
    b->Place({});
    const messages::WheelCommand command = Drive(multibody, 0.15, 0.0);
    for (int tick = 0; tick < 400; ++tick) {
      RunFor(*a, command, kTick_s);
      RunFor(*b, command, kTick_s);
      const truth::RoverState& s = a->state();
      const truth::RoverState& t = b->state();
      differences.pitch_rad.push_back(std::abs(Pitch(s.X_WR) - Pitch(t.X_WR)));
      differences.roll_rad.push_back(std::abs(Roll(s.X_WR) - Roll(t.X_WR)));
      differences.bogie_rad.push_back(std::abs(s.left_bogie_rad - t.left_bogie_rad));
    }
    const math::Transform& X = a->state().X_WR;
    const math::Transform& Y = b->state().X_WR;
    differences.distance_m.push_back((X.translation() - Y.translation()).norm());
    differences.heading_rad.push_back(
        std::abs(math::WrapAngle(math::Heading(X) - math::Heading(Y))));
  }
  return differences;
}

void ExpectSamePosture(double pointedness) {
  const Differences d = Compare(RoverParams{}, WithFidelity(Fidelity::kQuasiStatic), pointedness);
  EXPECT_LT(Percentile(d.pitch_rad, 0.5), math::DegToRad(0.05));
  EXPECT_LT(Percentile(d.pitch_rad, 0.95), math::DegToRad(0.5));
  EXPECT_LT(Percentile(d.roll_rad, 0.5), math::DegToRad(0.05));
  EXPECT_LT(Percentile(d.roll_rad, 0.95), math::DegToRad(0.5));
  EXPECT_LT(Percentile(d.bogie_rad, 0.95), math::DegToRad(1.0));
  EXPECT_LT(Percentile(d.distance_m, 0.5), 0.03);
  EXPECT_LT(Percentile(d.heading_rad, 0.5), math::DegToRad(1.5));
}

TEST(QuasiStaticDifferential, PostureFollowsTheMultibody) { ExpectSamePosture(0.0); }

// Rocks that are nearly cones: steps begin at once instead of gently.
TEST(QuasiStaticDifferential, PostureFollowsTheMultibodyOnPointedRocks) { ExpectSamePosture(0.87); }

// Negative control: another rover (wheels 5 mm smaller) fails the bound.
TEST(QuasiStaticDifferential, SeesAnotherWheelRadius) {
  RoverParams quasi_static = WithFidelity(Fidelity::kQuasiStatic);
  quasi_static.geometry.wheel_radius_m -= 0.005;
  EXPECT_GT(Percentile(Compare(RoverParams{}, quasi_static).distance_m, 0.5), 0.03);
}

}  // namespace
}  // namespace rockyard::rover
