// Everything before the cameras that is no background: the cylinder, its stand, rocks, hardware.
#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "rendering/cylinder/coloured_body.h"
#include "rendering/cylinder/cylinder_params.h"
#include "rendering/cylinder/cylinder_view.h"

namespace rockyard::rendering {

// Bodies in L. With the cylinder present the first is the cylinder.
//
// Rocks are ellipsoids, sunk by a tenth of their height; hardware are boxes. Their numbers are
// Poisson's, their places uniform over the ground between nearest_m and farthest_m within the
// columns' field of view; one that would come nearer to the cylinder than clear_m is left out.
// Draws from (key, kCylinderScene): substream 0 rocks, 1 hardware, whatever the view is, so that
// surroundings stay where the cylinder turns.
std::vector<BodyCaster> CylinderBodies(const CylinderPictureParams& params,
                                       const CylinderView& view, core::TrialKey key);

}  // namespace rockyard::rendering
