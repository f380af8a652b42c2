// The light stripe sensor of a rover as the closed loop uses it: a pose in, a scan out.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "math/pose.h"
#include "messages/measurements.h"
#include "scenario/scenario.h"
#include "sensing/light_stripe.h"
#include "terrain/terrain.h"

namespace rockyard::trial {

class HazardScanner {
 public:
  explicit HazardScanner(const scenario::Scenario& scenario);

  // What the rover makes of one scan at X_WR: the columns in which stripes are found. Pure function
  // of its arguments, whatever was scanned before. `scan_number` counts every scan of the trial
  // from 0 and indexes the noise. Cost: that of sensing::LightStripe::Scan.
  messages::StripeScan Scan(const terrain::Terrain& terrain, const math::Transform& X_WR,
                            core::TrialKey key, std::int64_t scan_number) const;

 private:
  sensing::LightStripe light_stripe_;
};

}  // namespace rockyard::trial
