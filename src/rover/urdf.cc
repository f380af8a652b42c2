#include "rover/urdf.h"

#include <tinyxml2.h>

#include <array>
#include <string_view>
#include <vector>

#include "rover/mass_properties.h"
#include "rover/part_shapes.h"
#include "rover/rover_geometry.h"
#include "rover/urdf_elements.h"

namespace rockyard::rover {
namespace {

using math::Vector3;
using tinyxml2::XMLElement;

// Share of a steered wheel's mass and inertia that its knuckle takes.
constexpr double kKnuckleShare = 0.05;
// Rate at which passive joints are said to turn at most, rad/s: URDF wants one.
constexpr double kPassiveRate_rad_s = 10.0;

constexpr std::array<std::string_view, 2> kSides{"left", "right"};
constexpr std::array<std::string_view, 3> kAxles{"front", "middle", "rear"};

struct Limits {
  double angle_rad = 0.0;  // on either side; 0: none
  double effort_Nm = 0.0;
  double rate_rad_s = 0.0;
};

struct Joint {
  std::string name;
  const char* type;
  std::string parent;
  std::string child;
  Vector3 p_PJ;  // from the parent's frame
  Vector3 axis;
  Limits limits;
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
    AddBody("chassis", kChassis, masses_.chassis);
    for (std::size_t side = 0; side < 2; ++side) AddSide(side);
    tinyxml2::XMLPrinter printer;
    document_.Print(&printer);
    return printer.CStr();
  }

 private:
  void AddBody(const std::string& name, int body, const BodyMass& mass, double share = 1.0) {
    XMLElement& link = AddLink(name, mass, share);
    for (const Part& part : parts_) {
      if (part.body == body) AddShape(link, part);
    }
  }

  XMLElement& AddLink(const std::string& name, const BodyMass& mass, double share) {
    XMLElement& link = *robot_->InsertNewChildElement("link");
    link.SetAttribute("name", name.c_str());
    AddInertial(link, mass, share);
    return link;
  }

  XMLElement& AddJoint(const Joint& joint) {
    XMLElement& element = *robot_->InsertNewChildElement("joint");
    element.SetAttribute("name", joint.name.c_str());
    element.SetAttribute("type", joint.type);
    AddOrigin(element, joint.p_PJ, Vector3::Zero());
    element.InsertNewChildElement("parent")->SetAttribute("link", joint.parent.c_str());
    element.InsertNewChildElement("child")->SetAttribute("link", joint.child.c_str());
    element.InsertNewChildElement("axis")->SetAttribute("xyz", Numbers(joint.axis).c_str());
    XMLElement& limit = *element.InsertNewChildElement("limit");
    if (joint.limits.angle_rad > 0.0) {
      limit.SetAttribute("lower", Number(-joint.limits.angle_rad).c_str());
      limit.SetAttribute("upper", Number(joint.limits.angle_rad).c_str());
    }
    limit.SetAttribute("effort", Number(joint.limits.effort_Nm).c_str());
    limit.SetAttribute("velocity", Number(joint.limits.rate_rad_s).c_str());
    return element;
  }

  void AddSide(std::size_t side) {
    const std::string name(kSides[side]);
    const Vector3 rocker_R = geometry_.rocker_pivot_R[side];
    const Vector3 bogie_R = geometry_.bogie_pivot_R[side];
    AddBody(name + "_rocker", kLeftRocker + static_cast<int>(side), masses_.rocker);
    XMLElement& rocker = AddJoint({name + "_rocker_joint",
                                   "revolute",
                                   "chassis",
                                   name + "_rocker",
                                   rocker_R,
                                   Vector3::UnitY(),
                                   {params_.geometry.rocker_limit_rad, 0.0, kPassiveRate_rad_s}});
    if (side == 1) {
      XMLElement& mimic = *rocker.InsertNewChildElement("mimic");
      mimic.SetAttribute("joint", "left_rocker_joint");
      mimic.SetAttribute("multiplier", "-1");
      mimic.SetAttribute("offset", "0");
    }
    AddBody(name + "_bogie", kLeftBogie + static_cast<int>(side), masses_.bogie);
    AddJoint({name + "_bogie_joint",
              "revolute",
              name + "_rocker",
              name + "_bogie",
              bogie_R - rocker_R,
              Vector3::UnitY(),
              {params_.geometry.bogie_limit_rad, 0.0, kPassiveRate_rad_s}});
    for (std::size_t axle = 0; axle < 3; ++axle) {
      const std::size_t wheel = 3 * side + axle;
      const std::string arm = name + (geometry_.on_bogie[wheel] ? "_bogie" : "_rocker");
      const Vector3 arm_R = geometry_.on_bogie[wheel] ? bogie_R : rocker_R;
      AddWheel(wheel, name + "_" + std::string(kAxles[axle]), arm, arm_R);
    }
  }

  void AddWheel(std::size_t wheel, const std::string& name, const std::string& arm,
                const Vector3& arm_R) {
    std::string parent = arm;
    Vector3 p_PJ = geometry_.wheel_R[wheel] - arm_R;
    double share = 1.0;
    if (geometry_.steered[wheel]) {
      share -= kKnuckleShare;
      AddLink(name + "_knuckle", masses_.wheel, kKnuckleShare);
      AddJoint({name + "_steering_joint",
                "revolute",
                arm,
                name + "_knuckle",
                p_PJ,
                Vector3::UnitZ(),
                {params_.drive.max_steer_rad, params_.drive.stall_torque_Nm,
                 params_.drive.steer_rate_rad_s}});
      parent = name + "_knuckle";
      p_PJ.setZero();
    }
    AddBody(name + "_wheel", kFirstWheel + static_cast<int>(wheel), masses_.wheel, share);
    const double rate_rad_s = params_.drive.speed_m_s / params_.geometry.wheel_radius_m;
    AddJoint({name + "_wheel_joint",
              "continuous",
              parent,
              name + "_wheel",
              p_PJ,
              Vector3::UnitY(),
              {0.0, params_.drive.stall_torque_Nm, rate_rad_s}});
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
