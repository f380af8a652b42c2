// What a replay page keeps of a look of stereo cameras.
#pragma once

#include "replay/data.h"
#include "trial/watchers.h"

namespace rockyard::campaign {

// Sides of its pictures are at most this long, px: larger images are reduced by powers of two.
inline constexpr int kLargestRecordSide_px = 160;

// The look at `time_s` with its pictures. Cost: some milliseconds.
replay::ReplayLook LookRecord(const trial::WatchedStereo& watched, double time_s);

}  // namespace rockyard::campaign
