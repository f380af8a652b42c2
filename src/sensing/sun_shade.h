// Which points of the terrain the sun does not reach. The stereo error model drops points in shade,
// at rates that studies of stereo count by the same shade in images (stereo_ground_truth.h): both
// must use this class. Records of drives depend on its bits only where shadow_dropout_probability
// is above zero.
#pragma once

#include "math/pose.h"
#include "rendering/rover_body.h"
#include "rendering/sun_params.h"
#include "rover/rover_geometry_params.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// Shadows of rocks, of rough ground and of the rover; walls cast none (src/rendering/README.md).
// Only the middle of the sun's disc counts, however much of the light comes from the sky.
class SunShade {
 public:
  SunShade(const rendering::SunParams& sun, const rover::RoverGeometryParams& rover);

  // Returns whether the surface at `hit` turns away from the sun, or terrain within 50 m or the
  // rover at X_WR lies between. Cost: a ray.
  bool IsShaded(const terrain::Terrain& terrain, const math::Transform& X_WR,
                const terrain::RayHit& hit) const;

  // The rover's own parts, in R.
  const rendering::RoverBody& body() const { return body_; }

 private:
  math::Vector3 toward_sun_W_;
  rendering::RoverBody body_;
};

}  // namespace rockyard::sensing
