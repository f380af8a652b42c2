// The images of a pair: read, made grey, reduced and, where there are cameras, aligned.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "campaign/stereo/stereo_request.h"
#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/stereo/row_alignment.h"

namespace rockyard::campaign {

struct StereoInput {
  vision::GrayImage left;
  vision::GrayImage right;
  // Where both come from the camera's images; empty where nothing was resampled.
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

}  // namespace rockyard::campaign
