// The image plane of CAHV, CAHVOR and CAHVORE: what is left once a lens has bent a line of sight.
#pragma once

#include <optional>

#include "vision/cameras/cahv.h"

namespace rockyard::vision {

// Where a direction d meets the image: (d . H, d . V) / d . A. `by_direction` becomes the
// derivative by d. Nothing where d . A is not positive or where the result is not finite.
std::optional<Pixel> MeetPlane(const Cahv& camera, const math::Vector3& d,
                               PixelJacobian* by_direction);

// The direction d with d . A = 1, d . H = column and d . V = row. `by_pixel` becomes its
// derivative, which is constant. Nothing where H, V and A lie in one plane, or not finite.
std::optional<math::Vector3> LeavePlane(const Cahv& camera, const Pixel& pixel,
                                        Eigen::Matrix<double, 3, 2>* by_pixel);

}  // namespace rockyard::vision
