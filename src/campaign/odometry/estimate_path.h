// What `rockyard vo` does: a sequence of image pairs to the path of its cameras (Matthies 1989;
// Howard 2012).
#pragma once

#include <cstdint>
#include <functional>

#include "campaign/odometry/odometry_request.h"
#include "campaign/stop.h"

namespace rockyard::campaign {

// Called after each pair: how many are done, of how many, and how many had no motion.
using OdometryProgress =
    std::function<void(std::int64_t done, std::int64_t planned, std::int64_t gaps)>;

// Reads, aligns, finds the motion of each pair and writes into the folder, which is made:
// trajectory.csv, covariance.csv, times.csv, trajectory_kitti.txt, trajectory_tum.txt,
// features.png, path.svg and vo.json; with truth errors.csv as well. All of that is written at the
// end, each file whole or not at all; what was done when somebody asked for an end is written too.
// journal.jsonl grows pair by pair: with ExistingFiles::kResume a path that was cut off goes on and
// ends as if it had not been, but for the times. A pair whose images cannot be read is a gap.
// Throws core::UserError, before anything is written, for whatever is wrong with the input, the
// images of the first pair included.
OdometryResult EstimatePath(const OdometryRequest& request, const OdometryProgress& progress = {},
                            const Stop& stop = {});

}  // namespace rockyard::campaign
