// Which points of the terrain the sun does not reach.
#pragma once

#include "math/pose.h"
#include "rendering/rover_body.h"
#include "rendering/sun_params.h"
#include "rover/rover_geometry_params.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// Shadows of rocks, of rough ground and of the rover; walls cast none (src/rendering/README.md). By
// the middle of the sun's disc, and however much of the light comes from the sky. The stereo error
// model drops points by it, at rates that are counted by it in images (stereo_ground_truth.h).
class SunShade {
 public:
  SunShade(const rendering::SunParams& sun, const rover::RoverGeometryParams& rover);

  // Returns whether the surface turns away from the sun there, or something within 50 m lies
  // between, with the rover at X_WR. Cost: a ray.
  bool IsShaded(const terrain::Terrain& terrain, const math::Transform& X_WR,
                const terrain::RayHit& hit) const;

  // The rover's own parts, in R.
  const rendering::RoverBody& body() const { return body_; }

 private:
  math::Vector3 toward_sun_W_;
  rendering::RoverBody body_;
};

}  // namespace rockyard::sensing
