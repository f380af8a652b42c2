#include <ode/ode.h>

#include <algorithm>
#include <stdexcept>

#include "peer.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

constexpr unsigned long kGround = 1;
constexpr unsigned long kRock = 2;
constexpr unsigned long kWheel = 4;
constexpr unsigned long kOther = 8;
constexpr int kContacts = 4;  // of a pair, at most

// ODE's joints know two bodies, and the differential has three: a beam that turns about the
// vertical on the chassis is linked by rods to levers on both rockers, as on real rovers.
constexpr double kBeam_kg = 0.05;
constexpr double kLever_m = 0.1;
constexpr double kRod_m = 0.3;

void InitOnce() {
  static const bool done = dInitODE2(0) != 0 && dCheckConfiguration("ODE_double_precision") != 0;
  if (!done) throw std::runtime_error("ODE in double precision does not start");
}

class Ode : public Peer {
 public:
  Ode(const PeerScene& scene, bool quick) : scene_(scene), quick_(quick) {
    InitOnce();
    dRandSetSeed(0);  // it sweeps the rows in random order
    world_ = dWorldCreate();
    rover_ = dSimpleSpaceCreate(nullptr);
    still_ = dSimpleSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, 0, 0, -scene.params.physics.gravity_m_s2);
    dWorldSetQuickStepNumIterations(world_, scene.iterations);
    Add(dCreatePlane(still_, 0, 0, 1, 0), kGround, kWheel);
    for (const Ball& ball : scene.balls) {
      const dGeomID geom = dCreateSphere(still_, ball.radius_m);
      dGeomSetPosition(geom, ball.center_W.x(), ball.center_W.y(), ball.center_W.z());
      Add(geom, kRock, kWheel | kOther);
    }
    com_ = scene.chassis.com_B;
    chassis_ = MakeBody(scene.chassis, com_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) AddLink(i);
    for (const Part& part : scene.parts) AddPart(part);
    AddDifferential();
  }
  ~Ode() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(rover_);
    dSpaceDestroy(still_);
    dWorldDestroy(world_);
  }
  Ode(const Ode&) = delete;
  Ode& operator=(const Ode&) = delete;

  void Step(double rate_rad_s) override {
    for (std::size_t i = kFirstWheel; i < hinges_.size(); ++i) {
      dJointSetHingeParam(hinges_[i], dParamVel, rate_rad_s);
    }
    dSpaceCollide2(reinterpret_cast<dGeomID>(rover_), reinterpret_cast<dGeomID>(still_), this,
                   [](void* self, dGeomID a, dGeomID b) { static_cast<Ode*>(self)->Touch(a, b); });
    if (quick_) {
      dWorldQuickStep(world_, scene_.step_s);
    } else {
      dWorldStep(world_, scene_.step_s);
    }
    dJointGroupEmpty(contacts_);
  }

  math::Transform X_WR() const override {
    const dReal* q = dBodyGetQuaternion(chassis_);
    const dReal* p = dBodyGetPosition(chassis_);
    math::Transform X = math::Transform::Identity();
    X.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    X.translation() = Vector3(p[0], p[1], p[2]) - X.linear() * com_;
    return X;
  }

  messages::PerWheel<double> WheelAngles() const override {
    messages::PerWheel<double> angles{};
    for (std::size_t i = 0; i < angles.size(); ++i) {
      angles[i] = dJointGetHingeAngle(hinges_[kFirstWheel + i]);
    }
    return angles;
  }

 private:
  static void Add(dGeomID geom, unsigned long is, unsigned long meets) {
    dGeomSetCategoryBits(geom, is);
    dGeomSetCollideBits(geom, meets);
  }

  dBodyID MakeBody(const BodyMass& mass, const Vector3& at_W) {
    const dBodyID body = dBodyCreate(world_);
    dMass m;
    dMassSetParameters(&m, mass.mass_kg, 0, 0, 0, mass.inertia_kg_m2.x(), mass.inertia_kg_m2.y(),
                       mass.inertia_kg_m2.z(), 0, 0, 0);
    dBodySetMass(body, &m);
    dBodySetPosition(body, at_W.x(), at_W.y(), at_W.z());
    return body;
  }

  void AddLink(std::size_t i) {
    const PeerLink& link = scene_.links[i];
    bodies_[i] = MakeBody(link.mass, link.origin_R);
    hinges_[i] = dJointCreateHinge(world_, nullptr);
    dJointAttach(
        hinges_[i], bodies_[i],
        link.parent == kChassis ? chassis_ : bodies_[static_cast<std::size_t>(link.parent)]);
    dJointSetHingeAnchor(hinges_[i], link.origin_R.x(), link.origin_R.y(), link.origin_R.z());
    dJointSetHingeAxis(hinges_[i], 0, 1, 0);
    if (i < kFirstWheel) return;
    dJointSetHingeParam(hinges_[i], dParamFMax, scene_.params.drive.stall_torque_Nm);
  }

  void AddPart(const Part& part) {
    const double m = part.margin_m;
    dMatrix3 turn;
    dRSetIdentity(turn);
    Vector3 at_B = part.a_B;
    dGeomID geom = nullptr;
    if (part.core == Core::kCylinder) {
      geom = dCreateCylinder(rover_, part.b_B.x() + m, 2.0 * (part.b_B.y() + m));
      dRFromZAxis(turn, 0, 1, 0);
    } else if (part.core == Core::kBox) {
      const Vector3 sides = 2.0 * (part.b_B + Vector3::Constant(m));
      geom = dCreateBox(rover_, sides.x(), sides.y(), sides.z());
    } else if (part.a_B == part.b_B) {
      geom = dCreateSphere(rover_, m);
    } else {
      const Vector3 along = part.b_B - part.a_B;
      geom = dCreateCapsule(rover_, m, along.norm());
      at_B = 0.5 * (part.a_B + part.b_B);
      dRFromZAxis(turn, along.x(), along.y(), along.z());
    }
    if (part.body == kChassis) at_B -= com_;
    dGeomSetBody(geom,
                 part.body == kChassis ? chassis_ : bodies_[static_cast<std::size_t>(part.body)]);
    dGeomSetOffsetPosition(geom, at_B.x(), at_B.y(), at_B.z());
    if (part.core != Core::kPoint) dGeomSetOffsetRotation(geom, turn);
    if (part.meets == Meets::kEverything) {
      Add(geom, kWheel, kGround | kRock);
    } else {
      Add(geom, kOther, kRock);
    }
  }

  void AddDifferential() {
    const Vector3& pivot = scene_.links[0].origin_R;
    const double z = pivot.z() + kLever_m;
    const dBodyID beam =
        MakeBody({.mass_kg = kBeam_kg,
                  .inertia_kg_m2 = kBeam_kg / 3.0 * pivot.y() * pivot.y() * Vector3(1.0, 0.1, 1.0)},
                 Vector3(pivot.x() - kRod_m, 0.0, z));
    const dJointID hinge = dJointCreateHinge(world_, nullptr);
    dJointAttach(hinge, beam, chassis_);
    dJointSetHingeAnchor(hinge, pivot.x() - kRod_m, 0.0, z);
    dJointSetHingeAxis(hinge, 0, 0, 1);
    for (std::size_t side = 0; side < 2; ++side) {
      const double y = scene_.links[side].origin_R.y();
      const dJointID rod = dJointCreateDBall(world_, nullptr);
      dJointAttach(rod, beam, bodies_[side]);
      dJointSetDBallAnchor1(rod, pivot.x() - kRod_m, y, z);
      dJointSetDBallAnchor2(rod, pivot.x(), y, z);
    }
  }

  void Touch(dGeomID a, dGeomID b) {
    std::array<dContact, kContacts> touch{};
    const int count = dCollide(a, b, kContacts, &touch[0].geom, sizeof(dContact));
    const double k = scene_.params.contact.stiffness_N_m;
    const double d = scene_.params.contact.damping_Ns_m;
    const double h = scene_.step_s;
    // Friction is a pyramid: its edges lie along and across the wheel.
    const dReal* R = dBodyGetRotation(dGeomGetBody(a));
    const Vector3 axle_W(R[1], R[5], R[9]);
    for (int i = 0; i < count; ++i) {
      dContact& contact = touch[static_cast<std::size_t>(i)];
      const dReal* n = contact.geom.normal;
      const Vector3 ahead_W = axle_W.cross(Vector3(n[0], n[1], n[2])).normalized();
      std::copy(ahead_W.begin(), ahead_W.end(), contact.fdir1);
      dSurfaceParameters& surface = contact.surface;
      surface.mode = dContactApprox1 | dContactFDir1 | dContactSoftERP | dContactSoftCFM;
      surface.mu = surface.mu2 = scene_.params.contact.wheel_rock_friction;
      surface.soft_erp = h * k / (h * k + d);
      surface.soft_cfm = 1.0 / (h * k + d);
      const dJointID joint = dJointCreateContact(world_, contacts_, &contact);
      dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
    }
  }

  PeerScene scene_;
  bool quick_;
  dWorldID world_;
  dSpaceID rover_, still_;
  dJointGroupID contacts_;
  Vector3 com_;
  dBodyID chassis_;
  std::array<dBodyID, kJoints> bodies_{};
  std::array<dJointID, kJoints> hinges_{};
};

}  // namespace

std::unique_ptr<Peer> MakeOde(const PeerScene& scene, bool quick) {
  return std::make_unique<Ode>(scene, quick);
}

}  // namespace rockyard::rover
