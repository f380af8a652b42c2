// The cameras and the coloured cylinder before them, with all that stands around it.
//
// Frame L: origin on the ground below the cameras' centre of rotation, from which distances count;
// x along the cameras' line of sight over the ground, y left, z up. Frame T: the cylinder, its
// origin in the middle of its axis, x forward, z up.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/random.h"
#include "math/angles.h"
#include "math/pose.h"
#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_params.h"
#include "vision/cameras/cahv.h"

namespace rockyard::rendering {

// `orientation_rad` is theta of Matthies 1995, app. A.1: the azimuth, in T, of the middle between
// the cameras as seen from the cylinder. Blue is in the middle of the view at 45 deg. Finders tell
// theta in the same frame (vision/cylinder/colour_cylinder.h): their errors are differences of
// both.
struct CylinderView {
  double distance_m = 5.0;       // along the ground, from the origin of L
  double bearing_rad = 0.0;      // to the left
  double orientation_rad = 0.0;  // theta
  bool present = true;           // without it: its surroundings alone
};

// The pose of T: its heading is the azimuth of the cameras' middle from it less theta.
inline math::Transform CylinderPose(const CylinderPictureParams& params, const CylinderView& view) {
  const math::Vector3 p_LT_L(view.distance_m * std::cos(view.bearing_rad),
                             view.distance_m * std::sin(view.bearing_rad),
                             params.target.middle_height_m);
  const double azimuth_rad = std::atan2(-p_LT_L.y(), params.cameras.front_m - p_LT_L.x());
  return math::MakePose(p_LT_L, azimuth_rad - view.orientation_rad, 0.0, 0.0);
}

// How far the cameras look down, rad: none where they look along the ground, else towards the
// middle of the cylinder's axis at its distance.
inline double CameraPitch(const CylinderPictureParams& params, const CylinderView& view) {
  if (params.cameras.pointing == CameraPointing::kLevel) return 0.0;
  const double drop_m = params.cameras.height_m - params.target.middle_height_m;
  return std::atan2(drop_m, view.distance_m - params.cameras.front_m);
}

// Left and right camera, told in L: parallel, pinholes, rows level.
inline std::array<vision::Cahv, 2> CylinderCameras(const CylinderPictureParams& params,
                                                   const CylinderView& view) {
  const ColourCameraParams& camera = params.cameras;
  const double pitch_rad = CameraPitch(params, view);
  const math::Vector3 ahead_L(std::cos(pitch_rad), 0.0, -std::sin(pitch_rad));
  const math::Vector3 right_L(0.0, -1.0, 0.0);
  const math::Vector3 down_L = ahead_L.cross(right_L);
  // Appendix A: the field of view belongs to M columns.
  const double focal_px =
      0.5 * static_cast<double>(camera.columns) / std::tan(0.5 * camera.field_of_view_rad);
  std::array<vision::Cahv, 2> pair;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const double side = eye == 0 ? 0.5 : -0.5;
    pair[eye].C = {camera.front_m, side * camera.baseline_m, camera.height_m};
    pair[eye].A = ahead_L;
    pair[eye].H = focal_px * right_L + 0.5 * (static_cast<double>(camera.columns) - 1.0) * ahead_L;
    pair[eye].V = focal_px * down_L + 0.5 * (static_cast<double>(camera.rows) - 1.0) * ahead_L;
  }
  return pair;
}

// Everything before the cameras that is no background: the cylinder, its stand, rocks, hardware.

// A half line from `origin` (m) along `direction`, of any length.
struct ColourRay {
  math::Vector3 origin = math::Vector3::Zero();
  math::Vector3 direction = math::Vector3::UnitX();
};

struct BodyHit {
  double along = 0.0;  // origin + along * direction
  math::Vector3 normal = math::Vector3::UnitZ();
  int part = 0;  // a face or a quadrant, from 0 on; below kBodyParts
};

inline constexpr int kBodyParts = 8;

enum class BodyShape {
  kEllipsoid,  // of these half axes
  kBox,        // of these half sides
  kCylinder,   // upright: radius half.x(), half height half.z(); quadrants of its wall are parts 0
               // to 3, its flat top is part 4
};

// Positions are in L. A body stands upright and is turned by its heading about z.
struct ColouredBody {
  BodyShape shape = BodyShape::kBox;
  math::Vector3 middle_L = math::Vector3::Zero();
  math::Vector3 half = math::Vector3::Ones();
  double heading_rad = 0.0;
  std::array<Colour, kBodyParts> colours{};  // by part
};

// The first meeting of a ray with a body from outside, by closed forms; the bottom of a cylinder is
// not seen. Nothing behind the origin.
class BodyCaster {
 public:
  explicit BodyCaster(ColouredBody body);

  std::optional<BodyHit> Cast(const ColourRay& ray) const;
  const ColouredBody& body() const { return body_; }
  // Corners of the upright box around it, in L.
  std::array<math::Vector3, 8> Corners() const;

 private:
  std::optional<BodyHit> CastEllipsoid(const ColourRay& ray_B) const;
  std::optional<BodyHit> CastBox(const ColourRay& ray_B) const;
  std::optional<BodyHit> CastCylinder(const ColourRay& ray_B) const;

  ColouredBody body_;
  double cosine_;
  double sine_;
};

// Bodies in L. With the cylinder present the first is the cylinder.
//
// Rocks are ellipsoids, sunk by a tenth of their height; hardware are boxes. Their numbers are
// Poisson's, their places uniform over the ground between nearest_m and farthest_m within the
// columns' field of view; one that would come nearer to the cylinder than clear_m is left out.
// Draws from (key, kCylinderScene): substream 0 rocks, 1 hardware, whatever the view is, so that
// surroundings stay where the cylinder turns.
std::vector<BodyCaster> CylinderBodies(const CylinderPictureParams& params,
                                       const CylinderView& view, core::TrialKey key);

}  // namespace rockyard::rendering
