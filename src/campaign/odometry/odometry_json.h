// What came out of a sequence, for programs.
#pragma once

#include "campaign/odometry/odometry_request.h"
#include "core/json_value.h"

namespace rockyard::campaign {

// The file vo.json: described in src/campaign/README.md.
core::JsonValue OdometryJson(const OdometryRequest& request, const OdometryResult& result);

// Of one stage over all pairs, s: median and largest. Nothing of no pairs.
std::optional<vision::ErrorSummary> StageTimes(const OdometryResult& result, PairStage stage);

// How many pairs ended with each reason, in the order of vision::NoMotion.
std::vector<std::int64_t> ReasonCounts(const OdometryResult& result);

}  // namespace rockyard::campaign
