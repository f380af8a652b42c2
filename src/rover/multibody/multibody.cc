#include "rover/multibody/multibody.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include "rover/rover_layout_params.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

// Bullet's vectors hold doubles here (btScalar is double): nothing is rounded.
btVector3 ToBullet(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Vector3 FromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

math::Transform FromBullet(const btTransform& X) {
  math::Transform result = math::Transform::Identity();
  for (int row = 0; row < 3; ++row) {
    result.linear().row(row) = FromBullet(X.getBasis().getRow(row));
  }
  result.translation() = FromBullet(X.getOrigin());
  return result;
}

}  // namespace

struct Multibody::Bullet {
  Bullet(double mass_kg, const btVector3& inertia)
      : body(kJoints, mass_kg, inertia, /*fixedBase=*/false, /*canSleep=*/false) {}

  btMultiBody body;
  // Scratch space that Bullet asks its callers to keep.
  btAlignedObjectArray<btScalar> scalars;
  btAlignedObjectArray<btVector3> vectors;
  btAlignedObjectArray<btMatrix3x3> matrices;
  btAlignedObjectArray<btQuaternion> rotations;
};

Multibody::Multibody(const RoverParams& params) : p_RCom_(MakeRoverMasses(params).chassis.com_B) {
  const BodyMass chassis = MakeRoverMasses(params).chassis;
  bullet_ = std::make_unique<Bullet>(chassis.mass_kg, ToBullet(chassis.inertia_kg_m2));
  BuildLinks(params);
  btMultiBody& body = bullet_->body;
  body.finalizeMultiDof();
  // Bullet damps by default; all losses here are those of the contacts.
  body.setLinearDamping(0.0);
  body.setAngularDamping(0.0);
  Reset(math::Transform::Identity());
}

Multibody::~Multibody() = default;

void Multibody::BuildLinks(const RoverParams& params) {
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  const RoverMasses masses = MakeRoverMasses(params);
  std::array<Vector3, kJoints> pivot_R;
  // A link hangs on its parent by a revolute joint about +y at its own frame's origin. Bullet asks
  // for the vector from the parent's centre of mass, which is at the parent's joint but for the
  // chassis.
  const auto add = [&](int joint, int parent, const BodyMass& body, const Vector3& p_R) {
    const Vector3 from = parent == kChassis ? p_RCom_ : pivot_R[static_cast<std::size_t>(parent)];
    pivot_R[static_cast<std::size_t>(joint)] = p_R;
    parent_[static_cast<std::size_t>(joint)] = parent;
    bullet_->body.setupRevolute(joint, body.mass_kg, ToBullet(body.inertia_kg_m2), parent,
                                btQuaternion::getIdentity(), btVector3(0, 1, 0),
                                ToBullet(p_R - from), btVector3(0, 0, 0));
  };
  for (int side = 0; side < 2; ++side) {
    add(kLeftRocker + side, kChassis, masses.rocker,
        geometry.rocker_pivot_R[static_cast<std::size_t>(side)]);
  }
  for (int side = 0; side < 2; ++side) {
    add(kLeftBogie + side, kLeftRocker + side, masses.bogie,
        geometry.bogie_pivot_R[static_cast<std::size_t>(side)]);
  }
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const int side = i < 3 ? 0 : 1;
    add(kFirstWheel + static_cast<int>(i), (geometry.on_bogie[i] ? kLeftBogie : kLeftRocker) + side,
        masses.wheel, geometry.wheel_R[i]);
  }
}

void Multibody::Reset(const math::Transform& X_WR) {
  btMultiBody& body = bullet_->body;
  const Eigen::Quaterniond q(X_WR.linear());
  // Bullet's base frame stands at the chassis' centre of mass, with R's axes; its rotation is W to
  // base.
  body.setBasePos(ToBullet(X_WR * p_RCom_));
  body.setWorldToBaseRot(btQuaternion(q.x(), q.y(), q.z(), q.w()).inverse());
  for (int joint = 0; joint < kJoints; ++joint) body.setJointPos(joint, 0.0);
  StopMotion();
  moved_ = true;
  UpdatePoses();
}

void Multibody::StopMotion() {
  bullet_->body.clearVelocities();
  bullet_->body.clearForcesAndTorques();
}

void Multibody::SetSteer(std::size_t wheel, double angle_rad) {
  btMultibodyLink& link = bullet_->body.getLink(kFirstWheel + static_cast<int>(wheel));
  // Bullet stores the rotation from parent to link, the inverse of the rotation that turns the axle
  // by +angle.
  link.m_zeroRotParentToThis = btQuaternion(btVector3(0, 0, 1), -angle_rad);
  link.updateCacheMultiDof();
  moved_ = true;
}

void Multibody::UpdatePoses() {
  if (!moved_) return;
  moved_ = false;
  btMultiBody& body = bullet_->body;
  body.forwardKinematics(bullet_->rotations, bullet_->vectors);
  X_WR_ = FromBullet(body.getBaseWorldTransform());
  p_WCom_ = X_WR_.translation();
  // From the centre of mass back to R's origin: p_WR = p_WCom - R_WR p_RCom.
  X_WR_.translation() -= X_WR_.linear() * p_RCom_;
  for (int joint = 0; joint < kJoints; ++joint) {
    X_WB_[static_cast<std::size_t>(joint)] = FromBullet(body.getLink(joint).m_cachedWorldTransform);
  }
}

double Multibody::JointAngle(int joint) const { return bullet_->body.getJointPos(joint); }

DofVector Multibody::Velocity() const {
  return Eigen::Map<const DofVector>(bullet_->body.getVelocityVector());
}

void Multibody::Accelerate(double gravity_m_s2, double step_s) {
  btMultiBody& body = bullet_->body;
  body.addBaseForce(btVector3(0, 0, -gravity_m_s2 * body.getBaseMass()));
  for (int joint = 0; joint < kJoints; ++joint) {
    body.addLinkForce(joint, btVector3(0, 0, -gravity_m_s2 * body.getLinkMass(joint)));
  }
  body.computeAccelerationsArticulatedBodyAlgorithmMultiDof(
      step_s, bullet_->scalars, bullet_->vectors, bullet_->matrices, false, false, false);
  body.clearForcesAndTorques();
}

// Generalized velocities have Bullet's order: chassis angular, linear, then the joints.
void Multibody::AddVelocity(const DofVector& change) {
  bullet_->body.applyDeltaVeeMultiDof(change.data(), 1.0);
}

void Multibody::Move(double step_s) {
  bullet_->body.stepPositionsMultiDof(step_s);
  moved_ = true;
}

void Multibody::FillJacobian(int body, const Vector3& p_W, const Vector3& n_W,
                             DofVector& row) const {
  row.setZero();
  // n . v for v = v_com + w x r + sum of joints rate y_B x (p - o_B): n . (w x r) = w . (r x n),
  // and likewise for each joint from the body up to the chassis.
  row.head<3>() = (p_W - p_WCom_).cross(n_W);
  row.segment<3>(3) = n_W;
  for (int joint = body; joint != kChassis; joint = Parent(joint)) {
    const math::Transform& X = X_WB(joint);
    row[6 + joint] = X.linear().col(1).dot((p_W - X.translation()).cross(n_W));
  }
}

}  // namespace rockyard::rover
