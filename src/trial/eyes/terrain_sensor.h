// The interface of a terrain sensor of one trial, on the world's side: it measures, and a
// TerrainReader on board reads what it measured. World looks with it. Records depend on the key of
// its trial and the numbers of looks: equal ones have equal noise.
#pragma once

#include <cstdint>

#include "math/pose.h"
#include "terrain/terrain.h"
#include "trial/sight/look.h"

namespace rockyard::trial {

// What measures the terrain.
class TerrainSensor {
 public:
  virtual ~TerrainSensor() = default;

  // Measures with the rover at X_WR: a pure function of the arguments. `number` counts the looks of
  // the trial from 0 and indexes the noise. Returns nothing where the sensor does not look in that
  // direction; such a look takes no time.
  virtual LookData Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                        messages::LookDirection direction, std::int64_t number) const = 0;
};

}  // namespace rockyard::trial
