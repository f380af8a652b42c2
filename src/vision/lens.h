// The lenses of a messages::Camera, the camera of the light stripe: pixels to rays and back. The
// simulated stripe sensor images through these functions, and the triangulation on board goes back
// through them: what differs between both is the calibration, never the lens. Must stay: Project
// and PixelRay are each other's inverse, or ranges are wrong without any noise. Records of drives
// with a light stripe and of the study of hazard detection depend on every bit of both; the replay
// page draws by the same rays. Cameras of stereo pairs have lenses of their own
// (cameras/camera_model.h).
//
// Camera frame C: x along the optical axis, y left, z up. Columns and rows count from the pixel on
// the axis, columns to the right (-y), rows downwards (-z); a = column * column_pitch_rad and
// b = row * row_pitch_rad are what the lens makes of an image position:
//   equidistant       (f-theta, r = f theta) the direction lies sqrt(a^2 + b^2) from the axis, at
//                     the image's own azimuth
//   equidistant_rows  (separable) a row is the plane through the lateral axis at depression b; the
//                     column is the angle a within it
//   pinhole           (rectilinear, r = f tan theta) slopes a and b: the pitches are pixel / focal
//                     length
// Matthies 1995 table 3 fixes the lens by its field of view: 8.9 mm / 4 mm = 2.2 rad and 6.6 mm /
// 4 mm = 1.65 rad hold for both equidistant models; a pinhole would give 1.68 x 1.38 rad. A real
// f-theta lens is radially symmetric; the separable model is what remains of it where software
// straightens the rows by a calibration.
#pragma once

#include <optional>

#include "math/pose.h"
#include "messages/camera.h"

namespace rockyard::vision {

// A position in an image, in pixels from the optical axis.
struct PixelPosition {
  double column_px = 0.0;
  double row_px = 0.0;
};

// Returns the unit viewing ray of an image position, in C.
math::Vector3 PixelRay(const messages::Camera& camera, const PixelPosition& pixel);

// Returns where the direction p_C (any length, in C) is imaged: the inverse of PixelRay. Returns
// nothing where the lens does not see p_C: behind a pinhole, along the lateral axis
// (equidistant_rows), straight behind (equidistant), or where p_C is 0. The edge of the imager is
// not looked at.
std::optional<PixelPosition> Project(const messages::Camera& camera, const math::Vector3& p_C);

// Returns a of a direction in the horizontal plane through the optical axis, or b of one in the
// vertical plane, for an angle of less than 90 deg off the axis: the angle itself, or its tangent
// (pinhole).
double ImageOfAngle(messages::Lens lens, double angle_rad);

// Returns whether the lens has a direction of its own for every position of an image with |a| up to
// half_width_rad and |b| up to half_height_rad. An equidistant image ends straight behind the
// camera, one of equidistant_rows at 90 deg to every side, a pinhole's nowhere.
bool HasDirections(messages::Lens lens, double half_width_rad, double half_height_rad);

}  // namespace rockyard::vision
