// How long a look at the terrain takes, by what the rover does meanwhile.
#pragma once

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

}  // namespace rockyard::trial
