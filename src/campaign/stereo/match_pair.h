// What `rockyard stereo` does: a pair of image files to disparities, points and pictures (Goldberg
// 2002 section 2).
#pragma once

#include "campaign/stereo/stereo_request.h"

namespace rockyard::campaign {

// Reads, aligns, matches, checks and writes into the folder, which is made: disparity.pfm,
// disparity.png, picture.png, stereo.json; with cameras also left.png and right.png (aligned),
// points.ply, elevation.pfm and elevation.png. Throws core::UserError, before anything is written,
// for whatever is wrong with the input.
StereoResult MatchPair(const StereoRequest& request);

}  // namespace rockyard::campaign
