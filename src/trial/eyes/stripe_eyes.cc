#include "trial/eyes/stripe_eyes.h"

namespace rockyard::trial {

StripeEyes::StripeEyes(const DriveParams& drive, core::TrialKey key) : key_(key) {
  const sensing::LightStripeParams& sensor = drive.sensors.light_stripe;
  if (sensor.fidelity == sensing::Fidelity::kGeometric) {
    geometric_.emplace(sensor);
  } else {
    image_.emplace(sensor, drive.sensors.sun, drive.rover.geometry);
  }
}

LookData StripeEyes::Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                          messages::LookDirection direction, std::int64_t number) const {
  if (direction == messages::LookDirection::kBehind) return {};
  return Scan(terrain, X_WR, key_, number);
}

LookData StripeEyes::Scan(const terrain::Terrain& terrain, const math::Transform& X_WR,
                          core::TrialKey key, std::int64_t scan_number) const {
  if (geometric_) return geometric_->Scan(terrain, X_WR, key, scan_number);
  return image_->Expose(terrain, X_WR, key, scan_number);
}

}  // namespace rockyard::trial
