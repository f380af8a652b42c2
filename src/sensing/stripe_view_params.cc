#include "sensing/stripe_view_params.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sensing/stripe_layout_params.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::Lens;

const messages::Camera& CameraOf(const messages::StripeCalibration& calibration,
                                 const messages::StripeLaser& laser) {
  return calibration.cameras[static_cast<std::size_t>(laser.camera)];
}

// Whether the box is in the way from an eye outside it to a point: by its slabs.
bool ComesBetween(const Eigen::AlignedBox3d& box_R, const Vector3& eye_R, const Vector3& point_R) {
  if (box_R.contains(eye_R)) return false;
  const Vector3 along = point_R - eye_R;
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box_R.min()[axis] - eye_R[axis];
    const double high = box_R.max()[axis] - eye_R[axis];
    if (along[axis] == 0.0) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    enter = std::max(enter, std::min(low / along[axis], high / along[axis]));
    leave = std::min(leave, std::max(low / along[axis], high / along[axis]));
  }
  return enter < leave;
}

// Whether every point on the datum plane lies on a column of the image.
bool ColumnsFitTheImage(const LightStripeParams& p) {
  const messages::StripeCalibration calibration = TrueCalibration(p);
  for (const messages::StripeLaser& laser : calibration.lasers) {
    const messages::Camera& camera = CameraOf(calibration, laser);
    for (const int row_px : calibration.scanline_px) {
      const auto point_R = StripePoint(calibration, laser, row_px);
      if (!point_R) return false;
      const auto imaged = vision::Project(camera, camera.X_RC.inverse() * *point_R);
      if (!imaged || !camera.image_columns().Contains(std::round(imaged->column_px))) return false;
    }
  }
  return true;
}

// Whether the lens has a direction of its own for every pixel.
bool LensReachesTheCorners(const LightStripeParams& p) {
  return vision::HasDirections(p.lens, 0.5 * p.active_width_m / p.focal_length_m,
                               0.5 * p.active_height_m / p.focal_length_m);
}

// What a whole image takes to simulate: about 40 bytes a pixel.
bool ImageIsNotTooLarge(const LightStripeParams& p) {
  constexpr std::int64_t kMaxPixels = 16'777'216;
  return p.columns <= kMaxPixels / std::max<std::int64_t>(p.rows, 1);
}

void RequireImage(LightStripeParams& p, core::FieldVisitor& v) {
  v.Require("columns", ImageIsNotTooLarge(p), "times rows is more than 16777216 pixels",
            "use 768 columns and 484 rows, or 4096 by 4096 at most");
  v.Require("focal_length_m", LensReachesTheCorners(p),
            "is so short that the lens has no direction for the outer pixels: half of width and "
            "height must stay within 90 deg (equidistant_rows), the corners within 180 deg "
            "(equidistant)",
            "use a longer focal_length_m or a smaller active_width_m and active_height_m");
  v.Require("lens", p.lens != Lens::kEquidistant || p.laser.fan == BeamFan::kFull,
            "is equidistant, whose scanlines are no planes, where laser.fan is three_scanlines: a "
            "raised point would leave its scanline, unlit",
            "use lens equidistant_rows or pinhole, or the full fan");
}

}  // namespace

std::optional<Vector3> StripePoint(const messages::StripeCalibration& calibration,
                                   const messages::StripeLaser& laser, int row_px) {
  const messages::Camera& camera = CameraOf(calibration, laser);
  // The stripe on the datum plane runs along n x z from the foot of the emitter; bisection for the
  // distance at which it is imaged in that row.
  const Vector3 along = laser.normal_R.cross(Vector3::UnitZ()).normalized();
  const Vector3 forward = along.dot(laser.axis_R) < 0.0 ? Vector3(-along) : along;
  const Vector3 foot(laser.p_RoE_R.x(), laser.p_RoE_R.y(), calibration.datum_z_m);
  const math::Transform X_CR = camera.X_RC.inverse();
  constexpr double kFarthest_m = 100.0;
  double near_m = 0.0;
  double far_m = kFarthest_m;
  std::optional<vision::PixelPosition> imaged;
  // Farther points of the stripe are imaged higher up.
  constexpr int kHalvings = 55;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_m = 0.5 * (near_m + far_m);
    imaged = vision::Project(camera, X_CR * (foot + middle_m * forward));
    const bool is_below = !imaged || imaged->row_px > row_px;
    (is_below ? near_m : far_m) = middle_m;
  }
  constexpr double kSameRow_px = 0.5;
  if (!imaged || std::abs(imaged->row_px - row_px) > kSameRow_px) return std::nullopt;
  return foot + 0.5 * (near_m + far_m) * forward;
}

bool IsHiddenBy(const LightStripeParams& p, std::span<const Eigen::AlignedBox3d> boxes_R) {
  if (!IsLaidOut(p) || !RowsFitTheImage(p)) return false;  // refused anyway
  const messages::StripeCalibration calibration = TrueCalibration(p);
  for (const messages::StripeLaser& laser : calibration.lasers) {
    const Vector3 camera_R = CameraOf(calibration, laser).X_RC.translation();
    for (const int row_px : calibration.scanline_px) {
      const auto point_R = StripePoint(calibration, laser, row_px);
      if (!point_R) continue;
      for (const Eigen::AlignedBox3d& box_R : boxes_R) {
        if (ComesBetween(box_R, camera_R, *point_R)) return true;
        if (ComesBetween(box_R, laser.p_RoE_R, *point_R)) return true;
      }
    }
  }
  return false;
}

double SightOf(const LightStripeParams& p) {
  constexpr double kShortest_m = 4.0;
  const double camera_m = std::hypot(p.camera_x_m, 0.5 * p.camera_separation_m);
  return std::max(kShortest_m, camera_m + p.max_range_m);
}

void RequireVisibility(LightStripeParams& p, core::FieldVisitor& v) {
  RequireImage(p, v);
  const bool laid_out = IsLaidOut(p);
  const bool has_rows = laid_out && RowsFitTheImage(p);
  v.Require("camera_pitch_deg", !laid_out || has_rows,
            "puts a scanline outside the image: the row lies too far from the optical axis",
            "tilt the cameras towards the rows or use a shorter focal_length_m");
  v.Require("outer_stripe_y_m", !has_rows || ColumnsFitTheImage(p),
            "puts a point on flat ground beside the camera's field of view",
            "move the stripes inwards or use a shorter focal_length_m");
  v.Require("fan_rad", !laid_out || PointsFitTheFans(p),
            "is too narrow to light the nearest and the farthest row",
            "use a wider fan or bring the rows closer together");
  v.Require("max_range_m", !laid_out || PointsAreInRange(p),
            "is shorter than the distance to a point on flat ground", "use a larger max_range_m");
  v.Require("camera_separation_m", !laid_out || BaselinesAreLong(p),
            "leaves a camera within 1 cm of the light plane of a stripe that it measures (baseline "
            "zero): the stripe would not move with elevation",
            "mount cameras and emitters 5 to 10 cm apart");
  v.Require("fidelity", p.fidelity == Fidelity::kGeometric || !laid_out || BandsFitTheImage(p),
            "needs imager.averaging_rows around every scanline, which leave the image",
            "tilt the cameras towards the rows, or average and read fewer lines");
}

}  // namespace rockyard::sensing
