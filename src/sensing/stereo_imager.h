// The stereo cameras at the rover's front and rear down to digital images of a true scene. Drives
// with stereo or visual odometry at the image fidelity and studies of these sensors take their
// images here (trial/eyes/rover_cameras.h), and the commands that render pairs and sequences.
//
// Image formation, in the order in which a look runs through it (equations beside the code):
//   scene      terrain, sun and shadows, the rover's own parts   rendering/picture/picture_scene.h
//   picture    light on every pixel                              picture_renderer.h
//   read-out   lens, exposure, noise, counts                     picture_readout.h
// Goldberg 2002 section 2 begins with such images. What it does not say of camera, light and soil
// is assumed, so that results from these images are sensitivities to those assumptions.
#pragma once

#include <array>
#include <cstdint>

#include "core/random.h"
#include "math/pose.h"
#include "messages/point_cloud.h"
#include "rendering/picture/picture.h"
#include "rendering/picture/picture_params.h"
#include "rendering/picture/picture_readout.h"
#include "rendering/picture/picture_scene.h"
#include "rendering/picture/pixel_rays.h"
#include "rendering/picture/terrain_look.h"
#include "rendering/rover_body.h"
#include "rendering/sun_params.h"
#include "rover/rover_geometry_params.h"
#include "sensing/stereo_params.h"
#include "sensing/stereo_rig.h"
#include "terrain/terrain.h"
#include "vision/image.h"

namespace rockyard::sensing {

// The sensor at the image fidelity: two pairs of linear cameras with the view of MakeStereoView, of
// 2^pyramid_level times its columns and rows.
//
// A pair may have drifted since its calibration (images.drift): its right images are those of the
// drifted camera. CalibratedRig, by which on-board code reads them, does not know of the drift.
//
// Limits: no lens distorts; wheels stay where they are on level ground, arms are not seen; both
// eyes expose at once, for no time at all as far as motion goes.
class StereoImager {
 public:
  // The cameras of a trial: faults of pixels belong to (key, camera), drift to (key, pair). Making
  // them costs some 50 ms and 60 MB for 512 x 512 images.
  StereoImager(const StereoParams& params, const rendering::SunParams& sun,
               const rendering::LookParams& look, const rover::RoverGeometryParams& rover,
               core::TrialKey key);

  // Takes the images of one look with the rover at X_WR. It is a pure function of its arguments. It
  // draws from (key, kImageNoise) by look number and eye, from kSoilTexture, kRockTexture and
  // kRockLook. look_number < 2^30. Users in one trial must take different numbers, or their noise
  // is the same: terrain sensing counts from 0, visual odometry from 2^29. Records depend on these.
  StereoImages Expose(const terrain::Terrain& terrain, const math::Transform& X_WR,
                      std::int64_t look_number, messages::LookDirection direction) const;

  // Returns the true disparity at the middle of every pixel of the left image of such a look: the
  // column less the column of the same point in the right image, px; NaN where the right eye does
  // not see that point. Cost: that of the look's left image and a ray a pixel.
  vision::Image<float> TrueDisparities(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                       messages::LookDirection direction) const;

 private:
  struct Eye {
    rendering::PixelRays rays;
    rendering::PictureReadout readout;
  };
  struct Pair {
    vision::CameraModel true_right;
    std::array<Eye, 2> eyes;  // left, right
  };

  rendering::PictureScene SceneOf(const terrain::Terrain& terrain,
                                  const math::Transform& X_WR) const;
  rendering::Picture Render(const rendering::PictureScene& scene, const Eye& eye,
                            const math::Transform& X_WR, rendering::TerrainLook& look) const;
  Pair MakePair(const StereoParams& params, messages::LookDirection direction,
                core::TrialKey key) const;
  const Pair& PairOf(messages::LookDirection direction) const {
    return direction == messages::LookDirection::kAhead ? ahead_ : behind_;
  }

  rendering::SunParams sun_;
  rendering::LookParams look_;
  rendering::PictureCameraParams camera_;
  core::TrialKey key_;
  rendering::RoverBody body_;
  Pair ahead_;
  Pair behind_;
};

}  // namespace rockyard::sensing
