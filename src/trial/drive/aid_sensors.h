// The aids of localization of one drive on the world's side: they measure what the on-board side
// asks for (trial/aids/aid_suite.h).
#pragma once

#include "core/random.h"
#include "localization/aid_fixes.h"
#include "sensing/aid_params.h"
#include "sensing/aids.h"
#include "terrain/terrain.h"
#include "trial/aids/aid_suite.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// The simulated aids: the lander's cameras, the sun sensor, the radio beacon.
class AidSensors {
 public:
  // `terrain` outlives it.
  AidSensors(const DriveParams& drive, core::TrialKey key, const terrain::Terrain& terrain);

  // Measures what is asked for, of a rover at X_WR. Records depend on it: noise is drawn by the
  // number of each measurement.
  AidAnswer Answer(const AidRequest& request, const math::Transform& X_WR, double time_s) const;

 private:
  const terrain::Terrain& terrain_;
  bool sun_is_told_;  // whether the lander's cameras get the sun's elevation, by which they see
  localization::SunAlmanac almanac_;
  sensing::LanderFix lander_fix_;
  sensing::SunSensor sun_;
  sensing::RadioBeacon beacon_;
};

}  // namespace rockyard::trial
