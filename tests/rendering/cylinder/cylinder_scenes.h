// Plain scenes for tests of pictures of the coloured cylinder.
#pragma once

#include "rendering/cylinder/cylinder_params.h"
#include "rendering/cylinder/cylinder_view.h"

namespace rockyard::rendering {

// Pure colours (blue wall in the blue channel, pink in the red one, the third in the green one) in
// even light before black ground: a channel's sum over a line is what is seen of that colour.
inline CylinderPictureParams PureColours() {
  CylinderPictureParams params;
  params.target.blue = {0.0, 0.0, 1.0};
  params.target.pink = {1.0, 0.0, 0.0};
  params.target.orange = {0.0, 1.0, 0.0};
  params.light.sun = {0.0, 0.0, 0.0};
  params.light.sky = {1.0, 1.0, 1.0};
  params.backdrop.ground = {0.0, 0.0, 0.0};
  params.backdrop.contrast = 0.0;
  params.backdrop.hue_contrast = 0.0;
  params.edge_samples = 16;
  return params;
}

inline CylinderView ViewAt(double distance_m, double orientation_deg, double bearing_deg = 0.0) {
  return {distance_m, math::DegToRad(bearing_deg), math::DegToRad(orientation_deg), true};
}

}  // namespace rockyard::rendering
