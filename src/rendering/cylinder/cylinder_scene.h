// The cameras and the coloured cylinder before them, with all that stands around it: bodies that
// rays meet by closed forms. The renderer of the cylinder casts its rays here; the study of
// cylinder finders takes cameras and true pose from here.
//
// Frame L: origin on the ground below the cameras' centre of rotation, from which distances count;
// x along the cameras' line of sight over the ground, y left, z up. Frame T: the cylinder, its
// origin in the middle of its axis, x forward, z up. Only records of that study depend on its
// draws: kCylinderScene, all numbers of a body in turn, also of one that is left out.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/random.h"
#include "math/angles.h"
#include "math/functions.h"
#include "math/pose.h"
#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_params.h"
#include "vision/cameras/cahv.h"

namespace rockyard::rendering {

// How the cylinder stands before the cameras. `orientation_rad` is theta of Matthies 1995, app.
// A.1: the azimuth, in T, of the middle between the cameras as seen from the cylinder. Blue is in
// the middle of the view at 45 deg. Must be the theta of vision/cylinder/colour_cylinder.h: errors
// of finders are differences of both.
struct CylinderView {
  double distance_m = 5.0;       // along the ground, from the origin of L
  double bearing_rad = 0.0;      // to the left
  double orientation_rad = 0.0;  // theta
  bool present = true;           // else: the surroundings alone
};

// Returns the pose of T in L. Its heading is the azimuth of the middle between the cameras, as seen
// from T, less theta.
inline math::Transform CylinderPose(const CylinderPictureParams& params, const CylinderView& view) {
  const math::Vector3 p_LT_L(view.distance_m * math::Cos(view.bearing_rad),
                             view.distance_m * math::Sin(view.bearing_rad),
                             params.target.middle_height_m);
  const double azimuth_rad = math::Atan2(-p_LT_L.y(), params.cameras.front_m - p_LT_L.x());
  return math::MakePose(p_LT_L, azimuth_rad - view.orientation_rad, 0.0, 0.0);
}

// Returns how far the cameras look down, rad: 0 where they look along the ground, else towards the
// middle of the cylinder's axis at its distance.
inline double CameraPitch(const CylinderPictureParams& params, const CylinderView& view) {
  if (params.cameras.pointing == CameraPointing::kLevel) return 0.0;
  const double drop_m = params.cameras.height_m - params.target.middle_height_m;
  return math::Atan2(drop_m, view.distance_m - params.cameras.front_m);
}

// Returns the left and the right camera in L: parallel pinholes with level rows.
inline std::array<vision::Cahv, 2> CylinderCameras(const CylinderPictureParams& params,
                                                   const CylinderView& view) {
  const ColourCameraParams& camera = params.cameras;
  const double pitch_rad = CameraPitch(params, view);
  const math::Vector3 ahead_L(math::Cos(pitch_rad), 0.0, -math::Sin(pitch_rad));
  const math::Vector3 right_L(0.0, -1.0, 0.0);
  const math::Vector3 down_L = ahead_L.cross(right_L);
  // Appendix A: the field of view belongs to M columns.
  const double focal_px =
      0.5 * static_cast<double>(camera.columns) / math::Tan(0.5 * camera.field_of_view_rad);
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

// A half line from `origin` (m) along `direction`, whose length need not be 1.
struct ColourRay {
  math::Vector3 origin = math::Vector3::Zero();
  math::Vector3 direction = math::Vector3::UnitX();
};

struct BodyHit {
  double along = 0.0;  // the hit lies at origin + along * direction
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

// A body before the cameras. Positions are in L. It stands upright and is turned by its heading
// about z.
struct ColouredBody {
  BodyShape shape = BodyShape::kBox;
  math::Vector3 middle_L = math::Vector3::Zero();
  math::Vector3 half = math::Vector3::Ones();
  double heading_rad = 0.0;
  std::array<Colour, kBodyParts> colours{};  // by part
};

// Casts rays at one body, by closed forms.
class BodyCaster {
 public:
  explicit BodyCaster(ColouredBody body);

  // Returns where the ray first meets the body from outside, ahead of its origin. The bottom of a
  // cylinder is not met.
  std::optional<BodyHit> Cast(const ColourRay& ray) const;
  const ColouredBody& body() const { return body_; }
  // Returns the corners of the upright box around the body, in L.
  std::array<math::Vector3, 8> Corners() const;

 private:
  std::optional<BodyHit> CastEllipsoid(const ColourRay& ray_B) const;
  std::optional<BodyHit> CastBox(const ColourRay& ray_B) const;
  std::optional<BodyHit> CastCylinder(const ColourRay& ray_B) const;

  ColouredBody body_;
  double cosine_;
  double sine_;
};

// Returns all bodies before the cameras, in L: the cylinder first, if present, then its stand,
// rocks and hardware.
//
// Rocks are ellipsoids, sunk by a tenth of their height; pieces of hardware are boxes. Their
// numbers are Poisson's, their places uniform over the ground between nearest_m and farthest_m
// within the columns' field of view. A body that would come nearer to the cylinder than clear_m is
// left out. It draws from (key, kCylinderScene), substream 0 for rocks and 1 for hardware, the same
// numbers whatever the view: surroundings stay where the cylinder turns. Substream 2 is the
// horizon's (backdrop.cc).
std::vector<BodyCaster> CylinderBodies(const CylinderPictureParams& params,
                                       const CylinderView& view, core::TrialKey key);

}  // namespace rockyard::rendering
