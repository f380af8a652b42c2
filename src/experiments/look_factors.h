// Factors of cells that change what a rover's cameras see, and random places for it to look from,
// for stereo_sensing and visual_motion.
#pragma once

#include <string_view>
#include <vector>

#include "core/random.h"
#include "math/pose.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// Returns the drive of one cell: `values` of the columns soil_graininess, sun_elevation_deg and
// baseline_m in place of the scenario's own; other columns change nothing.
trial::DriveParams WithLookFactors(trial::DriveParams drive,
                                   const std::vector<std::string_view>& columns,
                                   const std::vector<double>& values);

// Returns the terrain of the trial `key`, as a drive of that scenario has it.
terrain::Terrain SceneTerrainOf(const trial::DriveParams& drive, core::TrialKey key);

// Returns a pose of the rover on level ground, uniform over the part of the arena where courses may
// go, with any heading, such that no rock of `hazard_height_m` or more reaches within half the
// rover's length of its middle; lower rocks may lie under it. Pure function of its arguments; draws
// from (key, kExperiment), substream 0, which its callers must leave to it. Must stay: x, y and
// heading are drawn for each try, in this order, as records depend on the place. Throws
// std::runtime_error where 1000 draws find no such place.
math::Transform RandomPlace(const trial::DriveParams& drive, const terrain::Terrain& terrain,
                            double hazard_height_m, core::TrialKey key);

}  // namespace rockyard::experiments
