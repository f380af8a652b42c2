// The light stripe sensor of a rover as the closed loop uses it: a pose in, a scan out. What in a
// scan is a hazard is decided by perception::HazardDetector.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/random.h"
#include "math/pose.h"
#include "messages/measurements.h"
#include "perception/stripe_finder.h"
#include "sensing/light_stripe.h"
#include "sensing/stripe_imager.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"
#include "trial/watchers.h"

namespace rockyard::trial {

// One interface for both fidelities (sensors.light_stripe.fidelity): `geometric` is
// sensing::LightStripe, rays with a measured error model; `image` is sensing::StripeImager, cameras
// and lasers down to digital numbers, with perception::StripeFinder, which finds the stripes with
// the geometry that the rover believes.
class HazardScanner {
 public:
  // The watcher is called after every scan; it has no influence on it.
  explicit HazardScanner(const DriveParams& drive, ScanWatcher watcher = {});

  // What the rover makes of one scan at X_WR: the columns in which stripes are found. Pure function
  // of its arguments, whatever was scanned before. `scan_number` counts every scan of the trial
  // from 0 and indexes the noise. Cost: some microseconds, or some milliseconds with images.
  messages::StripeScan Scan(const terrain::Terrain& terrain, const math::Transform& X_WR,
                            core::TrialKey key, std::int64_t scan_number) const;

 private:
  messages::StripeScan Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                            core::TrialKey key, std::int64_t scan_number) const;

  struct ImageSensor {
    sensing::StripeImager imager;
    perception::StripeFinder finder;
  };

  ScanWatcher watcher_;
  std::shared_ptr<const DriveParams> watched_;  // where there is a watcher
  // One of both.
  std::optional<sensing::LightStripe> geometric_;
  std::optional<ImageSensor> image_;
};

}  // namespace rockyard::trial
