// The rover's articulated body once more as Bullet's btMultiBody (Featherstone's articulated-body
// algorithm): what drives by `rover.physics.dynamics` bullet accelerate by, and what the tests hold
// Multibody against. Its bits depend on the C library, which chooses code by processor.
#pragma once

#include <memory>

#include "rover/multibody/multibody.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

class BulletRover {
 public:
  explicit BulletRover(const RoverParams& params);
  ~BulletRover();

  // Takes poses and velocities of a body at its last UpdatePoses.
  void Take(const Multibody& body);
  // Lets gravity and motion act for a step of free fall; returns the change of the velocities.
  DofVector Fall(double gravity_m_s2, double step_s);
  // Moves the positions by a step with the velocities at hand.
  void Move(double step_s);

  // For checks: M^-1, and where things are in W.
  DofMatrix Inverse();
  math::Vector3 ComChassis() const;
  math::Vector3 Origin(int joint) const;
  math::Vector3 Axis(int joint) const;

 private:
  struct Bullet;
  void Accelerate(double step_s);
  std::unique_ptr<Bullet> bullet_;
};

}  // namespace rockyard::rover
