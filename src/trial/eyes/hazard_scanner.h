// The light stripe sensor together with what the rover makes of its images, without a drive: a pose
// in, a scan out. The experiment that measures hazard detection scans with it. Records of that
// study depend on key and number of each scan, which name its noise. The sensor has no trial of its
// own here, as the study gives each scan a key.
#pragma once

#include <cstdint>
#include <memory>

#include "core/random.h"
#include "math/pose.h"
#include "messages/measurements.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"
#include "trial/eyes/stripe_eyes.h"
#include "trial/sight/stripe_reader.h"
#include "trial/watchers.h"

namespace rockyard::trial {

// Both halves of the sensor, as one.
class HazardScanner {
 public:
  // The watcher is called after every scan, on which it has no influence.
  explicit HazardScanner(const DriveParams& drive, ScanWatcher watcher = {});

  // Returns what the rover makes of one scan at X_WR: the columns in which stripes are found. The
  // result is a pure function of the arguments, whatever was scanned before. `scan_number` counts
  // every scan of the trial from 0 and indexes the noise.
  messages::StripeScan Scan(const terrain::Terrain& terrain, const math::Transform& X_WR,
                            core::TrialKey key, std::int64_t scan_number) const;

 private:
  StripeEyes eyes_;
  StripeReader reader_;
  ScanWatcher watcher_;
  std::shared_ptr<const DriveParams> watched_;  // where there is a watcher
};

}  // namespace rockyard::trial
