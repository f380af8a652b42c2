// The joint-space mass matrix of the articulated body and its inverse, by which RockerBogie lets
// the constraint solver turn impulses into velocities. Records depend on the bits of both, as the
// inverse is made of M.
#pragma once

#include "rover/multibody/multibody.h"
#include "rover/rover_layout_params.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// M and M^-1 for generalized velocities in the order of DofVector: kinetic energy is 1/2 v' M v,
// and a generalized force f accelerates the free body by M^-1 f. M comes from composite rigid
// bodies (Featherstone 2008 ch. 6). M^-1 eliminates joints from the leaves down to the chassis, as
// a joint couples only with its ancestors and descendants (Featherstone 2005, Int. J. Robotics
// Research 24(6)).
class JointSpaceInertia {
 public:
  explicit JointSpaceInertia(const RoverParams& params);

  // Computes both for the poses that `body` had at its last UpdatePoses; about 1 us.
  void Update(const Multibody& body);

  const DofMatrix& mass() const { return mass_; }
  const DofMatrix& inverse() const { return inverse_; }

 private:
  void FillMass(const Multibody& body);
  void FillInverse(const Multibody& body);

  const RoverMasses masses_;
  DofMatrix mass_ = DofMatrix::Zero();
  DofMatrix inverse_ = DofMatrix::Zero();
};

}  // namespace rockyard::rover
