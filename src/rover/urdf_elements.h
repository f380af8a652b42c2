// Pieces of a URDF file.
#pragma once

#include <string>

#include "math/pose.h"
#include "rover/mass_properties_params.h"
#include "rover/part_shapes.h"

namespace tinyxml2 {
class XMLElement;  // NOLINT(cppcoreguidelines-virtual-class-destructor): its document owns it
}

namespace rockyard::rover {

// Returns the shortest text that reads back to the same double, without a minus before zero.
std::string Number(double value);
// Returns "x y z".
std::string Numbers(const math::Vector3& v);

// Adds the <origin> of a child frame: translation in m, then roll, pitch and yaw in rad.
void AddOrigin(tinyxml2::XMLElement& element, const math::Vector3& xyz, const math::Vector3& rpy);

// Adds <visual> and <collision> of a part, in the frame of its body. Corner points add nothing:
// they belong to boxes.
void AddShape(tinyxml2::XMLElement& link, const Part& part);

// Adds an <inertial> with a share of a body's mass and inertia.
void AddInertial(tinyxml2::XMLElement& link, const BodyMass& body, double share);

}  // namespace rockyard::rover
