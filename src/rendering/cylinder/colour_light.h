// Light of sun, sky and ground on a surface, in three channels.
#pragma once

#include "math/pose.h"
#include "rendering/cylinder/colour.h"
#include "rendering/cylinder/cylinder_params.h"

namespace rockyard::rendering {

// Directions are in L (cylinder_scene.h): x along the cameras' line of sight, y left, z up.
class ColourLight {
 public:
  // Strengths of sun and sky by radiometry.h (Beer and Lambert), over what a level surface gets
  // from both with the sun in the zenith outside of the atmosphere.
  ColourLight(const CylinderLightParams& light, const Colour& ground);

  // Irradiance of a surface with that unit normal, convex and seen by all of its sky:
  //   sun max(0, n.s) + sky (1 + n_z)/2 + ground (1 - n_z)/2
  // where the level ground sends back `ground` times what falls on it. No surface shades another.
  Colour On(const math::Vector3& normal_L) const;

  const math::Vector3& toward_sun_L() const { return toward_sun_L_; }
  // Radiance of the sky, times pi, as On is for a white surface.
  const Colour& sky() const { return sky_; }

 private:
  math::Vector3 toward_sun_L_;
  Colour sun_;
  Colour sky_;
  Colour ground_;
};

}  // namespace rockyard::rendering
