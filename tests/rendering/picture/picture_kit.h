// What tests of images of the terrain share.
#pragma once

#include <cmath>

#include "core/random.h"
#include "math/pose.h"
#include "rendering/picture/picture_params.h"
#include "rendering/picture/picture_renderer.h"
#include "rendering/picture/picture_scene.h"
#include "rendering/picture/pixel_rays.h"
#include "rendering/picture/terrain_look.h"
#include "rendering/sun_params.h"
#include "terrain/terrain.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::rendering {

// A pinhole at p_RC_R that looks along R's x axis, `pitch_rad` down, square pixels, axis in the
// middle of the image.
inline vision::CameraModel PinholeAt(const math::Vector3& p_RC_R, double pitch_rad, int columns,
                                     int rows, double view_rad) {
  vision::BrownPinhole lens;
  const double c = std::cos(pitch_rad);
  const double s = std::sin(pitch_rad);
  // x_C to the right, y_C down, z_C forward.
  lens.X_AC.linear().col(0) = math::Vector3(0.0, -1.0, 0.0);
  lens.X_AC.linear().col(1) = math::Vector3(-s, 0.0, -c);
  lens.X_AC.linear().col(2) = math::Vector3(c, 0.0, -s);
  lens.X_AC.translation() = p_RC_R;
  lens.fx_px = lens.fy_px = 0.5 * columns / std::tan(0.5 * view_rad);
  lens.cx_px = 0.5 * (columns - 1);
  lens.cy_px = 0.5 * (rows - 1);
  return {lens, {columns, rows}};
}

// The same above the origin of W, looking straight down; columns run along -y, rows along -x.
inline vision::CameraModel NadirAt(double height_m, int columns, int rows, double pixel_m) {
  const double view_rad = 2.0 * std::atan(0.5 * columns * pixel_m / height_m);
  return PinholeAt({0.0, 0.0, height_m}, math::DegToRad(90.0), columns, rows, view_rad);
}

// Surfaces without texture.
inline LookParams PlainLook() {
  LookParams look;
  look.drift.contrast = look.gravel.contrast = look.rock.contrast = 0.0;
  look.drift.relief_slope = look.gravel.relief_slope = look.rock.relief_slope = 0.0;
  look.rock_albedo_spread = 0.0;
  return look;
}

// One camera in one scene.
struct PictureKit {
  PictureKit(const terrain::Terrain& terrain_in, const SunParams& sun_in, const LookParams& look_in,
             const vision::CameraModel& camera, const PlacedBody& rover = {},
             core::TrialKey key_in = {1, 0})
      : terrain(terrain_in),
        sun(sun_in),
        look(look_in),
        rays(camera),
        scene(terrain, sun, look, 200e-9, rover),
        key(key_in) {}

  Picture Render() const {
    Picture picture(rays.columns(), rays.rows());
    TerrainLook seen(terrain, sun, look, key);
    PictureRenderer(scene, look, rays, math::Transform::Identity())
        .RenderRows(0, rays.rows(), seen, picture);
    return picture;
  }

  const terrain::Terrain& terrain;
  SunParams sun;
  LookParams look;
  PixelRays rays;
  PictureScene scene;
  core::TrialKey key;
};

}  // namespace rockyard::rendering
