#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyGearConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletCollisionCommon.h>

#include "peer.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

constexpr int kGround = 64;
constexpr int kRock = 128;
constexpr int kWheel = 256;
constexpr int kOther = 512;

btVector3 ToBullet(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

class BulletPeer : public Peer {
 public:
  explicit BulletPeer(const PeerScene& scene)
      : scene_(scene),
        dispatcher_(&config_),
        world_(&dispatcher_, &broadphase_, &solver_, &config_),
        body_(kJoints, scene.chassis.mass_kg, ToBullet(scene.chassis.inertia_kg_m2),
              /*fixedBase=*/false, /*canSleep=*/false) {
    world_.setGravity(btVector3(0, 0, -scene.params.physics.gravity_m_s2));
    world_.getSolverInfo().m_numIterations = scene.iterations;
    AddStill(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0.0), Vector3::Zero(),
             kGround, kWheel);
    for (const Ball& ball : scene.balls) {
      AddStill(std::make_unique<btSphereShape>(ball.radius_m), ball.center_W, kRock,
               kWheel | kOther);
    }
    AddBody();
    for (int body = kChassis; body < kJoints; ++body) AddCollider(body);
    AddConstraints();
  }
  ~BulletPeer() override {
    for (const auto& constraint : constraints_) world_.removeMultiBodyConstraint(constraint.get());
    world_.removeMultiBody(&body_);
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }
  BulletPeer(const BulletPeer&) = delete;
  BulletPeer& operator=(const BulletPeer&) = delete;

  void Step(double rate_rad_s) override {
    for (btMultiBodyJointMotor* motor : motors_) motor->setVelocityTarget(rate_rad_s);
    world_.stepSimulation(scene_.step_s, 0);
  }

  math::Transform X_WR() const override {
    const btQuaternion q = body_.getWorldToBaseRot().inverse();
    const btVector3& p = body_.getBasePos();
    math::Transform X = math::Transform::Identity();
    X.linear() = Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).toRotationMatrix();
    X.translation() = Vector3(p.x(), p.y(), p.z()) - X.linear() * scene_.chassis.com_B;
    return X;
  }

  messages::PerWheel<double> WheelAngles() const override {
    messages::PerWheel<double> angles{};
    for (std::size_t i = 0; i < angles.size(); ++i) {
      angles[i] = body_.getJointPos(kFirstWheel + static_cast<int>(i));
    }
    return angles;
  }

 private:
  template <typename Shape>
  Shape* Keep(std::unique_ptr<Shape> shape) {
    Shape* const kept = shape.get();
    shapes_.push_back(std::move(shape));
    return kept;
  }

  // All contacts have rockyard's spring and damper. The friction of a pair is the product of both.
  void AddObject(std::unique_ptr<btCollisionObject> object, double friction, int is, int meets) {
    object->setFriction(friction);
    object->setContactStiffnessAndDamping(scene_.params.contact.stiffness_N_m,
                                          scene_.params.contact.damping_Ns_m);
    world_.addCollisionObject(object.get(), is, meets);
    objects_.push_back(std::move(object));
  }

  void AddStill(std::unique_ptr<btCollisionShape> shape, const Vector3& at_W, int is, int meets) {
    auto object = std::make_unique<btCollisionObject>();
    object->setCollisionShape(Keep(std::move(shape)));
    object->setWorldTransform(btTransform(btQuaternion::getIdentity(), ToBullet(at_W)));
    AddObject(std::move(object), 1.0, is, meets);
  }

  void AddBody() {
    for (int joint = 0; joint < kJoints; ++joint) {
      const PeerLink& link = scene_.links[static_cast<std::size_t>(joint)];
      Vector3 from = scene_.FromParent(static_cast<std::size_t>(joint));
      if (link.parent == kChassis) from -= scene_.chassis.com_B;
      body_.setupRevolute(joint, link.mass.mass_kg, ToBullet(link.mass.inertia_kg_m2), link.parent,
                          btQuaternion::getIdentity(), btVector3(0, 1, 0), ToBullet(from),
                          btVector3(0, 0, 0), /*disableParentCollision=*/true);
    }
    body_.finalizeMultiDof();
    body_.setBasePos(ToBullet(scene_.chassis.com_B));
    body_.setLinearDamping(0.0);
    body_.setAngularDamping(0.0);
    body_.setHasSelfCollision(false);
    world_.addMultiBody(&body_);
  }

  std::unique_ptr<btConvexShape> ShapeOf(const Part& part) {
    const double m = part.margin_m;
    std::unique_ptr<btConvexInternalShape> shape;
    if (part.core == Core::kCylinder) {
      shape = std::make_unique<btCylinderShape>(
          btVector3(part.b_B.x() + m, part.b_B.y() + m, part.b_B.x() + m));
    } else if (part.core == Core::kBox) {
      shape = std::make_unique<btBoxShape>(ToBullet(part.b_B + Vector3::Constant(m)));
    } else if (part.a_B == part.b_B) {
      return std::make_unique<btSphereShape>(m);
    } else {
      return std::make_unique<btCapsuleShape>(m, (part.b_B - part.a_B).norm());
    }
    // Bullet's margin rounds the edges of shapes as rockyard's does.
    shape->setMargin(m);
    return shape;
  }

  static btTransform Placed(const Part& part, const Vector3& com_B) {
    const Vector3 along = part.b_B - part.a_B;
    const bool capsule = part.core == Core::kSegment && part.a_B != part.b_B;
    const Eigen::Quaterniond q = capsule
                                     ? Eigen::Quaterniond::FromTwoVectors(Vector3::UnitY(), along)
                                     : Eigen::Quaterniond::Identity();
    const Vector3 at_B = capsule ? Vector3(0.5 * (part.a_B + part.b_B)) : part.a_B;
    return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), ToBullet(at_B - com_B));
  }

  void AddCollider(int body) {
    const Vector3 com_B = body == kChassis ? scene_.chassis.com_B : Vector3::Zero();
    btCollisionShape* shape = nullptr;
    if (body >= kFirstWheel) {
      shape = Keep(ShapeOf(scene_.parts[static_cast<std::size_t>(body - kFirstWheel)]));
    } else {
      btCompoundShape* const compound = Keep(std::make_unique<btCompoundShape>());
      for (const Part& part : scene_.parts) {
        if (part.body != body) continue;
        compound->addChildShape(Placed(part, com_B), Keep(ShapeOf(part)));
      }
      shape = compound;
    }
    auto collider = std::make_unique<btMultiBodyLinkCollider>(&body_, body);
    collider->setCollisionShape(shape);
    const Vector3 at_W =
        body == kChassis ? com_B : scene_.links[static_cast<std::size_t>(body)].origin_R;
    collider->setWorldTransform(btTransform(btQuaternion::getIdentity(), ToBullet(at_W)));
    if (body == kChassis) {
      body_.setBaseCollider(collider.get());
    } else {
      body_.getLink(body).m_collider = collider.get();
    }
    const bool wheel = body >= kFirstWheel;
    AddObject(std::move(collider), scene_.params.contact.wheel_rock_friction,
              wheel ? kWheel : kOther, wheel ? kGround | kRock : kRock);
  }

  void AddConstraints() {
    auto gear = std::make_unique<btMultiBodyGearConstraint>(
        &body_, kLeftRocker, &body_, kRightRocker, btVector3(0, 0, 0), btVector3(0, 0, 0),
        btMatrix3x3::getIdentity(), btMatrix3x3::getIdentity());
    gear->setGearRatio(1.0);
    gear->setErp(0.2);
    gear->setMaxAppliedImpulse(1e6);
    constraints_.push_back(std::move(gear));
    for (int joint = kFirstWheel; joint < kJoints; ++joint) {
      auto motor = std::make_unique<btMultiBodyJointMotor>(
          &body_, joint, 0.0, scene_.params.drive.stall_torque_Nm * scene_.step_s);
      motors_.push_back(motor.get());
      constraints_.push_back(std::move(motor));
    }
    for (const auto& constraint : constraints_) {
      world_.addMultiBodyConstraint(constraint.get());
      constraint->finalizeMultiDof();
    }
  }

  PeerScene scene_;
  btDefaultCollisionConfiguration config_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_;
  btMultiBody body_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> constraints_;
  std::vector<btMultiBodyJointMotor*> motors_;
};

}  // namespace

std::unique_ptr<Peer> MakeBullet(const PeerScene& scene) {
  return std::make_unique<BulletPeer>(scene);
}

}  // namespace rockyard::rover
