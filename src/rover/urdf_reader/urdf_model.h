// A robot as its URDF file describes it: links and joints as a tree. The reader of rovers looks for
// a rocker-bogie in it. No record depends on it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "math/pose.h"
#include "rover/urdf_reader/urdf_findings.h"

namespace rockyard::rover {

enum class UrdfShapeKind { kBox, kCylinder, kSphere };
enum class UrdfUse { kVisual, kCollision };

// A shape of a link: a box of three sides; a cylinder about its z axis, of radius and length; a
// sphere of a radius.
struct UrdfShape {
  UrdfShapeKind kind = UrdfShapeKind::kBox;
  UrdfUse use = UrdfUse::kVisual;
  math::Transform X_LS = math::Transform::Identity();
  math::Vector3 sides_m = math::Vector3::Zero();
  double radius_m = 0.0;
  double length_m = 0.0;
  std::string place;  // "line 14: collision of link "arm""
};

// Mass and inertia of a link; no mass where the file gives none.
struct UrdfInertial {
  double mass_kg = 0.0;
  math::Transform X_LI = math::Transform::Identity();         // origin at the centre of mass
  Eigen::Matrix3d inertia_I_kg_m2 = Eigen::Matrix3d::Zero();  // about it
};

struct UrdfLink {
  std::string name;
  std::string place;  // "line 12: link "arm""
  UrdfInertial inertial;
  std::vector<UrdfShape> shapes;
  std::optional<std::size_t> parent_joint;
};

enum class UrdfJointKind { kFixed, kContinuous, kRevolute, kPrismatic, kFloating, kPlanar };

// A joint that follows another: its angle is the other's times `multiplier` plus `offset`.
struct UrdfMimic {
  std::size_t joint = 0;
  double multiplier = 1.0;
  double offset = 0.0;
};

struct UrdfJoint {
  std::string name;
  std::string place;  // "line 30: joint "left_rocker""
  UrdfJointKind kind = UrdfJointKind::kFixed;
  std::size_t parent = 0;  // links
  std::size_t child = 0;
  math::Transform X_PC = math::Transform::Identity();  // at zero
  math::Vector3 axis_C = math::Vector3::UnitX();       // unit
  double lower = 0.0;                                  // rad or m
  double upper = 0.0;
  std::optional<double> effort;  // Nm or N
  std::optional<double> velocity;
  std::optional<UrdfMimic> mimic;

  // Whether it turns about its axis, with or without stops.
  bool Turns() const {
    return kind == UrdfJointKind::kContinuous || kind == UrdfJointKind::kRevolute;
  }
};

struct UrdfModel {
  std::string name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::vector<std::size_t> order;  // links, parents before what they carry; the root is the first
};

// Reads a robot. What rockyard has no use for (meshes, transmissions, materials, ...) goes to the
// findings, once for each kind. Throws core::UserError with everything that is wrong, each with
// line and element: what ParseXml refuses, no <robot>, xacro that is not expanded, names that are
// missing, there twice or unknown, numbers that are none or beyond any rover, joints that make no
// tree.
UrdfModel ParseUrdf(std::string_view text, std::string_view source_name, UrdfFindings& findings);

// Returns the pose of every link in the frame of the root while all joints are at zero.
std::vector<math::Transform> LinkPoses(const UrdfModel& model);

}  // namespace rockyard::rover
