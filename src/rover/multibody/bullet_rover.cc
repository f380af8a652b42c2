#include "rover/multibody/bullet_rover.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include "rover/rover_layout_params.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

// Bullet's vectors hold doubles here (btScalar is double): nothing is rounded.
btVector3 ToBullet(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Vector3 FromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
// Returns the rotation from W, or from a parent, to a frame with the axes R.
btQuaternion ToFrame(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return btQuaternion(q.x(), q.y(), q.z(), q.w()).inverse();
}

}  // namespace

struct BulletRover::Bullet {
  explicit Bullet(const BodyMass& chassis)
      : body(kJoints, chassis.mass_kg, ToBullet(chassis.inertia_kg_m2), /*fixedBase=*/false,
             /*canSleep=*/false) {}

  btMultiBody body;
  // Scratch space that Bullet asks its callers to keep.
  btAlignedObjectArray<btScalar> scalars;
  btAlignedObjectArray<btVector3> vectors;
  btAlignedObjectArray<btMatrix3x3> matrices;
  btAlignedObjectArray<btQuaternion> rotations;
};

BulletRover::BulletRover(const RoverParams& params) {
  const RoverMasses masses = MakeRoverMasses(params);
  bullet_ = std::make_unique<Bullet>(masses.chassis);
  btMultiBody& body = bullet_->body;
  Multibody at_rest(params);
  for (int joint = 0; joint < kJoints; ++joint) {
    const int parent = at_rest.Parent(joint);
    const BodyMass& mass = joint <= kRightRocker ? masses.rocker
                           : joint < kFirstWheel ? masses.bogie
                                                 : masses.wheel;
    // Bullet asks for the vector from the parent's centre of mass, which is at the parent's joint
    // but for the chassis.
    const Vector3 from =
        parent == kChassis ? at_rest.p_WComChassis() : Vector3(at_rest.X_WB(parent).translation());
    body.setupRevolute(joint, mass.mass_kg, ToBullet(mass.inertia_kg_m2), parent,
                       btQuaternion::getIdentity(), btVector3(0, 1, 0),
                       ToBullet(at_rest.X_WB(joint).translation() - from), btVector3(0, 0, 0));
  }
  body.finalizeMultiDof();
  // Bullet damps by default; all losses here are those of the contacts.
  body.setLinearDamping(0.0);
  body.setAngularDamping(0.0);
}

BulletRover::~BulletRover() = default;

void BulletRover::Take(const Multibody& from) {
  btMultiBody& body = bullet_->body;
  body.setBasePos(ToBullet(from.p_WComChassis()));
  body.setWorldToBaseRot(ToFrame(from.X_WR().linear()));
  for (int joint = 0; joint < kJoints; ++joint) {
    if (joint >= kFirstWheel) {
      // Wheels steer by the axes that their joint has at zero; how far they have spun is the same
      // to a body of revolution.
      btMultibodyLink& link = body.getLink(joint);
      link.m_zeroRotParentToThis =
          ToFrame(from.X_WB(from.Parent(joint)).linear().transpose() * from.X_WB(joint).linear());
    }
    body.setJointPos(joint, joint < kFirstWheel ? from.JointAngle(joint) : 0.0);
  }
  body.clearVelocities();
  body.clearForcesAndTorques();
  body.applyDeltaVeeMultiDof(from.Velocity().data(), 1.0);
}

void BulletRover::Accelerate(double step_s) {
  bullet_->body.computeAccelerationsArticulatedBodyAlgorithmMultiDof(
      step_s, bullet_->scalars, bullet_->vectors, bullet_->matrices, false, false, false);
}

DofVector BulletRover::Fall(double gravity_m_s2, double step_s) {
  btMultiBody& body = bullet_->body;
  const DofVector before = Eigen::Map<const DofVector>(body.getVelocityVector());
  body.addBaseForce(btVector3(0, 0, -gravity_m_s2 * body.getBaseMass()));
  for (int joint = 0; joint < kJoints; ++joint) {
    body.addLinkForce(joint, btVector3(0, 0, -gravity_m_s2 * body.getLinkMass(joint)));
  }
  Accelerate(step_s);
  body.clearForcesAndTorques();
  return Eigen::Map<const DofVector>(body.getVelocityVector()) - before;
}

void BulletRover::Move(double step_s) {
  bullet_->body.stepPositionsMultiDof(step_s);
  bullet_->body.forwardKinematics(bullet_->rotations, bullet_->vectors);
}

DofMatrix BulletRover::Inverse() {
  // Fills in the articulated inertias, of which the unit forces make use.
  Accelerate(1e-3);
  DofMatrix inverse;
  for (int dof = 0; dof < kDof; ++dof) {
    const DofVector force = DofVector::Unit(dof);
    bullet_->body.calcAccelerationDeltasMultiDof(force.data(), inverse.col(dof).data(),
                                                 bullet_->scalars, bullet_->vectors);
  }
  return inverse;
}

Vector3 BulletRover::ComChassis() const { return FromBullet(bullet_->body.getBasePos()); }

Vector3 BulletRover::Origin(int joint) const {
  return FromBullet(bullet_->body.getLink(joint).m_cachedWorldTransform.getOrigin());
}

Vector3 BulletRover::Axis(int joint) const {
  return FromBullet(bullet_->body.getLink(joint).m_cachedWorldTransform.getBasis().getColumn(1));
}

}  // namespace rockyard::rover
