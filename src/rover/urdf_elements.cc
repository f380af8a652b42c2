#include "rover/urdf_elements.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <cmath>
#include <numbers>

namespace rockyard::rover {

using math::Vector3;
using tinyxml2::XMLElement;

std::string Number(double value) { return fmt::format("{}", value + 0.0); }

std::string Numbers(const Vector3& v) {
  return fmt::format("{} {} {}", Number(v.x()), Number(v.y()), Number(v.z()));
}

void AddOrigin(XMLElement& element, const Vector3& xyz, const Vector3& rpy) {
  XMLElement& origin = *element.InsertNewChildElement("origin");
  origin.SetAttribute("xyz", Numbers(xyz).c_str());
  origin.SetAttribute("rpy", Numbers(rpy).c_str());
}

namespace {

// The same shape to look at and to collide with.
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
  const double pitch = std::atan2(std::hypot(along.x(), along.y()), along.z());
  const double yaw = std::atan2(along.y(), along.x());
  AddCylinder(link, 0.5 * (part.a_B + part.b_B), Vector3(0.0, pitch, yaw), part.margin_m,
              along.norm());
}

}  // namespace

void AddShape(XMLElement& link, const Part& part) {
  switch (part.core) {
    case Core::kPoint:  // a corner of a box
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

}  // namespace rockyard::rover
