// The light that both of the lander's cameras receive from the coloured cylinder and its
// surroundings. The study of cylinder finders renders its views by it; drives do not.
#pragma once

#include <array>

#include "core/random.h"
#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_params.h"
#include "rendering/cylinder/cylinder_scene.h"

namespace rockyard::rendering {

// Returns the left and the right image of Lambert surfaces in ColourLight: reflectance times
// irradiance. A pixel takes the light of the ray through its middle. Where the middle of one of its
// four neighbours shows another part of a body, it takes the mean of edge_samples^2 rays. Limits:
// no shadow falls on anything, nothing glints, bodies are of even colours. It is a pure function of
// its arguments. Cost: 40 to 100 ms for two images of 512 x 480, most of it the mottled ground.
std::array<ColourPlanes, 2> RenderCylinder(const CylinderPictureParams& params,
                                           const CylinderView& view, core::TrialKey key);

}  // namespace rockyard::rendering
