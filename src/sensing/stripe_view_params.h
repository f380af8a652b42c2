// Whether the cameras of the light stripe sensor see what its layout asks of them.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/fields.h"
#include "math/pose.h"
#include "messages/calibration.h"
#include "sensing/light_stripe_params.h"

namespace rockyard::sensing {

// Returns where an image row of the laser's camera meets the laser's stripe on the datum plane, in
// R, in front of the emitter; edges of image and fan are not looked at. There is none where that is
// farther than 100 m or nowhere, as for rows that a radially symmetric lens bends above the
// horizon.
std::optional<math::Vector3> StripePoint(const messages::StripeCalibration& calibration,
                                         const messages::StripeLaser& laser, int row_px);

// Returns the horizontal distance, m, from the rover's origin within which images show rocks: all
// that max_range lets the cameras see, and at least 4 m, whose shadows may fall there.
double SightOf(const LightStripeParams& params);

// Returns whether one of the boxes, in R, hides a point on the datum plane from its camera or its
// emitter. A box that holds the eye hides nothing: what is mounted inside looks out of it, as in
// rendering::RoverBody.
bool IsHiddenBy(const LightStripeParams& params, std::span<const Eigen::AlignedBox3d> boxes_R);

// Requires lens, image, fans and baselines for which every point on the datum plane is measured.
void RequireVisibility(LightStripeParams& params, core::FieldVisitor& v);

}  // namespace rockyard::sensing
