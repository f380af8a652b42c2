// Which disparities are searched, and whether what was found makes sense at all.
#pragma once

#include "campaign/stereo/stereo_input.h"
#include "campaign/stereo/stereo_request.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::campaign {

// The parameters of the request: its settings over the defaults. Throws core::UserError.
vision::StereoPipelineParams StereoParamsOf(const StereoRequest& request);

// The same with the range that is searched in these images: that of the request's depths; else that
// of its settings, where one names the range; else from infinity (disparity 0) to an eighth of the
// image's width. Throws core::UserError where depths are asked for and there are no cameras.
vision::StereoPipelineParams WithRange(const StereoRequest& request, const StereoInput& input,
                                       vision::StereoPipelineParams params);

// Throws core::UserError where hardly anything was matched although the images have texture: the
// eyes are swapped (with them swapped back there are matches), or the images share nothing within
// the range. Images without texture are no error. `threads` as for vision::MatchStereo, which is
// called once more where little was matched.
void CheckThatTheyMatch(const StereoRequest& request, const StereoInput& input,
                        const vision::StereoPipelineParams& params,
                        const vision::DisparityImage& disparities);

}  // namespace rockyard::campaign
