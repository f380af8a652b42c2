// A braked rover: it comes to rest, does not creep, and never gains energy.
#include <gtest/gtest.h>

#include "rover/multibody/constraint_solver.h"
#include "rover/multibody/joint_space_inertia.h"
#include "rover/wheel_soil.h"
#include "rover_drive.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

// The parts of a step without Rover around them, so that every velocity can be seen.
class BrakedBody {
 public:
  BrakedBody(const RoverParams& params, const terrain::Terrain& terrain)
      : params_(params),
        weights_(params),
        soil_(terrain.ground().soil(), params.geometry.wheel_radius_m,
              params.geometry.wheel_width_m),
        soil_exponent_(terrain.ground().soil().sinkage_exponent),
        body_(params),
        inertia_(params),
        finder_(params.geometry, terrain),
        solver_(params, terrain.ground().soil()) {}

  void Drop(const math::Transform& X_WR) { body_.Reset(X_WR); }

  void Step() {
    body_.UpdatePoses();
    finder_.Update(body_);
    const DofVector before = body_.Velocity();
    body_.Accelerate(params_.physics.gravity_m_s2, params_.physics.step_s);
    inertia_.Update(body_);
    solver_.Solve({inertia_.inverse(), before, {}, params_.physics.step_s}, nullptr, finder_,
                  body_);
    body_.Move(params_.physics.step_s);
  }

  // Kinetic energy of all parts, their height, and what the contacts' springs and the soil under
  // the wheels store.
  double Energy_J() {
    body_.UpdatePoses();
    finder_.Update(body_);
    inertia_.Update(body_);
    const DofVector v = body_.Velocity();
    double energy_J = 0.5 * v.dot(inertia_.mass() * v);
    energy_J += weights_.chassis_N * body_.p_WComChassis().z();
    for (int joint = 0; joint < kJoints; ++joint) {
      const double weight_N = joint <= kRightRocker ? weights_.rocker_N
                              : joint < kFirstWheel ? weights_.bogie_N
                                                    : weights_.wheel_N;
      energy_J += weight_N * body_.X_WB(joint).translation().z();
    }
    for (const Contact& contact : finder_.contacts()) {
      const double depth_m = std::max(0.0, -contact.gap_m);
      const bool on_soil =
          contact.IsSoil() && finder_.part(contact.part).kind == truth::BodyPart::kWheel;
      energy_J +=
          on_soil ? SoilEnergy_J(depth_m) : 0.5 * params_.contact.stiffness_N_m * depth_m * depth_m;
    }
    return energy_J;
  }

  double Speed() const { return body_.Velocity().norm(); }

 private:
  // Integral of the load N over the depth z(N) + N / k, with N ~ z^(n + 1/2).
  double SoilEnergy_J(double depth_m) const {
    const double k = params_.contact.stiffness_N_m;
    const double load_N = Bisect(
        0.0, k * depth_m, [&](double load) { return soil_.Sinkage_m(load) + load / k - depth_m; });
    return load_N * soil_.Sinkage_m(load_N) / (soil_exponent_ + 1.5) + 0.5 * load_N * load_N / k;
  }

  const RoverParams params_;
  const Weights weights_;
  const WheelSoil soil_;
  const double soil_exponent_;
  Multibody body_;
  JointSpaceInertia inertia_;
  ContactFinder finder_;
  ConstraintSolver solver_;
};

math::Transform Lifted(double height_m, double roll_rad, double pitch_rad) {
  math::Transform X_WR = math::Transform::Identity();
  X_WR.linear() = (Eigen::AngleAxisd(pitch_rad, math::Vector3::UnitY()) *
                   Eigen::AngleAxisd(roll_rad, math::Vector3::UnitX()))
                      .toRotationMatrix();
  X_WR.translation().z() = height_m;
  return X_WR;
}

// Largest gain in one step from a drop to the rest ten seconds later, of
//   E = 1/2 v M v + sum m g z + 1/2 k d^2
// and, under wheels, the work of the sinkage law, which rebounds as the springs do.
double LargestGain_J(double step_s, const terrain::SoilParams& soil, const math::Transform& X_WR,
                     const std::vector<terrain::Rock>& rocks) {
  RoverParams params{.physics = {.step_s = step_s}};
  terrain::GroundParams ground{.soil = soil};
  const terrain::Terrain terrain(terrain::Ground(ground, {}), rocks, {});
  BrakedBody body(params, terrain);
  body.Drop(X_WR);
  double last_J = body.Energy_J();
  double gain_J = 0.0;
  for (int i = 0; i < std::lround(10.0 / step_s); ++i) {
    body.Step();
    const double energy_J = body.Energy_J();
    gain_J = std::max(gain_J, energy_J - last_J);
    last_J = energy_J;
  }
  EXPECT_LT(body.Speed(), 1e-6);
  return gain_J;
}

// A contact's normal turns while it rolls or slides within one step, which the step does not see:
// some (v h)^2 / 2 r of depth, 20 um at 0.1 m/s, times a force of 50 N, is the bound of 1 to 2 mJ
// (of 30 J that a drop takes away), and it shrinks with the square of the step.
TEST(Energy, NeverGrowsFromADropToTheRest) {
  const std::vector<terrain::Rock> rocks{MakeRock(0.26, 0.2, 0.0, 0.15, 0.15, 0.08),
                                         MakeRock(-0.2, -0.2, 0.0, 0.12, 0.2, 0.06)};
  for (const double rate_Hz : {60.0, 240.0}) {
    const double bound_J = 2e-3 * std::pow(60.0 / rate_Hz, 2.0);
    for (const terrain::SoilParams& soil :
         {RigidGround(0.8), terrain::MakeSoil(terrain::SoilPreset::kLandscapingSand),
          terrain::MakeSoil(terrain::SoilPreset::kMarsDrift)}) {
      SCOPED_TRACE(testing::Message()
                   << rate_Hz << " Hz, sinkage exponent " << soil.sinkage_exponent);
      const double step_s = 1.0 / rate_Hz;
      EXPECT_LT(LargestGain_J(step_s, soil, Lifted(0.02, 0.0, 0.0), {}), bound_J);
      EXPECT_LT(LargestGain_J(step_s, soil, Lifted(0.06, 0.09, -0.09), {}), bound_J);
      EXPECT_LT(LargestGain_J(step_s, soil, Lifted(0.12, 0.0, 0.0), rocks), bound_J);
    }
  }
}

TEST(Rest, BrakedRoverDoesNotCreep) {
  const std::vector<terrain::Rock> rocks{MakeRock(0.26, 0.2, 0.0, 0.15, 0.15, 0.08),
                                         MakeRock(-0.2, -0.2, 0.0, 0.12, 0.2, 0.06)};
  for (const double slope_deg : {0.0, 12.0, 20.0}) {
    for (const auto& on : {std::vector<terrain::Rock>{}, rocks}) {
      if (slope_deg > 0.0 && !on.empty()) continue;  // rocks stand on level ground
      terrain::GroundParams ground{.slope_rad = math::DegToRad(slope_deg),
                                   .slope_direction_rad = 0.7};
      const RoverOn rover(terrain::Terrain(terrain::Ground(ground, {}), on, {}));
      RunFor(*rover, kBraked, 5.0);
      const math::Vector3 from = rover->state().X_WR.translation();
      double fastest_m_s = 0.0;
      for (int i = 0; i < 1800; ++i) {
        rover->Step(kBraked);
        fastest_m_s = std::max(fastest_m_s, rover->state().v_WR_m_s.norm());
      }
      EXPECT_LT(fastest_m_s, 1e-6) << slope_deg;
      EXPECT_LT((rover->state().X_WR.translation() - from).norm(), 1e-6) << slope_deg;
    }
  }
}

}  // namespace
}  // namespace rockyard::rover
