// A terrain sensor of one trial, with the on-board perception that is its own.
#pragma once

#include <cstdint>
#include <optional>

#include "math/pose.h"
#include "messages/estimates.h"
#include "messages/point_cloud.h"
#include "terrain/terrain.h"

namespace rockyard::trial {

// One look at the ground.
struct TerrainLook {
  const terrain::Terrain& terrain;
  const math::Transform& X_WR;
  messages::LookDirection direction = messages::LookDirection::kAhead;
  messages::AttitudeEstimate attitude;  // how the rover believes to stand
  std::int64_t number = 0;              // of all looks of the trial, from 0: it indexes the noise
};

// What the rover asks for.
struct LookOrder {
  messages::LookDirection direction = messages::LookDirection::kAhead;
  messages::AttitudeEstimate attitude = {};  // how it believes to stand
  std::int64_t number = 0;
  bool points = false;  // else elevations
};

// What it gets; neither where nothing looks in that direction.
struct LookAnswer {
  std::optional<messages::ElevationScan> elevations = {};
  std::optional<messages::PointCloud> points = {};
};

class TerrainSensorModel {
 public:
  virtual ~TerrainSensorModel() = default;

  // Where it does not, a look behind shows nothing and costs nothing.
  virtual bool LooksBehind() const = 0;

  // What the rover makes of a look: elevations of the array that hazards are judged by, or points.
  // Pure functions of the look.
  virtual messages::ElevationScan Elevations(const TerrainLook& look) const = 0;
  virtual messages::PointCloud Points(const TerrainLook& look) const = 0;

  LookAnswer Answer(const LookOrder& order, const terrain::Terrain& terrain,
                    const math::Transform& X_WR) const {
    if (order.direction == messages::LookDirection::kBehind && !LooksBehind()) return {};
    const TerrainLook look{terrain, X_WR, order.direction, order.attitude, order.number};
    if (order.points) return {.points = Points(look)};
    return {.elevations = Elevations(look)};
  }
};

}  // namespace rockyard::trial
