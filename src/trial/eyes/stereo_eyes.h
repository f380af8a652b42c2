// The stereo cameras of a rover on the world's side: a pose in, images out, or what stereo matching
// would make of images. Drives look with it, and the experiment that measures stereo.
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "sensing/stereo_sensor.h"
#include "trial/drive_params.h"
#include "trial/eyes/rover_cameras.h"
#include "trial/eyes/terrain_sensor.h"

namespace rockyard::trial {

// One interface for all fidelities (sensors.stereo.fidelity): `ideal` and `error_model` are
// sensing::StereoSensor, rays and what matching would make of them; `image` takes images with the
// rover's cameras. What is seen follows the true mount of the cameras.
class StereoEyes final : public TerrainSensor {
 public:
  // `cameras` outlive it.
  StereoEyes(const DriveParams& drive, core::TrialKey key, RoverCameras& cameras);

  // A look costs 0.2 to 0.3 ms, or some 0.3 s with images of 512 x 512 pixels.
  LookData Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                messages::LookDirection direction, std::int64_t number) const override;

 private:
  core::TrialKey key_;
  RoverCameras& cameras_;
  std::optional<sensing::StereoSensor> rays_;  // where no images are taken
};

}  // namespace rockyard::trial
