#include "trial/eyes/hazard_scanner.h"

#include <utility>

#include "trial/eyes/onboard_calibration.h"

namespace rockyard::trial {

HazardScanner::HazardScanner(const DriveParams& drive, ScanWatcher watcher)
    : watcher_(std::move(watcher)) {
  if (watcher_) watched_ = std::make_shared<const DriveParams>(drive);
  const sensing::LightStripeParams& sensor = drive.sensors.light_stripe;
  if (sensor.fidelity == sensing::Fidelity::kGeometric) {
    geometric_.emplace(sensor);
    return;
  }
  image_.emplace(ImageSensor{
      sensing::StripeImager(sensor, drive.sensors.sun, drive.rover.geometry),
      perception::StripeFinder(drive.perception.stripe_finder,
                               OnboardStripeCalibration(sensor, drive.perception.calibration))});
}

messages::StripeScan HazardScanner::Scan(const terrain::Terrain& terrain,
                                         const math::Transform& X_WR, core::TrialKey key,
                                         std::int64_t scan_number) const {
  const messages::StripeScan scan = Look(terrain, X_WR, key, scan_number);
  if (watcher_) watcher_({*watched_, terrain, X_WR, key, scan});
  return scan;
}

messages::StripeScan HazardScanner::Look(const terrain::Terrain& terrain,
                                         const math::Transform& X_WR, core::TrialKey key,
                                         std::int64_t scan_number) const {
  if (geometric_) return geometric_->Scan(terrain, X_WR, key, scan_number);
  return image_->finder.Find(image_->imager.Expose(terrain, X_WR, key, scan_number));
}

}  // namespace rockyard::trial
