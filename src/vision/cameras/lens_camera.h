// The lenses of a messages::Camera (vision/lens.h) with pixels that count from the image's corner,
// and with derivatives.
//
// Camera frame C of these: x along the optical axis, y left, z up.
#pragma once

#include <optional>

#include "messages/camera.h"
#include "vision/cameras/camera_types.h"

namespace rockyard::vision {

struct LensCamera {
  // X_RC is the pose in the outer frame; columns and rows are not read.
  messages::Camera lens;
  Pixel axis_px = Pixel::Zero();  // the pixel on the optical axis
};

// The camera with its own frame R as outer frame. Its first column and row become 0.
LensCamera LensCameraOf(const messages::Camera& camera);

// As of every camera; nothing where vision::Project(messages::Camera, ...) sees nothing, and where
// the result is not finite.
std::optional<Pixel> Project(const LensCamera& camera, const math::Vector3& p_A,
                             PixelJacobian* jacobian = nullptr);

// As of every camera; nothing beyond the directions that the lens has (see HasDirections of
// vision/lens.h).
std::optional<Ray> BackProject(const LensCamera& camera, const Pixel& pixel,
                               RayJacobian* jacobian = nullptr);

LensCamera Moved(const math::Transform& X_BA, const LensCamera& camera);

LensCamera Mapped(const LensCamera& camera, const PixelMap& map);

}  // namespace rockyard::vision
