// The light that both cameras receive from the cylinder and its surroundings.
#pragma once

#include <array>

#include "core/random.h"
#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_params.h"
#include "rendering/cylinder/cylinder_scene.h"

namespace rockyard::rendering {

// Returns the left and the right image, Lambert surfaces in ColourLight: reflectance times
// irradiance. A pixel whose four neighbours' middles show another part of a body is the mean of
// edge_samples^2 rays; any other one is its middle. Limits: no shadow falls on anything, nothing
// glints, bodies are of even colours. A pure function of its arguments. Cost: 40 to 100 ms for
// two images of 512 x 480, most of it the mottled ground.
std::array<ColourPlanes, 2> RenderCylinder(const CylinderPictureParams& params,
                                           const CylinderView& view, core::TrialKey key);

}  // namespace rockyard::rendering
