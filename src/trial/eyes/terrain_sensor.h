// A terrain sensor of one trial, on the world's side: it measures, and leaves to a TerrainReader
// what that means.
#pragma once

#include <cstdint>

#include "math/pose.h"
#include "terrain/terrain.h"
#include "trial/eyes/look.h"

namespace rockyard::trial {

class TerrainSensor {
 public:
  virtual ~TerrainSensor() = default;

  // Measures with the rover at X_WR. Pure function of its arguments; `number` counts the looks of
  // the trial from 0 and indexes the noise. Nothing where it does not look in that direction: such
  // a look costs nothing.
  virtual LookData Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                        messages::LookDirection direction, std::int64_t number) const = 0;
};

}  // namespace rockyard::trial
