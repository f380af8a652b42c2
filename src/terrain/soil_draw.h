// The soil of one trial, where a scenario lets it differ from trial to trial
// (terrain.ground.soil.spread). Ground draws it; the command `mobility` draws bands by it.
#pragma once

#include "core/random.h"
#include "terrain/soil_params.h"

namespace rockyard::terrain {

// Returns a soil about `soil`, as its spread says: exponent and friction angle normal, moduli,
// cohesion, shear modulus and density log-normal with the values of `soil` as their medians, all
// within the bounds of SoilParams::Visit and independent of each other but for the two moduli,
// which share one factor. Draws from Purpose::kSoil.
SoilParams DrawSoil(const SoilParams& soil, core::TrialKey key);

}  // namespace rockyard::terrain
