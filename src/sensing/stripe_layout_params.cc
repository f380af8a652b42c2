#include "sensing/stripe_layout_params.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "math/functions.h"
#include "vision/lens.h"

namespace rockyard::sensing {

namespace {

using math::Vector3;
using messages::kStripeRows;
using messages::kStripes;

// Shortest of the published camera-to-emitter baselines, less what rounding may take.
constexpr double kShortestBaseline_m = 0.05 - 1e-9;

// The emitter of a stripe, and the point where the stripe meets the farthest row on the datum
// plane.
struct StripeAim {
  Vector3 emitter_R;
  Vector3 far_point_R;
};

// Returns the value at `index` of a list `subdivision` times as dense as the published one: the
// published values, and others evenly between them.
template <std::size_t kSize>
double Subdivided(const std::array<double, kSize>& published, std::int64_t subdivision,
                  std::size_t index) {
  const auto parts = static_cast<std::size_t>(subdivision);
  const std::size_t below = index / parts;
  if (index % parts == 0) return published[below];
  const double share = static_cast<double>(index % parts) / static_cast<double>(parts);
  return published[below] + share * (published[below + 1] - published[below]);
}

StripeAim AimOf(const LightStripeParams& p, std::size_t stripe) {
  const std::array<double, kStripes> emitter_y{p.outer_emitter_y_m, p.inner_emitter_y_m, 0.0,
                                               -p.inner_emitter_y_m, -p.outer_emitter_y_m};
  const std::array<double, kStripes> stripe_y{p.outer_stripe_y_m, p.inner_stripe_y_m, 0.0,
                                              -p.inner_stripe_y_m, -p.outer_stripe_y_m};
  return {{p.emitter_x_m, Subdivided(emitter_y, p.stripe_subdivision, stripe), p.emitter_height_m},
          {p.front_x_m + p.row_ahead_m.back(), Subdivided(stripe_y, p.stripe_subdivision, stripe),
           p.datum_z_m}};
}

double RowAhead(const LightStripeParams& p, std::size_t row) {
  return Subdivided(p.row_ahead_m, p.row_subdivision, row);
}

// Returns the point of a stripe on the datum plane at a distance ahead of the rover's front.
Vector3 DatumPoint(const LightStripeParams& p, std::size_t stripe, double ahead_m) {
  const StripeAim aim = AimOf(p, stripe);
  const double x = p.front_x_m + ahead_m;
  // Along the vertical light plane, which holds the emitter and the far point.
  const double share = (x - aim.emitter_R.x()) / (aim.far_point_R.x() - aim.emitter_R.x());
  const double y = aim.emitter_R.y() + share * (aim.far_point_R.y() - aim.emitter_R.y());
  return {x, y, p.datum_z_m};
}

Vector3 CameraPosition(const LightStripeParams& p, int camera) {
  // Camera 0 is the left one, y > 0.
  const double side = camera == 0 ? 0.5 : -0.5;
  return {p.camera_x_m, side * p.camera_separation_m, p.camera_height_m};
}

// Returns the camera that measures a stripe: the one on the stripe's own side, which has the
// smaller baseline, and the left one for the centre. Where the emitter sits too near to that
// camera, as in denser arrays, it is the other one.
int CameraOf(const LightStripeParams& p, std::size_t stripe) {
  const int own = stripe <= ArraySize(p).stripes / 2 ? 0 : 1;
  const double baseline_m = (AimOf(p, stripe).emitter_R - CameraPosition(p, own)).norm();
  return baseline_m < kShortestBaseline_m ? 1 - own : own;
}

// Returns the angle below the optical axis at which the row meets the datum plane, rad.
double RowAngle(const LightStripeParams& p, std::size_t row) {
  const double ahead = p.front_x_m + RowAhead(p, row) - p.camera_x_m;
  return math::Atan2(p.camera_height_m - p.datum_z_m, ahead) - p.camera_pitch_rad;
}

// Returns that angle as an image row on the column of the optical axis. Rows lie ahead of and below
// the camera, less than 90 deg off its axis: a pinhole sees them, too.
std::int64_t RowPixel(const LightStripeParams& p, std::size_t row) {
  const double angle_rad = RowAngle(p, row);
  return std::lround(vision::ImageOfAngle(p.lens, angle_rad) / p.row_pitch_rad());
}

// Returns whether the image holds every scanline with so many lines above and below it.
bool LinesFitTheImage(const LightStripeParams& p, std::int64_t around) {
  const std::int64_t first = -p.rows / 2;
  const std::int64_t last = p.rows + first - 1;
  for (std::size_t row = 0; row < ArraySize(p).rows; ++row) {
    const std::int64_t middle = RowPixel(p, row);
    if (middle - around < first || middle + around > last) return false;
  }
  return true;
}

// Returns the group of lasers that are on together. Stripes of one group stand as far apart as
// possible, so that they do not run together in the image: with two of five at a time, the groups
// are {0, 3}, {1, 4} and {2}.
int GroupOf(const LightStripeParams& p, std::size_t stripe) {
  return static_cast<int>(stripe % static_cast<std::size_t>(LaserGroups(p)));
}

messages::StripeLaser LaserOf(const LightStripeParams& p, std::size_t stripe) {
  const StripeAim aim = AimOf(p, stripe);
  const Vector3 along = aim.far_point_R - aim.emitter_R;
  const Vector3 near = DatumPoint(p, stripe, RowAhead(p, 0)) - aim.emitter_R;
  messages::StripeLaser laser;
  laser.p_RoE_R = aim.emitter_R;
  // The normal is horizontal and points to the left of the stripe: the light plane is vertical in
  // R.
  laser.normal_R = Vector3(-along.y(), along.x(), 0.0).normalized();
  // The fan's middle halves the angle between its nearest and farthest points on the datum plane.
  laser.axis_R = (near.normalized() + along.normalized()).normalized();
  laser.half_fan_rad = 0.5 * p.fan_rad;
  laser.camera = CameraOf(p, stripe);
  laser.group = GroupOf(p, stripe);
  return laser;
}

template <typename Condition>
bool HoldsForEveryPoint(const LightStripeParams& p, Condition condition) {
  const auto [rows, stripes] = ArraySize(p);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t stripe = 0; stripe < stripes; ++stripe) {
      if (!condition(stripe, DatumPoint(p, stripe, RowAhead(p, row)))) return false;
    }
  }
  return true;
}

}  // namespace

messages::StripeArraySize ArraySize(const LightStripeParams& p) {
  return {static_cast<std::size_t>(p.row_subdivision) * (kStripeRows - 1) + 1,
          static_cast<std::size_t>(p.stripe_subdivision) * (kStripes - 1) + 1};
}

int LaserGroups(const LightStripeParams& p) {
  const auto at_once = static_cast<std::size_t>(p.lasers_per_image);
  return static_cast<int>((ArraySize(p).stripes + at_once - 1) / at_once);
}

bool IsLaidOut(const LightStripeParams& p) {
  const double nearest = p.front_x_m + p.row_ahead_m.front();
  return std::is_sorted(p.row_ahead_m.begin(), p.row_ahead_m.end()) &&
         p.row_ahead_m.front() < p.row_ahead_m.back() && nearest > p.camera_x_m &&
         nearest > p.emitter_x_m && p.camera_height_m > p.datum_z_m &&
         p.emitter_height_m > p.datum_z_m;
}

bool RowsFitTheImage(const LightStripeParams& p) { return LinesFitTheImage(p, 0); }

bool PointsFitTheFans(const LightStripeParams& p) {
  return HoldsForEveryPoint(p, [&](std::size_t stripe, const Vector3& point) {
    const messages::StripeLaser laser = LaserOf(p, stripe);
    const double cosine = laser.axis_R.dot((point - laser.p_RoE_R).normalized());
    return cosine >= math::Cos(laser.half_fan_rad);
  });
}

bool PointsAreInRange(const LightStripeParams& p) {
  return HoldsForEveryPoint(p, [&](std::size_t stripe, const Vector3& point) {
    return (point - CameraPosition(p, CameraOf(p, stripe))).norm() <= p.max_range_m;
  });
}

bool BandsFitTheImage(const LightStripeParams& p) {
  return LinesFitTheImage(p, p.imager.averaging_rows / 2 + p.imager.margin_rows);
}

bool BaselinesAreLong(const LightStripeParams& p) {
  constexpr double kShortest_m = 0.01;
  for (std::size_t stripe = 0; stripe < ArraySize(p).stripes; ++stripe) {
    const messages::StripeLaser laser = LaserOf(p, stripe);
    const Vector3 camera = CameraPosition(p, laser.camera);
    if (std::abs(laser.normal_R.dot(camera - laser.p_RoE_R)) < kShortest_m) return false;
  }
  return true;
}

messages::StripeCalibration TrueCalibration(const LightStripeParams& params) {
  messages::StripeCalibration calibration;
  for (int i = 0; i < 2; ++i) {
    messages::Camera& camera = calibration.cameras[static_cast<std::size_t>(i)];
    camera.X_RC.translation() = CameraPosition(params, i);
    camera.X_RC.linear() = math::RotationAbout(params.camera_pitch_rad, Vector3::UnitY());
    camera.lens = params.lens;
    camera.column_pitch_rad = params.column_pitch_rad();
    camera.row_pitch_rad = params.row_pitch_rad();
    camera.columns = static_cast<int>(params.columns);
    camera.rows = static_cast<int>(params.rows);
  }
  const auto [rows, stripes] = ArraySize(params);
  for (std::size_t stripe = 0; stripe < stripes; ++stripe) {
    calibration.lasers.push_back(LaserOf(params, stripe));
  }
  for (std::size_t row = 0; row < rows; ++row) {
    calibration.scanline_px.push_back(static_cast<int>(RowPixel(params, row)));
  }
  calibration.datum_z_m = params.datum_z_m;
  calibration.search_low_m = params.search_low_m;
  calibration.search_high_m = params.search_high_m;
  return calibration;
}

namespace {

using math::Vector3;
using messages::Lens;

const messages::Camera& CameraOf(const messages::StripeCalibration& calibration,
                                 const messages::StripeLaser& laser) {
  return calibration.cameras[static_cast<std::size_t>(laser.camera)];
}

// Returns whether the box is in the way from an eye outside it to a point, by the slabs of the box.
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

// Returns whether every point on the datum plane lies on a column of the image.
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

// Returns whether the lens has a direction of its own for every pixel.
bool LensReachesTheCorners(const LightStripeParams& p) {
  return vision::HasDirections(p.lens, 0.5 * p.active_width_m / p.focal_length_m,
                               0.5 * p.active_height_m / p.focal_length_m);
}

// Bounds what a whole image takes to simulate: about 40 bytes a pixel.
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
  // The stripe on the datum plane runs along n x z from the foot of the emitter. The distance at
  // which it is imaged in that row is found by bisection.
  const Vector3 along = laser.normal_R.cross(Vector3::UnitZ()).normalized();
  const Vector3 forward = along.dot(laser.axis_R) < 0.0 ? Vector3(-along) : along;
  const Vector3 foot(laser.p_RoE_R.x(), laser.p_RoE_R.y(), calibration.datum_z_m);
  const math::Transform X_CR = camera.X_RC.inverse();
  constexpr double kFarthest_m = 100.0;
  double near_m = 0.0;
  double far_m = kFarthest_m;
  std::optional<vision::PixelPosition> imaged;
  // Farther points of the stripe are imaged higher up.
  constexpr int kHalvings = 55;  // of 100 m: to less than a double's rounding
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
  const double camera_m = math::Hypot(p.camera_x_m, 0.5 * p.camera_separation_m);
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
