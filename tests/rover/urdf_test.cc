// The URDF of each rover, read back by urdfdom.

#include "rover/urdf.h"

#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>

#include "math/pose.h"
#include "rover/rover_layout_params.h"
#include "scenario/load.h"

namespace rockyard::rover {
namespace {

using math::Transform;
using math::Vector3;

constexpr std::array<const char*, messages::kWheelCount> kWheels{
    "left_front", "left_middle", "left_rear", "right_front", "right_middle", "right_rear"};

Transform ToTransform(const urdf::Pose& pose) {
  Transform X = Transform::Identity();
  X.translation() = Vector3(pose.position.x, pose.position.y, pose.position.z);
  X.linear() =
      Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z)
          .toRotationMatrix();
  return X;
}

class Urdf : public testing::TestWithParam<const char*> {
 protected:
  urdf::JointConstSharedPtr Joint(const std::string& name) const {
    const auto joint = model_->getJoint(name);
    EXPECT_TRUE(joint) << name;
    return joint;
  }
  urdf::LinkConstSharedPtr Link(const std::string& name) const {
    const auto link = model_->getLink(name);
    EXPECT_TRUE(link) << name;
    return link;
  }

  // Pose of a link in the chassis' frame with the given angle in one joint and zero in the others.
  Transform Pose(const std::string& link_name, const std::string& moved = "",
                 double angle_rad = 0.0) const {
    Transform X = Transform::Identity();
    for (auto link = Link(link_name); link->parent_joint; link = link->getParent()) {
      const urdf::Joint& joint = *link->parent_joint;
      Transform X_PL = ToTransform(joint.parent_to_joint_origin_transform);
      if (joint.name == moved) {
        X_PL.rotate(
            Eigen::AngleAxisd(angle_rad, Vector3(joint.axis.x, joint.axis.y, joint.axis.z)));
      }
      X = X_PL * X;
    }
    return X;
  }

  const RoverParams params_ =
      scenario::ParseScenario(
          R"({"rover": {"extends": ")" + std::string(GetParam()) + R"(.json"}})", {},
          std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/rovers")
          .drive.rover;
  const RoverGeometry geometry_ = MakeRoverGeometry(params_.geometry);
  const urdf::ModelInterfaceSharedPtr model_ = urdf::parseURDF(WriteUrdf(params_));
};

TEST_P(Urdf, HasTheLinksOfTheRover) {
  ASSERT_TRUE(model_);
  EXPECT_EQ(model_->getRoot()->name, "chassis");
  std::size_t steered = 0;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const std::string name = kWheels[i];
    steered += geometry_.steered[i] ? 1 : 0;
    EXPECT_EQ(model_->getLink(name + "_knuckle") != nullptr, geometry_.steered[i]) << name;
    EXPECT_TRUE(Link(name + "_wheel"));
  }
  // Chassis, rockers, bogies, wheels, knuckles; one joint for each but the chassis.
  EXPECT_EQ(model_->links_.size(), 11 + steered);
  EXPECT_EQ(model_->joints_.size(), 10 + steered);
}

TEST_P(Urdf, MassesSumToTheRover) {
  double sum_kg = 0.0;
  Vector3 moment_kg_m = Vector3::Zero();
  for (const auto& [name, link] : model_->links_) {
    ASSERT_TRUE(link->inertial) << name;
    EXPECT_GT(link->inertial->mass, 0.0) << name;
    sum_kg += link->inertial->mass;
    moment_kg_m +=
        link->inertial->mass * (Pose(name) * ToTransform(link->inertial->origin)).translation();
  }
  EXPECT_NEAR(sum_kg, params_.mass.total_kg, 1e-9);
  const RoverMasses m = MakeRoverMasses(params_);
  Vector3 expected = m.chassis.mass_kg * m.chassis.com_B;
  for (std::size_t side = 0; side < 2; ++side) {
    expected += m.rocker.mass_kg * geometry_.rocker_pivot_R[side] +
                m.bogie.mass_kg * geometry_.bogie_pivot_R[side];
  }
  for (const Vector3& wheel_R : geometry_.wheel_R) expected += m.wheel.mass_kg * wheel_R;
  EXPECT_NEAR((moment_kg_m - expected).norm(), 0.0, 1e-9);
}

TEST_P(Urdf, WheelAndKnuckleTogetherHaveTheWheelsInertia) {
  const RoverMasses m = MakeRoverMasses(params_);
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    Vector3 sum = Vector3::Zero();
    for (const char* part : {"_wheel", "_knuckle"}) {
      const auto link = model_->getLink(kWheels[i] + std::string(part));
      if (link) sum += Vector3(link->inertial->ixx, link->inertial->iyy, link->inertial->izz);
    }
    EXPECT_NEAR((sum - m.wheel.inertia_kg_m2).norm(), 0.0, 1e-12) << kWheels[i];
  }
  const auto& chassis = *Link("chassis")->inertial;
  EXPECT_EQ(Vector3(chassis.ixx, chassis.iyy, chassis.izz), m.chassis.inertia_kg_m2);
}

TEST_P(Urdf, WheelCentresAreWhereTheGeometryHasThem) {
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const Transform X_RWheel = Pose(std::string(kWheels[i]) + "_wheel");
    EXPECT_NEAR((X_RWheel.translation() - geometry_.wheel_R[i]).norm(), 0.0, 1e-9) << kWheels[i];
    EXPECT_TRUE(X_RWheel.linear().isIdentity(1e-12));
  }
}

// A steering joint turns the axle about the wheel's centre; a rocker turns all its wheels about the
// rocker pivot, positive about +y as in the simulation.
TEST_P(Urdf, JointsTurnAboutTheirPivots) {
  const Transform steered = Pose("left_front_wheel", "left_front_steering_joint", 0.5);
  EXPECT_NEAR((steered.translation() - geometry_.wheel_R[0]).norm(), 0.0, 1e-9);
  EXPECT_NEAR(steered.linear()(1, 0), std::sin(0.5), 1e-12);
  const Vector3 pivot = geometry_.rocker_pivot_R[1];
  const Eigen::AngleAxisd turn(0.3, Vector3::UnitY());
  for (std::size_t i = 3; i < messages::kWheelCount; ++i) {
    const Transform lifted = Pose(std::string(kWheels[i]) + "_wheel", "right_rocker_joint", 0.3);
    EXPECT_NEAR((lifted.translation() - pivot - turn * (geometry_.wheel_R[i] - pivot)).norm(), 0.0,
                1e-9);
  }
}

TEST_P(Urdf, LimitsAreThoseOfTheRover) {
  const auto expect_limit = [&](const std::string& name, double angle_rad) {
    const auto joint = Joint(name);
    EXPECT_EQ(joint->type, urdf::Joint::REVOLUTE) << name;
    EXPECT_EQ(joint->limits->lower, -angle_rad) << name;
    EXPECT_EQ(joint->limits->upper, angle_rad) << name;
  };
  for (const std::string side : {"left", "right"}) {
    expect_limit(side + "_rocker_joint", params_.geometry.rocker_limit_rad);
    expect_limit(side + "_bogie_joint", params_.geometry.bogie_limit_rad);
    expect_limit(side + "_rear_steering_joint", params_.drive.max_steer_rad);
    EXPECT_EQ(Joint(side + "_rear_steering_joint")->limits->velocity,
              params_.drive.steer_rate_rad_s);
    for (const std::string axle : {"_front", "_middle", "_rear"}) {
      const auto wheel = Joint(side + axle + "_wheel_joint");
      EXPECT_EQ(wheel->type, urdf::Joint::CONTINUOUS);
      EXPECT_EQ(wheel->limits->effort, params_.drive.stall_torque_Nm);
      EXPECT_NEAR(wheel->limits->velocity * params_.geometry.wheel_radius_m,
                  params_.drive.speed_m_s, 1e-12);
    }
  }
}

TEST_P(Urdf, DifferentialIsAMimic) {
  const auto right = Joint("right_rocker_joint");
  ASSERT_TRUE(right->mimic);
  EXPECT_EQ(right->mimic->joint_name, "left_rocker_joint");
  EXPECT_EQ(right->mimic->multiplier, -1.0);
  EXPECT_EQ(right->mimic->offset, 0.0);
  EXPECT_FALSE(Joint("left_rocker_joint")->mimic);
}

TEST_P(Urdf, ShapesAreWheelsBodyAndPanel) {
  const auto wheel = Link("right_middle_wheel");
  ASSERT_EQ(wheel->collision_array.size(), 1u);
  ASSERT_EQ(wheel->visual_array.size(), 1u);
  const auto* cylinder = dynamic_cast<urdf::Cylinder*>(wheel->collision->geometry.get());
  ASSERT_NE(cylinder, nullptr);
  EXPECT_NEAR(cylinder->radius, params_.geometry.wheel_radius_m, 1e-12);
  EXPECT_NEAR(cylinder->length, params_.geometry.wheel_width_m, 1e-12);
  // Its axis is the wheel's: along y.
  EXPECT_NEAR(std::abs(ToTransform(wheel->collision->origin).linear().col(2).y()), 1.0, 1e-9);

  double lowest = 1.0;
  double highest = 0.0;
  for (const auto& shape : Link("chassis")->collision_array) {
    const auto* box = dynamic_cast<urdf::Box*>(shape->geometry.get());
    ASSERT_NE(box, nullptr);
    lowest = std::min(lowest, shape->origin.position.z - 0.5 * box->dim.z);
    highest = std::max(highest, shape->origin.position.z + 0.5 * box->dim.z);
  }
  EXPECT_NEAR(lowest, params_.geometry.belly_clearance_m, 1e-9);
  EXPECT_NEAR(highest, params_.geometry.height_m, 1e-9);
}

// Each strut's cylinder lies between its two end balls.
TEST_P(Urdf, CylindersOfArmsJoinTheirBalls) {
  int cylinders = 0;
  for (const auto& shape : Link("left_bogie")->visual_array) {
    const auto* cylinder = dynamic_cast<urdf::Cylinder*>(shape->geometry.get());
    if (cylinder == nullptr) continue;
    ++cylinders;
    const Transform X = ToTransform(shape->origin);
    for (const double end : {-0.5, 0.5}) {
      const Vector3 tip = X * Vector3(0.0, 0.0, end * cylinder->length);
      double nearest_m = 1.0;
      for (const auto& other : Link("left_bogie")->visual_array) {
        if (dynamic_cast<urdf::Sphere*>(other->geometry.get()) == nullptr) continue;
        nearest_m = std::min(nearest_m, (ToTransform(other->origin).translation() - tip).norm());
      }
      EXPECT_LT(nearest_m, 1e-9);
    }
  }
  EXPECT_EQ(cylinders, 4);  // two arms, two struts
}

INSTANTIATE_TEST_SUITE_P(Rovers, Urdf,
                         testing::Values("rocky_3_2", "mfex", "athena_sdm", "athena_2012"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace rockyard::rover
