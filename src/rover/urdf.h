// The rover as a URDF file, for viewers and simulators of other people; the command `rover` writes
// it. No record depends on it.
#pragma once

#include <string>

#include "rover/rover_params.h"

namespace rockyard::rover {

// Returns a robot named "rover" in SI units: links chassis (its frame is R), left_rocker,
// left_bogie, left_front_wheel and so on, with a knuckle between arm and wheel where the wheel
// steers. Shapes are those of MakeParts, masses and inertias those of MakeRoverMasses. Rocker,
// bogie and steering joints have their stops as limits, wheels turn without end; the differential
// is a <mimic> of the left rocker with multiplier -1 on the right one.
//
// URDF asks for more than the model has: a steered wheel gives a twentieth of its mass and inertia
// to its knuckle, because readers want every moving link to have some; capsules are cylinders with
// a ball at either end; rounded edges are sharp.
std::string WriteUrdf(const RoverParams& params);

}  // namespace rockyard::rover
