// The light stripe sensor and what the rover makes of its images at once, for whoever studies the
// sensor without a drive: a pose in, a scan out.
#pragma once

#include <cstdint>
#include <memory>

#include "core/random.h"
#include "math/pose.h"
#include "messages/measurements.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"
#include "trial/eyes/stripe_eyes.h"
#include "trial/eyes/stripe_reader.h"
#include "trial/watchers.h"

namespace rockyard::trial {

class HazardScanner {
 public:
  // The watcher is called after every scan; it has no influence on it.
  explicit HazardScanner(const DriveParams& drive, ScanWatcher watcher = {});

  // What the rover makes of one scan at X_WR: the columns in which stripes are found. Pure function
  // of its arguments, whatever was scanned before. `scan_number` counts every scan of the trial
  // from 0 and indexes the noise.
  messages::StripeScan Scan(const terrain::Terrain& terrain, const math::Transform& X_WR,
                            core::TrialKey key, std::int64_t scan_number) const;

 private:
  StripeEyes eyes_;
  StripeReader reader_;
  ScanWatcher watcher_;
  std::shared_ptr<const DriveParams> watched_;  // where there is a watcher
};

}  // namespace rockyard::trial
