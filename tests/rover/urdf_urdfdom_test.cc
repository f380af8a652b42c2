// What urdfdom makes of the files that the reader of URDF reads: the same links.
#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include "foreign_urdf.h"
#include "random_rovers.h"
#include "rover/urdf.h"
#include "rover/urdf_reader/urdf_model.h"

namespace rockyard::rover {
namespace {

using math::Transform;
using math::Vector3;

// The pose of a link in the frame of the root, as urdfdom has it.
Transform PoseByUrdfdom(urdf::LinkConstSharedPtr link) {
  Transform X = Transform::Identity();
  for (; link->parent_joint; link = link->getParent()) {
    const urdf::Pose& pose = link->parent_joint->parent_to_joint_origin_transform;
    Transform X_PL = Transform::Identity();
    X_PL.translation() = Vector3(pose.position.x, pose.position.y, pose.position.z);
    X_PL.linear() =
        Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z)
            .toRotationMatrix();
    X = X_PL * X;
  }
  return X;
}

void ExpectLinksOfUrdfdom(const std::string& text) {
  const urdf::ModelInterfaceSharedPtr other = urdf::parseURDF(text);
  ASSERT_TRUE(other);
  UrdfFindings findings("a.urdf");
  const UrdfModel model = ParseUrdf(text, "a.urdf", findings);
  const std::vector<Transform> X_0L = LinkPoses(model);
  ASSERT_EQ(model.links.size(), other->links_.size());
  ASSERT_EQ(model.joints.size(), other->joints_.size());
  EXPECT_EQ(model.links[model.order.front()].name, other->getRoot()->name);
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const UrdfLink& link = model.links[i];
    const auto same = other->getLink(link.name);
    ASSERT_TRUE(same) << link.name;
    EXPECT_TRUE(X_0L[i].isApprox(PoseByUrdfdom(same), 1e-12)) << link.name;
    EXPECT_EQ(link.inertial.mass_kg, same->inertial ? same->inertial->mass : 0.0) << link.name;
  }
  for (const UrdfJoint& joint : model.joints) {
    const auto same = other->getJoint(joint.name);
    ASSERT_TRUE(same) << joint.name;
    const Vector3 axis(same->axis.x, same->axis.y, same->axis.z);
    if (joint.kind != UrdfJointKind::kFixed) {
      EXPECT_NEAR((joint.axis_C - axis.normalized()).norm(), 0.0, 1e-12) << joint.name;
    }
    if (same->limits) {
      EXPECT_EQ(joint.lower, same->limits->lower) << joint.name;
      EXPECT_EQ(joint.upper, same->limits->upper) << joint.name;
      EXPECT_EQ(joint.effort.value_or(0.0), same->limits->effort) << joint.name;
      EXPECT_EQ(joint.velocity.value_or(0.0), same->limits->velocity) << joint.name;
    }
    EXPECT_EQ(joint.mimic.has_value(), same->mimic != nullptr) << joint.name;
  }
}

TEST(UrdfAndUrdfdom, HaveTheSameLinks) {
  ExpectLinksOfUrdfdom(WriteUrdf({}));
  RandomRovers rovers;
  for (int i = 0; i < 5; ++i) ExpectLinksOfUrdfdom(WriteUrdf(rovers.Next()));
  ExpectLinksOfUrdfdom(ForeignUrdf());
}

}  // namespace
}  // namespace rockyard::rover
