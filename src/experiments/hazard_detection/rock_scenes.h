// Scenes with one rock on flat sand before a rover that drives straight on.
//
// World: the course runs along x, and the circle around the rock (its largest diameter) begins at
// x = 0. The rover's front is sensors.light_stripe.front_x_m ahead of its centre.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "experiments/hazard_detection/hazard_detection_params.h"
#include "math/pose.h"
#include "terrain/rock.h"
#include "terrain/rock_params.h"
#include "terrain/terrain.h"

namespace rockyard::experiments {

// A cell of rocks; diameter_m is not read where proportions are natural.
struct RockCell {
  double height_m = 0.0;
  double diameter_m = 0.0;
  double lateral_offset_m = 0.0;
};

// A rock of the given height above the ground, its nearest end at x = 0. Width, burial, yaw and
// profile follow the laws of the terrain's rocks; half its full height is c = h / (2 (1 - burial)),
// and for natural proportions its diameter is 2 c / height ratio. Draws four numbers.
terrain::Rock DrawSceneRock(const RockCell& cell, RockProportions proportions,
                            const terrain::RockFieldParams& law, double lateral_m,
                            core::RandomStream& stream);

// Flat sand with the rock, or without one where the height is 0.
terrain::Terrain SceneTerrain(const terrain::Rock& rock);

// The rover on flat ground, its front `gap_m` before x = 0, on a straight line that meets x = 0 at
// y = 0 under its heading.
math::Transform PoseBefore(double gap_m, double heading_rad, double front_x_m);

}  // namespace rockyard::experiments
