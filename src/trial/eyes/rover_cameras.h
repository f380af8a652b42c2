// The stereo cameras of one rover, down to images: one pair ahead and one pair behind, by which the
// world takes the images of terrain sensing and of visual odometry.
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "math/pose.h"
#include "sensing/stereo_imager.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Who looks: terrain sensing, or visual odometry. Both see through the same lenses, with the same
// faulty pixels and the same drift. Each counts its own looks from 0. Records depend on it: no two
// looks of a trial share their noise, whoever took them, so that images of one pose and moment that
// both ask for are two exposures.
enum class CameraUse { kTerrain, kMotion };

// The cameras of one rover.
class RoverCameras {
 public:
  // `drive` outlives it. Cameras are made at the first look, which drives without images save: 50
  // ms and 60 MB for 512 x 512 pixels.
  RoverCameras(const DriveParams& drive, core::TrialKey key) : drive_(drive), key_(key) {}

  // Takes a pair of images: a pure function of its arguments; `number` < 2^29.
  sensing::StereoImages Expose(CameraUse use, const terrain::Terrain& terrain,
                               const math::Transform& X_WR, messages::LookDirection direction,
                               std::int64_t number);

 private:
  const DriveParams& drive_;
  core::TrialKey key_;
  std::optional<sensing::StereoImager> imager_;
};

}  // namespace rockyard::trial
