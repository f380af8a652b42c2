// The rocker-bogie rover: the articulated body under contacts and constraints. It
// is the default fidelity, made by MakeRover, against which the quasi-static rover is held.
#pragma once

#include <optional>

#include "rover/motor_ramp.h"
#include "rover/multibody/bullet_rover.h"
#include "rover/multibody/constraint_solver.h"
#include "rover/multibody/contact_finder.h"
#include "rover/multibody/joint_space_inertia.h"
#include "rover/multibody/loose_rocks.h"
#include "rover/multibody/multibody.h"
#include "rover/rover.h"

namespace rockyard::rover {

// The rover with inertia. It draws no random numbers; tests/rover/rover_benchmark.cc measures its
// cost.
class RockerBogie final : public Rover {
 public:
  // Make a rover on fixed rocks, and a rover on rocks that it can push.
  RockerBogie(const RoverParams& params, const terrain::Terrain& terrain);
  RockerBogie(const RoverParams& params, const terrain::RockHoldingParams& holding,
              terrain::Terrain& terrain);

  void Place(const math::Pose2& X_WR) override;
  // Throws std::runtime_error when the solution has blown up: a velocity that is not finite or
  // that no rover reaches.
  void Step(const messages::WheelCommand& command) override;
  double step_s() const override { return params_.physics.time_scale * params_.physics.step_s; }
  double ramp_s() const override { return params_.physics.time_scale * params_.drive.ramp_s; }
  const truth::RoverState& state() const override { return state_; }

 private:
  math::Transform LiftedPose(const math::Pose2& X_WR) const;
  void SetSteer(std::size_t wheel, double angle_rad);
  // Returns in how many parts the next step is made.
  int Substeps(const messages::PerWheel<double>& commanded_rad_s);
  void Advance(const messages::PerWheel<double>& commanded_rad_s, int parts, int patience);
  void Settle();
  void UpdateState();
  void UpdateContacts(const DofVector& velocity);
  void CheckMotion(const DofVector& velocity) const;

  const RoverParams params_;
  const messages::PerWheel<bool> steered_;
  const terrain::Terrain& terrain_;
  Multibody body_;
  JointSpaceInertia inertia_;
  std::optional<BulletRover> bullet_;  // where it accelerates the body
  ContactFinder finder_;
  ConstraintSolver solver_;
  MotorRamp motors_;
  messages::PerWheel<double> commanded_rad_s_{};  // by the last step
  int short_steps_left_ = 0;
  std::optional<LooseRocks> loose_rocks_;
  messages::PerWheel<double> angle_at_place_rad_{};
  truth::RoverState state_;
};

}  // namespace rockyard::rover
