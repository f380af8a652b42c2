#include "rover/urdf_reader/urdf_links.h"

#include <fmt/format.h>

#include <utility>

namespace rockyard::rover {
namespace {

UrdfInertial ReadInertial(const XmlElement& link, const std::string& place,
                          UrdfElements& elements) {
  UrdfInertial read;
  const XmlElement* const inertial = elements.Only(link, "inertial", place);
  if (inertial == nullptr) return read;
  read.X_LI = elements.Origin(*inertial, place);
  if (const XmlElement* const mass = elements.Only(*inertial, "mass", place)) {
    read.mass_kg = elements.Needed(*mass, "value", place, kSaneUrdfSize, 0.0);
  } else {
    elements.findings().Fail(place, "has an <inertial> without <mass>", "give the mass in kg");
  }
  if (const XmlElement* const inertia = elements.Only(*inertial, "inertia", place)) {
    const auto moment = [&](const char* name) {
      return elements.Needed(*inertia, name, place, kSaneUrdfSize, 0.0);
    };
    const auto product = [&](const char* name) {
      return elements.Number(*inertia, name, place).value_or(0.0);
    };
    const double xy = product("ixy");
    const double xz = product("ixz");
    const double yz = product("iyz");
    read.inertia_I_kg_m2 << moment("ixx"), xy, xz, xy, moment("iyy"), yz, xz, yz, moment("izz");
  }
  return read;
}

// Reads a <visual> or <collision>. Returns nothing where its shape is none that rockyard reads.
std::optional<UrdfShape> ReadShape(const XmlElement& element, const std::string& link_name,
                                   UrdfElements& elements, UnusedByName& unused) {
  const std::string place =
      fmt::format("line {}: {} of link {}", element.line, element.name, ShownName(link_name));
  UrdfShape shape;
  shape.place = place;
  shape.use = element.name == "collision" ? UrdfUse::kCollision : UrdfUse::kVisual;
  shape.X_LS = elements.Origin(element, place);
  for (const XmlElement& child : element.children) {
    if (child.name == "material") AddUnused(unused, child);
  }
  const XmlElement* const geometry = elements.Only(element, "geometry", place);
  if (geometry == nullptr || geometry->children.size() != 1) {
    elements.findings().Fail(place, "has no <geometry> with one shape",
                             "give one box, cylinder, sphere or mesh");
    return std::nullopt;
  }
  const XmlElement& form = geometry->children.front();
  const auto size = [&](const char* name) {
    return elements.Needed(form, name, place, kSaneUrdfSize, 1.0);
  };
  if (form.name == "box") {
    shape.kind = UrdfShapeKind::kBox;
    const auto sides_m = elements.Triple(form, "size", place);
    if (sides_m && (sides_m->array() >= 0.0).all()) {
      shape.sides_m = *sides_m;
      return shape;
    }
    if (sides_m || form.Attribute("size") == nullptr) {
      elements.findings().Fail(place, "has a box without three sides", "give size=\"X Y Z\" in m");
    }
    return std::nullopt;
  }
  if (form.name == "cylinder") {
    shape.kind = UrdfShapeKind::kCylinder;
    shape.radius_m = size("radius");
    shape.length_m = size("length");
    return shape;
  }
  if (form.name == "sphere") {
    shape.kind = UrdfShapeKind::kSphere;
    shape.radius_m = size("radius");
    return shape;
  }
  AddUnused(unused, form);
  return std::nullopt;
}

}  // namespace

void AddUnused(UnusedByName& unused, const XmlElement& element) {
  UnusedElements& entry = unused[element.name];
  if (entry.count == 0) entry.line = element.line;
  ++entry.count;
}

UrdfLink ReadUrdfLink(const XmlElement& element, UrdfElements& elements, UnusedByName& unused) {
  UrdfLink link;
  link.name = elements.NameOf(element);
  link.place = UrdfPlace(element, link.name);
  link.inertial = ReadInertial(element, link.place, elements);
  for (const XmlElement& child : element.children) {
    if (child.name == "visual" || child.name == "collision") {
      if (auto shape = ReadShape(child, link.name, elements, unused)) {
        link.shapes.push_back(std::move(*shape));
      }
    } else if (child.name != "inertial") {
      AddUnused(unused, child);
    }
  }
  return link;
}

}  // namespace rockyard::rover
