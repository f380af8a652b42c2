// Masses and moments of inertia of the rover's bodies, as the simulation has them.
#pragma once

#include "math/pose.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// Mass, centre of mass and principal moments of inertia of one body.
struct BodyMass {
  double mass_kg = 0.0;
  // The centre of mass in the frame of the body, m.
  math::Vector3 com_B = math::Vector3::Zero();
  // The moments of inertia about the centre of mass, along the axes of the body's frame.
  math::Vector3 inertia_kg_m2 = math::Vector3::Zero();
};

// The chassis is given in R; rocker, bogie and wheel in frames at their joints, with axes parallel
// to R. The chassis is a solid box from its underside to the panel, about the centre of mass that
// the parameters give; rockers and bogies are flat bars as long as half and a quarter of the rover;
// wheels are solid cylinders.
struct RoverMasses {
  BodyMass chassis;
  BodyMass rocker;
  BodyMass bogie;
  BodyMass wheel;
};

// The chassis has the mass that wheels, rockers and bogies leave of the total.
RoverMasses MakeRoverMasses(const RoverParams& params);

}  // namespace rockyard::rover
