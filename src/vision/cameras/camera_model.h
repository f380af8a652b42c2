// One camera of whatever model, with the size of its image: what stereo, rendering and visual
// odometry take. Simulated images are made and read through the same functions; what the two sides
// differ in is the numbers of the camera, true or calibrated.
#pragma once

#include <optional>
#include <variant>

#include "vision/cameras/brown_pinhole.h"
#include "vision/cameras/cahv.h"

namespace rockyard::vision {

// A further lens brings Project, BackProject, Moved and Mapped, its centre (CentreOf), and fields
// (camera_fields.h).
using AnyLens = std::variant<Cahv, Cahvor, Cahvore, BrownPinhole>;

struct CameraModel {
  AnyLens lens;
  ImageSize size;
};

// Where p_A (m, in the camera's outer frame A) is imaged, inside of the image or not; into
// `jacobian`, where there is one, the derivative by p_A. Nothing, and `jacobian` as it was, where
// the model sees nothing: behind the camera, beyond the growing part of its distortion, without
// convergence, or where a number is not finite. Cost: 20 to 300 ns, of a CAHVORE up to 500 ns.
std::optional<Pixel> Project(const CameraModel& camera, const math::Vector3& p_A,
                             PixelJacobian* jacobian = nullptr);

// The ray of a pixel, inside of the image or not, and its derivative by the pixel: the inverse of
// Project. Nothing where no direction is imaged there.
std::optional<Ray> BackProject(const CameraModel& camera, const Pixel& pixel,
                               RayJacobian* jacobian = nullptr);

// Where the point at infinity in this direction (of any length but 0) is imaged.
std::optional<Pixel> ProjectDirection(const CameraModel& camera, const math::Vector3& direction_A);

// Where all lines of sight meet; those of a CAHVORE, near its optical axis.
math::Vector3 CentreOf(const CameraModel& camera);

// Whether a position lies on some pixel: -0.5 <= column < columns - 0.5, rows likewise.
bool IsInside(const ImageSize& size, const Pixel& pixel);

// The middle of the image: ((columns - 1) / 2, (rows - 1) / 2).
Pixel MiddleOf(const ImageSize& size);

// The camera with its vectors told in B: X_BA is the pose of its present outer frame.
CameraModel Moved(const math::Transform& X_BA, const CameraModel& camera);

// The camera of the image whose pixels are means of `factor` x `factor` pixels of this one, as a
// level of a pyramid by box filters is (2, 4, 8, ...). Pixel j covers factor j to factor j + factor
// - 1, hence column' = (column - (factor - 1) / 2) / factor; columns and rows that do not fill a
// pixel are lost. Requires 1 <= factor <= columns, rows.
CameraModel Reduced(const CameraModel& camera, int factor);

}  // namespace rockyard::vision
