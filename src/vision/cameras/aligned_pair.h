// Linear cameras whose rows are epipolar lines as they are.
#pragma once

#include <optional>

#include "vision/cameras/rectification.h"

namespace rockyard::vision {

// Returns the pair as it stands where both cameras are CAHV with the same A, H and V and a baseline
// along the rows, to 1e-9 of their length: nothing has to be resampled, and pixels may be longer
// than wide. Else nothing: Rectify aligns them.
std::optional<RectifiedPair> AlignedPair(const CameraModel& left, const CameraModel& right);

}  // namespace rockyard::vision
