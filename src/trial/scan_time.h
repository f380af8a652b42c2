// How long a hazard scan takes.
#pragma once

#include "sensing/stripe_layout_params.h"
#include "trial/clock_params.h"

namespace rockyard::trial {

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
