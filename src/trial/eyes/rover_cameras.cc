#include "trial/eyes/rover_cameras.h"

#include "core/check.h"

namespace rockyard::trial {
namespace {

// The noise of pixels is drawn by the number of a look. Looks for motion are numbered from here on,
// behind all looks at terrain.
constexpr std::int64_t kFirstMotionLook = std::int64_t{1} << 29;

}  // namespace

sensing::StereoImages RoverCameras::Expose(CameraUse use, const terrain::Terrain& terrain,
                                           const math::Transform& X_WR,
                                           messages::LookDirection direction, std::int64_t number) {
  EXPECT(number >= 0 && number < kFirstMotionLook);
  if (!imager_) {
    imager_.emplace(drive_.sensors.stereo, drive_.sensors.sun, drive_.sensors.look,
                    drive_.rover.geometry, key_);
  }
  const std::int64_t look = use == CameraUse::kMotion ? kFirstMotionLook + number : number;
  return imager_->Expose(terrain, X_WR, look, direction);
}

}  // namespace rockyard::trial
