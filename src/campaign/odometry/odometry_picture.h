// What can be looked at of a path: the features of a pair, and the path from above.
#pragma once

#include <string>

#include "campaign/odometry/estimate_path.h"
#include "image_files/raw_image.h"
#include "vision/image.h"
#include "vision/odometry/odometer.h"

namespace rockyard::campaign {

// The aligned left image, in muted grey, with its features as green-blue squares; those of the
// consistent set in yellow, with a line from where each was in the keyframe's image.
image_files::Picture FeaturePicture(const vision::GrayImage& left,
                                    const vision::OdometryStep& step);

// An SVG drawing of the path in the plane in which it is widest: of the outer frame of the first
// pair the two axes of largest extent, the longer one to the right. Pairs without a motion are
// marked; with truth the true path too, in the frame of the first pair.
std::string PathDrawing(const OdometryResult& result);

}  // namespace rockyard::campaign
