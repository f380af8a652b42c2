// One camera of whatever model, with the size of its image. Rendering makes images through it;
// stereo, visual odometry, calibration and the finders of the cylinder read them through it. Both
// sides use the same functions and differ in the numbers of the camera, true or calibrated. Records
// of drives with stereo or visual odometry and of the studies with colour cameras depend on its
// bits for a Cahv, the only lens that these have.
#pragma once

#include <optional>
#include <variant>

#include "vision/cameras/brown_pinhole.h"
#include "vision/cameras/cahv.h"

namespace rockyard::vision {

// A further lens needs Project, BackProject, Moved and Mapped, a centre for CentreOf, and fields
// for files (camera_fields.h).
using AnyLens = std::variant<Cahv, Cahvor, Cahvore, BrownPinhole>;

struct CameraModel {
  AnyLens lens;
  ImageSize size;
};

// Returns where p_A (m, in the camera's outer frame A) is imaged, inside of the image or not, and
// writes the derivative by p_A to `jacobian`, if given. Returns nothing and leaves `jacobian` where
// the model sees nothing: behind the camera, beyond the growing part of its distortion, without
// convergence, or where a number is not finite. Cost: 20 to 300 ns, for a CAHVORE up to 500 ns.
std::optional<Pixel> Project(const CameraModel& camera, const math::Vector3& p_A,
                             PixelJacobian* jacobian = nullptr);

// Returns the ray of a pixel, inside of the image or not, and its derivative by the pixel: the
// inverse of Project. Returns nothing where the model images no direction at `pixel`.
std::optional<Ray> BackProject(const CameraModel& camera, const Pixel& pixel,
                               RayJacobian* jacobian = nullptr);

// Returns where the point at infinity in a direction (of any length but 0) is imaged.
std::optional<Pixel> ProjectDirection(const CameraModel& camera, const math::Vector3& direction_A);

// Returns C, where all lines of sight meet. Only those near the optical axis meet in the C of a
// CAHVORE.
math::Vector3 CentreOf(const CameraModel& camera);

// Returns whether a position lies on some pixel: -0.5 <= column < columns - 0.5, rows likewise.
bool IsInside(const ImageSize& size, const Pixel& pixel);

// Returns the middle of the image: ((columns - 1) / 2, (rows - 1) / 2).
Pixel MiddleOf(const ImageSize& size);

// Returns the camera with its vectors told in B: X_BA is the pose of its present outer frame.
CameraModel Moved(const math::Transform& X_BA, const CameraModel& camera);

// Returns the camera of the image whose pixels are means of `factor` x `factor` pixels of the
// camera's image, as levels of a pyramid by box filters are (2, 4, 8, ...). Pixel j covers factor j
// to factor j + factor - 1, hence column' = (column - (factor - 1) / 2) / factor; columns and rows
// that do not fill a pixel are lost. Must agree with ReduceImage (stereo/pyramid.h), which makes
// these images. Requires 1 <= factor <= columns, rows.
CameraModel Reduced(const CameraModel& camera, int factor);

}  // namespace rockyard::vision
