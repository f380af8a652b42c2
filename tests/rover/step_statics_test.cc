// The friction that a step takes, of both fidelities on hard ground, against statics.
#include "rover/step_statics.h"

#include <gtest/gtest.h>

#include "rover/climb.h"

namespace rockyard::rover {
namespace {

constexpr double kEdge_m = 0.006;  // from the edge of a step to its top
constexpr double kFace_x_m = 0.6;

// Statics know no momentum and no stretches: the multibody crawls, and the quasi-static rover takes
// short stretches, one a tick.
bool GetsUp(RoverParams params, double height_m, double friction) {
  params.contact.wheel_rock_friction = friction;
  params.quasi_static.settle_distance_m = 0.0025;
  const double speed_m_s = params.fidelity == Fidelity::kMultibody ? 0.02 : 0.05;
  const double axle_m = 0.5 * params.geometry.wheelbase_m;
  const double start_m = kFace_x_m - axle_m - params.geometry.wheel_radius_m - 0.01;
  const RoverOn rover(StepTerrain(height_m, RigidGround(friction), kEdge_m), params,
                      {start_m, 0.0, 0.0});
  return ClimbAhead(*rover, params, speed_m_s, kFace_x_m + axle_m + 0.02).how == Climb::kUp;
}

// How far the rover's friction may lie from that of statics: contacts give way by 1 mm, and the
// wall of the step has ripples that turn its normal by 1 degree.
constexpr double kTolerance = 0.06;

// Whether a rover is stuck at less friction than statics say and gets up with more. The top is not
// quite flat, so that the step is between as high as its edge and as high as its top.
bool ItsFrictionIs(double edge_friction, double top_friction, const RoverParams& params,
                   double height_m) {
  return !GetsUp(params, height_m, (1.0 - kTolerance) * edge_friction) &&
         GetsUp(params, height_m, (1.0 + kTolerance) * top_friction);
}

double Needed(const RoverParams& params, double height_m) {
  return StepStatics(params, height_m).LeastFriction();
}

// Nose-heavy, with a fifth of its mass in each axle.
RoverParams WithHeavyWheels(RoverParams params) {
  params.mass.wheel_kg = 2.0;
  params.mass.chassis_com_x_m = 0.05;
  return params;
}

class StepFriction : public testing::TestWithParam<Fidelity> {
 protected:
  void ExpectThatOfStatics(const RoverParams& params, std::initializer_list<double> radii) {
    for (const double ratio : radii) {
      const double height_m = ratio * params.geometry.wheel_radius_m;
      const double edge = Needed(params, height_m - kEdge_m);
      const double top = Needed(params, height_m);
      EXPECT_TRUE(ItsFrictionIs(edge, top, params, height_m)) << ratio << " radii, " << top;
    }
  }
  const RoverParams params_ = WithFidelity(GetParam());
  const double radius_m_ = params_.geometry.wheel_radius_m;
};

TEST_P(StepFriction, IsThatOfStatics) {
  ExpectThatOfStatics(params_, {0.3, 0.6, 1.0, 1.5});
  ExpectThatOfStatics(WithHeavyWheels(params_), {0.6, 1.5});
}

// The comparison tells a step from one a quarter lower, and a rover from one whose middle wheels
// stand elsewhere.
TEST_P(StepFriction, IsNotThatOfOtherRoversOrSteps) {
  const double height_m = 0.6 * radius_m_;
  const double lower = Needed(params_, 0.75 * height_m);
  EXPECT_FALSE(ItsFrictionIs(lower, lower, params_, height_m));
  const double face_m = 1.5 * radius_m_;
  RoverParams other = params_;
  other.geometry.middle_wheel_x_m = -0.1;
  const double others = Needed(other, face_m);
  EXPECT_FALSE(ItsFrictionIs(others, others, params_, face_m)) << others;
}

INSTANTIATE_TEST_SUITE_P(Fidelities, StepFriction,
                         testing::Values(Fidelity::kMultibody, Fidelity::kQuasiStatic));

// With its front wheels at a face, all wheels at the limit: the push of the others is what presses
// the front wheels, P = mu (N_m + N_r), which lift mu P. On all, (1 + mu^2) (N_m + N_r) = W; about
// the rear wheel's contact and, on the bogie, about its hinge moments vanish.
TEST(StepStatics, AtAFaceIsTheCubicOfThreeWheels) {
  const RoverParams params = WithHeavyWheels({});
  const RoverGeometryParams& size = params.geometry;
  const double mu = StepStatics(params, 3.0 * size.wheel_radius_m).LeastFriction();
  const Weights weight(params);
  const double sum_N = 0.5 * weight.total_N / (1.0 + mu * mu);
  const double push_N = mu * sum_N;
  const double r = size.wheel_radius_m;
  const double rear_x = -0.5 * size.wheelbase_m;
  // The wheels at the ground push at its height, the front wheels at that of their axles.
  const double middle_N = (0.5 * weight.total_N * (weight.com_x_m - rear_x) - push_N * r -
                           mu * push_N * (0.5 * size.wheelbase_m + r - rear_x)) /
                          (size.middle_wheel_x_m - rear_x);
  const double hinge_x = 0.25 * size.wheelbase_m;
  const double hinge_z = size.bogie_pivot_z_m;
  const double moment_Nm = mu * push_N * (0.5 * size.wheelbase_m + r - hinge_x) +
                           push_N * (r - hinge_z) - middle_N * (hinge_x - size.middle_wheel_x_m) +
                           mu * middle_N * hinge_z;
  EXPECT_NEAR(moment_Nm, 0.0, 0.0002 * 0.5 * weight.total_N * size.wheelbase_m) << mu;
}

// Below a radius every step takes more friction than a lower one; nothing pulls a rover up a face
// that finds no hold before it.
TEST(StepStatics, AHigherEdgeTakesMoreFriction) {
  const RoverParams params;
  double before = 0.0;
  for (double radii = 0.1; radii < 1.05; radii += 0.1) {
    const double friction =
        StepStatics(params, radii * params.geometry.wheel_radius_m).LeastFriction();
    EXPECT_GT(friction, before);
    before = friction;
  }
  const StepStatics face(params, 2.0 * params.geometry.wheel_radius_m);
  EXPECT_GT(face.LeastPull(0.6, 2), face.LeastPull(0.9, 2));
  EXPECT_GT(face.LeastPull(0.9, 2), 0.3);
}

}  // namespace
}  // namespace rockyard::rover
