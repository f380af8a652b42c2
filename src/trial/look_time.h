// How long a look at the terrain takes, by what the rover does meanwhile.
#pragma once

#include "sensing/stripe_layout_params.h"
#include "trial/clock_params.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

struct LookTime {
  double scanning_s = 0.0;
  double imaging_s = 0.0;
  double computing_s = 0.0;

  double total_s() const { return scanning_s + imaging_s + computing_s; }
};

// Of one look:
//   light stripe: clock.scan_time_s and its parts; with a map, navigation on top;
//   stereo: acquisition, stereo, and navigation or the judgement of elevations.
// Times of stereo and navigation are those of clock.compute (compute_profile.h).
LookTime MakeLookTime(const DriveParams& drive);

// Of the computer before the first look, s.
double StartUpTime(const DriveParams& drive);

// The published scan: five lasers, two at a time.
inline constexpr int kPublishedLaserGroups = 3;

// T = fixed + (published - fixed) groups / 3 / speed factor: images on and off for each group of
// lasers have to be taken, clocked out and averaged. 20 s for the published sensor (Matthies 1995,
// section 6); how it divides is an assumption (clock.scan_fixed_s).
inline double ScanTime(const ClockParams& clock, const sensing::LightStripeParams& sensor) {
  const double share = static_cast<double>(sensing::LaserGroups(sensor)) / kPublishedLaserGroups;
  return clock.scan_fixed_s +
         (clock.scan_time_s - clock.scan_fixed_s) * share / clock.scan_speed_factor;
}

}  // namespace rockyard::trial
