#include "rover/urdf.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <numbers>
#include <string>
#include <vector>

#include "math/functions.h"
#include "rover/part_shapes.h"
#include "rover/rover_layout_params.h"
#include "rover/rover_links.h"

namespace rockyard::rover {
namespace {

using math::Vector3;
using tinyxml2::XMLElement;

// Share of a steered wheel's mass and inertia that its knuckle takes; rockyard itself does not
// simulate knuckles.
constexpr double kKnuckleShare = 0.05;
// Largest rate of a passive joint, rad/s, as URDF wants one.
constexpr double kPassiveRate_rad_s = 10.0;

// Returns the shortest text that reads back to the same double, without a minus before zero.
std::string Number(double value) { return fmt::format("{}", value + 0.0); }

// Returns "x y z".
std::string Numbers(const Vector3& v) {
  return fmt::format("{} {} {}", Number(v.x()), Number(v.y()), Number(v.z()));
}

// Adds the <origin> of a child frame: translation in m, then roll, pitch and yaw in rad.
void AddOrigin(XMLElement& element, const Vector3& xyz, const Vector3& rpy) {
  XMLElement& origin = *element.InsertNewChildElement("origin");
  origin.SetAttribute("xyz", Numbers(xyz).c_str());
  origin.SetAttribute("rpy", Numbers(rpy).c_str());
}

// Adds a <visual> or <collision>, as `use` says, with an element of that shape, and returns the
// element.
XMLElement* AddGeometry(XMLElement& link, const char* use, const Vector3& xyz, const Vector3& rpy,
                        const char* shape) {
  XMLElement& element = *link.InsertNewChildElement(use);
  AddOrigin(element, xyz, rpy);
  return element.InsertNewChildElement("geometry")->InsertNewChildElement(shape);
}

void AddBall(XMLElement& link, const Vector3& xyz, double radius_m) {
  for (const char* use : {"visual", "collision"}) {
    AddGeometry(link, use, xyz, Vector3::Zero(), "sphere")
        ->SetAttribute("radius", Number(radius_m).c_str());
  }
}

void AddCylinder(XMLElement& link, const Vector3& xyz, const Vector3& rpy, double radius_m,
                 double length_m) {
  for (const char* use : {"visual", "collision"}) {
    XMLElement* shape = AddGeometry(link, use, xyz, rpy, "cylinder");
    shape->SetAttribute("radius", Number(radius_m).c_str());
    shape->SetAttribute("length", Number(length_m).c_str());
  }
}

void AddBox(XMLElement& link, const Vector3& xyz, const Vector3& size) {
  for (const char* use : {"visual", "collision"}) {
    AddGeometry(link, use, xyz, Vector3::Zero(), "box")
        ->SetAttribute("size", Numbers(size).c_str());
  }
}

void AddCapsule(XMLElement& link, const Part& part) {
  const Vector3 along = part.b_B - part.a_B;
  AddBall(link, part.a_B, part.margin_m);
  if (along.norm() == 0.0) return;
  AddBall(link, part.b_B, part.margin_m);
  // A cylinder lies along z: pitch, then yaw, turn z into the direction.
  const double pitch = math::Atan2(math::Hypot(along.x(), along.y()), along.z());
  const double yaw = math::Atan2(along.y(), along.x());
  AddCylinder(link, 0.5 * (part.a_B + part.b_B), Vector3(0.0, pitch, yaw), part.margin_m,
              along.norm());
}

// Adds <visual> and <collision> of a part, in the frame of its body. Corner points add nothing:
// they belong to boxes.
void AddShape(XMLElement& link, const Part& part) {
  switch (part.core) {
    case Core::kPoint:
      return;
    case Core::kSegment:
      return AddCapsule(link, part);
    case Core::kCylinder:
      return AddCylinder(link, part.a_B, Vector3(0.5 * std::numbers::pi, 0.0, 0.0),
                         part.b_B.x() + part.margin_m, 2.0 * (part.b_B.y() + part.margin_m));
    case Core::kBox:
      return AddBox(link, part.a_B, 2.0 * (part.b_B + Vector3::Constant(part.margin_m)));
  }
}

// Adds an <inertial> with a share of a body's mass and inertia.
void AddInertial(XMLElement& link, const BodyMass& body, double share) {
  XMLElement& inertial = *link.InsertNewChildElement("inertial");
  AddOrigin(inertial, body.com_B, Vector3::Zero());
  inertial.InsertNewChildElement("mass")->SetAttribute("value",
                                                       Number(share * body.mass_kg).c_str());
  XMLElement& inertia = *inertial.InsertNewChildElement("inertia");
  const Vector3 moments = share * body.inertia_kg_m2;
  inertia.SetAttribute("ixx", Number(moments.x()).c_str());
  inertia.SetAttribute("iyy", Number(moments.y()).c_str());
  inertia.SetAttribute("izz", Number(moments.z()).c_str());
  for (const char* product : {"ixy", "ixz", "iyz"}) inertia.SetAttribute(product, "0");
}

// What a joint is limited to.
struct Limits {
  double angle_rad = 0.0;  // on either side; 0: none
  double effort_Nm = 0.0;
  double rate_rad_s = 0.0;
};

class UrdfWriter {
 public:
  explicit UrdfWriter(const RoverParams& params)
      : params_(params),
        geometry_(MakeRoverGeometry(params.geometry)),
        masses_(MakeRoverMasses(params)),
        parts_(MakeParts(params.geometry)) {
    document_.InsertEndChild(document_.NewDeclaration());
    robot_ = document_.NewElement("robot");
    robot_->SetAttribute("name", "rover");
    document_.InsertEndChild(robot_);
  }

  std::string Write() {
    const std::vector<Link> links = MakeLinks(params_.geometry);
    for (const Link& link : links) {
      AddLink(link);
      if (link.parent >= 0) AddJoint(link, links[static_cast<std::size_t>(link.parent)]);
    }
    tinyxml2::XMLPrinter printer;
    document_.Print(&printer);
    return printer.CStr();
  }

 private:
  void AddLink(const Link& link) {
    XMLElement& element = *robot_->InsertNewChildElement("link");
    element.SetAttribute("name", link.name.c_str());
    AddInertial(element, MassOf(link), ShareOf(link));
    for (const Part& part : parts_) {
      if (part.body == link.body) AddShape(element, part);
    }
  }

  void AddJoint(const Link& link, const Link& parent) {
    XMLElement& element = *robot_->InsertNewChildElement("joint");
    element.SetAttribute("name", JointName(link).c_str());
    element.SetAttribute("type", link.joint == LinkJoint::kWheel ? "continuous" : "revolute");
    AddOrigin(element, link.pivot_P, Vector3::Zero());
    element.InsertNewChildElement("parent")->SetAttribute("link", parent.name.c_str());
    element.InsertNewChildElement("child")->SetAttribute("link", link.name.c_str());
    element.InsertNewChildElement("axis")->SetAttribute("xyz", Numbers(link.axis).c_str());
    const Limits limits = LimitsOf(link.joint);
    XMLElement& limit = *element.InsertNewChildElement("limit");
    if (limits.angle_rad > 0.0) {
      limit.SetAttribute("lower", Number(-limits.angle_rad).c_str());
      limit.SetAttribute("upper", Number(limits.angle_rad).c_str());
    }
    limit.SetAttribute("effort", Number(limits.effort_Nm).c_str());
    limit.SetAttribute("velocity", Number(limits.rate_rad_s).c_str());
    if (link.joint != LinkJoint::kRocker || link.index != 1) return;
    XMLElement& mimic = *element.InsertNewChildElement("mimic");
    mimic.SetAttribute("joint", "left_rocker_joint");
    mimic.SetAttribute("multiplier", "-1");
    mimic.SetAttribute("offset", "0");
  }

  // Returns the name of the joint above a link: left_rocker_joint of left_rocker, but
  // left_front_steering_joint of a knuckle.
  static std::string JointName(const Link& link) {
    if (link.joint != LinkJoint::kSteering) return link.name + "_joint";
    return link.name.substr(0, link.name.rfind('_')) + "_steering_joint";
  }

  // Returns the mass of the simulated body that the link is a part of.
  const BodyMass& MassOf(const Link& link) const {
    switch (link.joint) {
      case LinkJoint::kFixed:
        return masses_.chassis;
      case LinkJoint::kRocker:
        return masses_.rocker;
      case LinkJoint::kBogie:
        return masses_.bogie;
      case LinkJoint::kSteering:
      case LinkJoint::kWheel:
        break;
    }
    return masses_.wheel;
  }

  // Returns the share of that mass that the link has: knuckle and steered wheel divide one.
  double ShareOf(const Link& link) const {
    if (link.joint == LinkJoint::kSteering) return kKnuckleShare;
    const bool steered = link.joint == LinkJoint::kWheel && geometry_.steered[link.index];
    return steered ? 1.0 - kKnuckleShare : 1.0;
  }

  Limits LimitsOf(LinkJoint joint) const {
    const RoverDriveParams& drive = params_.drive;
    switch (joint) {
      case LinkJoint::kFixed:
        break;
      case LinkJoint::kRocker:
        return {params_.geometry.rocker_limit_rad, 0.0, kPassiveRate_rad_s};
      case LinkJoint::kBogie:
        return {params_.geometry.bogie_limit_rad, 0.0, kPassiveRate_rad_s};
      case LinkJoint::kSteering:
        return {drive.max_steer_rad, drive.stall_torque_Nm, drive.steer_rate_rad_s};
      case LinkJoint::kWheel:
        return {0.0, drive.stall_torque_Nm, drive.speed_m_s / params_.geometry.wheel_radius_m};
    }
    return {};
  }

  const RoverParams& params_;
  const RoverGeometry geometry_;
  const RoverMasses masses_;
  const std::vector<Part> parts_;
  tinyxml2::XMLDocument document_;
  XMLElement* robot_ = nullptr;  // in document_
};

}  // namespace

std::string WriteUrdf(const RoverParams& params) { return UrdfWriter(params).Write(); }

}  // namespace rockyard::rover
