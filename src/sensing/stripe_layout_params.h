// The layout of the light stripe sensor: what parameters describe, and whether its cameras see what
// the layout asks of them. Parameters are checked by it; both fidelities of the sensor, what the
// rover believes of it, and pages about it take their geometry from TrueCalibration. Records depend
// on TrueCalibration, LaserGroups and SightOf, with thin beams on StripePoint, too; the checks only
// refuse.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/fields.h"
#include "math/pose.h"
#include "messages/calibration.h"
#include "sensing/light_stripe_params.h"

namespace rockyard::sensing {

// Returns the number of rows and stripes: four by five, or more where the array is subdivided.
messages::StripeArraySize ArraySize(const LightStripeParams& params);

// Returns how many images with lasers on one scan takes with each camera.
int LaserGroups(const LightStripeParams& params);

// Returns what a perfectly calibrated rover knows of this sensor. The depression of each scanline
// is rounded to a whole image row, so that the points of a row land within a few millimetres of
// row_ahead_m. The sensor and what the rover believes must start from the same calibration: then
// rounding makes no elevation wrong.
messages::StripeCalibration TrueCalibration(const LightStripeParams& params);

// Returns whether "ahead" and "below" make sense for the layout; the other checks rely on it.
bool IsLaidOut(const LightStripeParams& params);

// These return whether every scanline is a row of the image, and whether every point on the datum
// plane is in the light and near enough.
bool RowsFitTheImage(const LightStripeParams& params);
bool PointsFitTheFans(const LightStripeParams& params);
bool PointsAreInRange(const LightStripeParams& params);

// Returns whether the image lines that are read around each scanline lie in the image, too. The
// imager leaves missing lines out; the software that averages them needs all.
bool BandsFitTheImage(const LightStripeParams& params);

// Returns whether no camera lies in (1 cm from) the light plane of a stripe that it measures: there
// the stripe would not move with elevation.
bool BaselinesAreLong(const LightStripeParams& params);

// Returns where an image row of the laser's camera meets the laser's stripe on the datum plane, in
// R, in front of the emitter, whatever the edges of image and fan. Returns none where that place is
// farther than 100 m or nowhere, as for rows that a radially symmetric lens bends above the
// horizon.
std::optional<math::Vector3> StripePoint(const messages::StripeCalibration& calibration,
                                         const messages::StripeLaser& laser, int row_px);

// Returns the horizontal distance, m, from the rover's origin within which images show rocks: all
// that max_range lets the cameras see, and at least 4 m, whose shadows may fall there.
double SightOf(const LightStripeParams& params);

// Returns whether one of the boxes, in R, hides a point on the datum plane from its camera or its
// emitter. A box that holds the camera or emitter hides nothing from it, as in
// rendering::RoverBody: what is mounted inside a box looks out of it.
bool IsHiddenBy(const LightStripeParams& params, std::span<const Eigen::AlignedBox3d> boxes_R);

// Refuses parameters with which a point on the datum plane could not be measured, by lens, image,
// fans or baselines.
void RequireVisibility(LightStripeParams& params, core::FieldVisitor& v);

}  // namespace rockyard::sensing
