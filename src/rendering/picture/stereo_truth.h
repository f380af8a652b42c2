// What the other eye of a pair sees of a picture.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "math/pose.h"
#include "rendering/picture/picture.h"
#include "rendering/picture/picture_scene.h"
#include "rendering/picture/pixel_rays.h"
#include "vision/image.h"

namespace rockyard::rendering {

// A pixel of one eye and the point behind it as the other eye sees it.
enum class OtherEye : std::uint8_t {
  kNone,      // there is no point: sky, or blind
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

// Where a camera images a point of its outer frame; none where it cannot.
struct ImagePosition {
  double column = 0.0;
  double row = 0.0;
};
using PixelOfPoint = std::function<std::optional<ImagePosition>(const math::Vector3& p_A)>;

// Looks at every point of a picture from another eye, whose pupil is at other_eye_A of the same
// outer frame A. Cost: a ray and a projection for each pixel.
StereoTruth SeenFromOtherEye(const PictureScene& scene, const Picture& picture,
                             const PixelRays& rays, const math::Transform& X_WA,
                             const math::Vector3& other_eye_A, const PixelOfPoint& other_image);

}  // namespace rockyard::rendering
