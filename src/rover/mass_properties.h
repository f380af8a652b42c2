// Masses and moments of inertia of the rover's bodies, as the simulation has them.
#pragma once

#include "math/pose.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

struct BodyMass {
  double mass_kg = 0.0;
  math::Vector3 com_B = math::Vector3::Zero();          // in the frame of the body, m
  math::Vector3 inertia_kg_m2 = math::Vector3::Zero();  // about that point, along the body's axes
};

// Chassis in R; rocker, bogie and wheel in frames at their joints, with axes parallel to R. The
// chassis is a solid box from its underside to the panel, about the centre of mass that the
// parameters give; rockers and bogies are flat bars as long as half and a quarter of the rover;
// wheels are solid cylinders.
struct RoverMasses {
  BodyMass chassis;
  BodyMass rocker;
  BodyMass bogie;
  BodyMass wheel;
};

RoverMasses MakeRoverMasses(const RoverParams& params);

}  // namespace rockyard::rover
