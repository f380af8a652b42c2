// The aids of localization of one drive, as they measure.
#pragma once

#include "core/random.h"
#include "localization/aid_fixes.h"
#include "sensing/aid_params.h"
#include "sensing/aids.h"
#include "terrain/terrain.h"
#include "trial/aids/aid_suite.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

class AidSensors {
 public:
  // `terrain` outlives it.
  AidSensors(const DriveParams& drive, core::TrialKey key, const terrain::Terrain& terrain);

  // Measures what is asked for, of a rover at X_WR. Draws by the number of each measurement.
  AidAnswer Answer(const AidRequest& request, const math::Transform& X_WR, double time_s) const;

 private:
  const terrain::Terrain& terrain_;
  bool sun_is_told_;  // to the lander, whose cameras see by it
  localization::SunAlmanac almanac_;
  sensing::LanderFix lander_fix_;
  sensing::SunSensor sun_;
  sensing::RadioBeacon beacon_;
};

}  // namespace rockyard::trial
