// The part of the ground whose points a stereo sensor hands on (sensors.stereo.field_of_view).
#pragma once

#include "math/pose.h"
#include "messages/point_cloud.h"
#include "sensing/stereo_params.h"

namespace rockyard::sensing {

// Whether a point of a look, in R, is handed on: always with the full field of view, else where it
// lies in stripe_window, which is ahead of the rover or behind it as the look is.
bool IsWanted(const StereoParams& params, const math::Vector3& p_RoP_R,
              messages::LookDirection direction);

}  // namespace rockyard::sensing
