// An image of the terrain before the camera's own faults, with the truth about every pixel, and
// what the other eye of a pair sees of it. PictureRenderer fills pictures, PictureReadout reads
// them out; the stereo cameras' images and true disparities come from here. No record depends on
// StereoTruth, only the true disparities of rendered pairs do.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "math/pose.h"
#include "rendering/image_scene.h"
#include "rendering/picture/picture_scene.h"
#include "rendering/picture/pixel_rays.h"
#include "vision/cameras/camera_model.h"
#include "vision/image.h"

namespace rockyard::rendering {

// What lies behind the middle of each pixel, and the light from all of it.
struct Picture {
  // A code beside those of SurfacePoint: the lens does not look anywhere.
  static constexpr int kBlind = -5;

  Picture() = default;
  Picture(int columns, int rows)
      : radiance_w_m2_sr(columns, rows),
        range_m(columns, rows, std::numeric_limits<double>::infinity()),
        normal_W(columns, rows, Eigen::Vector3f::Zero()),
        surface(columns, rows, kBlind),
        sunlit(columns, rows) {}

  int columns() const { return radiance_w_m2_sr.width(); }
  int rows() const { return radiance_w_m2_sr.height(); }

  // The mean over the pixel, within the passband.
  vision::Image<float> radiance_w_m2_sr;
  // The distance along the ray from its origin to the surface; infinite where there is none.
  vision::Image<double> range_m;
  vision::Image<Eigen::Vector3f> normal_W;  // of the terrain, without the texture's relief
  vision::Image<int> surface;               // a rock, a code of SurfacePoint, or kBlind
  vision::Image<float> sunlit;              // share of the sun that the surface sees
};

// How the other eye of a pair sees the point behind a pixel.
enum class OtherEye : std::uint8_t {
  kNone,  // there is no point: sky, or blind
  kVisible,
  kOccluded,  // something lies before it
  kOutside,   // not within its image
};

// What the other eye sees of a picture, by pixel of the picture.
struct StereoTruth {
  vision::Image<OtherEye> other;
  // Where the other eye images the point, also where it is occluded; NaN where it cannot. For
  // rectified eyes the disparity is the difference of the columns.
  vision::Image<double> other_column;
  vision::Image<double> other_row;
};

// Looks at every point of a picture from the pupil of another camera of the same outer frame A.
// Where the pupil moves with the angle (CAHVORE), it looks from where the line of sight of the
// point leaves the axis. Cost: a ray and a projection for each pixel, 0.1 to 0.5 us.
StereoTruth SeenFromOtherEye(const PictureScene& scene, const Picture& picture,
                             const PixelRays& rays, const math::Transform& X_WA,
                             const vision::CameraModel& other);

}  // namespace rockyard::rendering
