// What the other eye of a pair sees of a picture.
#pragma once

#include <cstdint>

#include "math/pose.h"
#include "rendering/picture/picture.h"
#include "rendering/picture/picture_scene.h"
#include "rendering/picture/pixel_rays.h"
#include "vision/cameras/camera_model.h"
#include "vision/image.h"

namespace rockyard::rendering {

// A pixel of one eye and the point behind it as the other eye sees it.
enum class OtherEye : std::uint8_t {
  kNone,  // there is no point: sky, or blind
  kVisible,
  kOccluded,  // something lies before it
  kOutside,   // not within its image
};

struct StereoTruth {
  vision::Image<OtherEye> other;
  // Where the other eye images the point, also where it is occluded; NaN where it cannot. For
  // rectified eyes the disparity is the difference of the columns.
  vision::Image<double> other_column;
  vision::Image<double> other_row;
};

// Looks at every point of a picture from the pupil of another camera of the same outer frame A.
// Where that moves with the angle (CAHVORE), it looks from where the line of sight of the position
// leaves the axis. Cost: a ray and a projection for each pixel, 0.1 to 0.5 us.
StereoTruth SeenFromOtherEye(const PictureScene& scene, const Picture& picture,
                             const PixelRays& rays, const math::Transform& X_WA,
                             const vision::CameraModel& other);

}  // namespace rockyard::rendering
