// An estimated path beside the true one.
#pragma once

#include <map>
#include <optional>

#include "campaign/odometry/image_sequence.h"
#include "campaign/odometry/odometry_request.h"

namespace rockyard::campaign {

// True poses by the number of the pair.
using TruePath = std::map<std::int64_t, math::Transform>;

// The truth that the request names; nothing where it names none. Poses of KITTI's form belong to
// the pairs of the whole sequence one by one; those of TUM's form to the pair whose time is
// nearest, at most 0.02 s away (Sturm et al. 2012 and their tools). Throws core::UserError: a file
// that cannot be read, another number of poses than of pairs, times where the sequence has none, no
// pair with a pose.
std::optional<TruePath> ReadTruth(const OdometryRequest& request, const ImageSequence& sequence);

// Fills truth, steps_with_truth and errors, and notes what cannot be told.
void JudgePath(const OdometryRequest& request, const TruePath& truth, OdometryResult& result);

}  // namespace rockyard::campaign
