#include "trial/sight/stripe_reader.h"

#include <utility>
#include <variant>

#include "trial/sight/onboard_calibration.h"

namespace rockyard::trial {

StripeReader::StripeReader(const DriveParams& drive,
                           std::function<void(const messages::StripeScan&)> watcher)
    : triangulator_(
          OnboardStripeCalibration(drive.sensors.light_stripe, drive.perception.calibration)),
      watcher_(std::move(watcher)) {
  if (drive.sensors.light_stripe.fidelity == sensing::Fidelity::kGeometric) return;
  finder_.emplace(
      drive.perception.stripe_finder,
      OnboardStripeCalibration(drive.sensors.light_stripe, drive.perception.calibration));
}

messages::StripeScan StripeReader::ScanOf(const LookData& data) const {
  messages::StripeScan scan = finder_ ? finder_->Find(std::get<messages::StripeImages>(data))
                                      : std::get<messages::StripeScan>(data);
  if (watcher_) watcher_(scan);
  return scan;
}

messages::ElevationScan StripeReader::Elevations(const LookOrder& /*order*/,
                                                 const LookData& data) const {
  return triangulator_.Elevations(ScanOf(data));
}

messages::PointCloud StripeReader::Points(const LookOrder& /*order*/, const LookData& data) const {
  return perception::StripeCloud(ScanOf(data), triangulator_);
}

}  // namespace rockyard::trial
