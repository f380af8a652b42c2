// Plain scenes for tests of pictures of the coloured cylinder.
#pragma once

#include "rendering/cylinder/cylinder_params.h"
#include "rendering/cylinder/cylinder_scene.h"

namespace rockyard::rendering {

// Pure colours (blue wall in the blue channel, pink in the red one, the third in the green one) in
// even light before black ground: a channel's sum over a line is what is seen of that colour.
inline CylinderPictureParams PureColours() {
  return {.target = {.blue = {0.0, 0.0, 1.0}, .pink = {1.0, 0.0, 0.0}, .orange = {0.0, 1.0, 0.0}},
          .light = {.sun = {0.0, 0.0, 0.0}, .sky = {1.0, 1.0, 1.0}},
          .backdrop = {.ground = {0.0, 0.0, 0.0}, .contrast = 0.0, .hue_contrast = 0.0},
          .edge_samples = 16};
}

inline CylinderView ViewAt(double distance_m, double orientation_deg, double bearing_deg = 0.0) {
  return {distance_m, math::DegToRad(bearing_deg), math::DegToRad(orientation_deg), true};
}

}  // namespace rockyard::rendering
