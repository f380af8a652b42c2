// The images of a pair: read, made grey, reduced and, where there are cameras, aligned; which
// disparities are searched in them, and whether what was found makes sense at all. MatchPair is
// made of these steps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "campaign/stereo/match_pair.h"
#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/row_alignment.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::campaign {

struct StereoInput {
  vision::GrayImage left;
  vision::GrayImage right;
  // Which pixels come from the images of the cameras; empty where nothing was resampled.
  vision::Image<std::uint8_t> left_inside;
  vision::Image<std::uint8_t> right_inside;
  std::optional<vision::RectifiedPair> cameras;   // of these images
  std::optional<vision::RowAlignment> alignment;  // that the right image was resampled by
  std::vector<std::string> read;                  // what was read and done, left and right
  std::string advice;                             // of image_files::ToGray, on either image
};

// Reads both images and brings them to rows that are epipolar lines, `pyramid_level` reductions
// smaller. Throws core::UserError: files that cannot be read, images of two sizes, one and the same
// image twice, images too small for the level, cameras of another size, what vision::Rectify and
// vision::FindRowAlignment refuse, and cameras where the images are to align themselves.
StereoInput ReadStereoInput(const StereoRequest& request, int pyramid_level);

// Returns the parameters of the request: its settings over the defaults. Throws core::UserError.
vision::StereoPipelineParams StereoParamsOf(const StereoRequest& request);

// Returns the parameters with the range that is searched in these images: that of the request's
// depths; else that of its settings, where one names the range; else from infinity (disparity 0) to
// an eighth of the image's width, at least 16 px. Throws core::UserError where depths are asked for
// and there are no cameras.
vision::StereoPipelineParams WithRange(const StereoRequest& request, const StereoInput& input,
                                       vision::StereoPipelineParams params);

// Throws core::UserError where hardly anything was matched although the images have texture: the
// eyes are swapped (with them swapped back there are matches), or the images share nothing within
// the range. Images without texture are no error. Where little was matched, vision::MatchStereo is
// called once more, with the threads of the request.
void CheckThatTheyMatch(const StereoRequest& request, const StereoInput& input,
                        const vision::StereoPipelineParams& params,
                        const vision::DisparityImage& disparities);

}  // namespace rockyard::campaign
