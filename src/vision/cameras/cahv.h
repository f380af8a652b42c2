// CAHV: a linear camera (Yakimovsky and Cunningham 1978, "A system for extracting
// three-dimensional measurements from a stereo pair of TV cameras").
//
//   column = (p - C) . H / (p - C) . A        row = (p - C) . V / (p - C) . A
//
// C is the centre, A the unit normal of the image plane. H = f_h H' + c_h A and V = f_v V' + c_v A
// hold focal lengths in pixels, the unit vectors of rows and columns, and the principal point.
#pragma once

#include <optional>

#include "vision/cameras/camera_types.h"

namespace rockyard::vision {

struct Cahv {
  math::Vector3 C = math::Vector3::Zero();  // m
  math::Vector3 A = math::Vector3::UnitZ();
  math::Vector3 H = math::Vector3::UnitX();  // pixels
  math::Vector3 V = math::Vector3::UnitY();  // pixels

  bool operator==(const Cahv&) const = default;
};

// Where p_A (m, in the camera's outer frame) is imaged, and into `jacobian`, where there is one,
// the derivative by p_A. Nothing, and `jacobian` as it was, where the point is not in front of the
// image plane or where the result is not finite.
std::optional<Pixel> Project(const Cahv& camera, const math::Vector3& p_A,
                             PixelJacobian* jacobian = nullptr);

// The ray of a pixel, and its derivative by the pixel: the inverse of Project. Nothing where H, V
// and A lie in one plane or where the result is not finite.
std::optional<Ray> BackProject(const Cahv& camera, const Pixel& pixel,
                               RayJacobian* jacobian = nullptr);

// The camera with its vectors told in B: X_BA is the pose of the frame in which they are told now.
Cahv Moved(const math::Transform& X_BA, const Cahv& camera);

// The camera whose pixels are map(pixel): H' = scale H + shift A, and V likewise.
Cahv Mapped(const Cahv& camera, const PixelMap& map);

// Where a direction d meets the image: (d . H, d . V) / d . A. `by_direction` becomes the
// derivative by d. Nothing where d . A is not positive or where the result is not finite.
std::optional<Pixel> MeetPlane(const Cahv& camera, const math::Vector3& d,
                               PixelJacobian* by_direction);

// The direction d with d . A = 1, d . H = column and d . V = row. `by_pixel` becomes its
// derivative, which is constant. Nothing where H, V and A lie in one plane, or not finite.
std::optional<math::Vector3> LeavePlane(const Cahv& camera, const Pixel& pixel,
                                        Eigen::Matrix<double, 3, 2>* by_pixel);

}  // namespace rockyard::vision
