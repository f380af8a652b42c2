// What came out of a pair, for programs.
#pragma once

#include "campaign/stereo/stereo_request.h"
#include "core/json_value.h"

namespace rockyard::campaign {

// The file stereo.json: inputs, size, cameras, parameters, range, how many pixels each filter
// dropped, the score against known disparities, points, files. Described in src/campaign/README.md.
core::JsonValue StereoJson(const StereoRequest& request, const StereoResult& result);

}  // namespace rockyard::campaign
