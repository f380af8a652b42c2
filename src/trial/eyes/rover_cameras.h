// The stereo cameras of one rover, down to images: one pair ahead and one behind for all who look
// through them.
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "math/pose.h"
#include "sensing/stereo_imager.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Terrain sensing and visual odometry see through the same lenses, with the same faulty pixels and
// the same drift. Each counts its own looks from 0, and no two looks of a trial share their noise,
// whoever took them: images of one pose and moment that both ask for are two exposures.
enum class CameraUse { kTerrain, kMotion };

class RoverCameras {
 public:
  // `drive` outlives it. Cameras are made at the first look: 50 ms and 60 MB for 512 x 512 pixels
  // that drives without images do without.
  RoverCameras(const DriveParams& drive, core::TrialKey key) : drive_(drive), key_(key) {}

  // Pure function of its arguments; `number` < 2^29.
  sensing::StereoImages Expose(CameraUse use, const terrain::Terrain& terrain,
                               const math::Transform& X_WR, messages::LookDirection direction,
                               std::int64_t number);

 private:
  const DriveParams& drive_;
  core::TrialKey key_;
  std::optional<sensing::StereoImager> imager_;
};

}  // namespace rockyard::trial
