#include "trial/eyes/stereo_eyes.h"

namespace rockyard::trial {

StereoEyes::StereoEyes(const DriveParams& drive, core::TrialKey key, RoverCameras& cameras)
    : key_(key), cameras_(cameras) {
  const sensing::StereoParams& stereo = drive.sensors.stereo;
  if (stereo.fidelity == sensing::StereoFidelity::kImage) return;
  rays_.emplace(stereo, sensing::SunShade(drive.sensors.sun, drive.rover.geometry));
}

LookData StereoEyes::Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                          messages::LookDirection direction, std::int64_t number) const {
  if (!rays_) return cameras_.Expose(CameraUse::kTerrain, terrain, X_WR, direction, number);
  return ModelledStereo{rays_->InverseDepths(terrain, X_WR, key_, number, direction)};
}

}  // namespace rockyard::trial
