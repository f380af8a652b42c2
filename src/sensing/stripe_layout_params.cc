#include "sensing/stripe_layout_params.h"

#include <algorithm>
#include <cmath>

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::kStripeRows;
using messages::kStripes;

// Emitter to the point where its stripe meets the farthest row on the datum plane.
struct StripeAim {
  Vector3 emitter_R;
  Vector3 far_point_R;
};

StripeAim AimOf(const LightStripeParams& p, std::size_t stripe) {
  const std::array<double, kStripes> emitter_y{p.outer_emitter_y_m, p.inner_emitter_y_m, 0.0,
                                               -p.inner_emitter_y_m, -p.outer_emitter_y_m};
  const std::array<double, kStripes> stripe_y{p.outer_stripe_y_m, p.inner_stripe_y_m, 0.0,
                                              -p.inner_stripe_y_m, -p.outer_stripe_y_m};
  return {{p.emitter_x_m, emitter_y[stripe], p.emitter_height_m},
          {p.front_x_m + p.row_ahead_m.back(), stripe_y[stripe], p.datum_z_m}};
}

// Point of a stripe on the datum plane at a distance ahead of the rover's front.
Vector3 DatumPoint(const LightStripeParams& p, std::size_t stripe, double ahead_m) {
  const StripeAim aim = AimOf(p, stripe);
  const double x = p.front_x_m + ahead_m;
  const double share = (x - aim.emitter_R.x()) / (aim.far_point_R.x() - aim.emitter_R.x());
  const double y = aim.emitter_R.y() + share * (aim.far_point_R.y() - aim.emitter_R.y());
  return {x, y, p.datum_z_m};
}

Vector3 CameraPosition(const LightStripeParams& p, int camera) {
  const double side = camera == 0 ? 0.5 : -0.5;
  return {p.camera_x_m, side * p.camera_separation_m, p.camera_height_m};
}

// The camera on the stripe's own side, which sees it from the smaller baseline; the left one for
// the centre.
int CameraOf(std::size_t stripe) { return stripe <= kStripes / 2 ? 0 : 1; }

// Depression of the row's scanline plane below the optical axis, before rounding to an image row.
double RowAngle(const LightStripeParams& p, std::size_t row) {
  const double ahead = p.front_x_m + p.row_ahead_m[row] - p.camera_x_m;
  return std::atan2(p.camera_height_m - p.datum_z_m, ahead) - p.camera_pitch_rad;
}

messages::StripeLaser LaserOf(const LightStripeParams& p, std::size_t stripe) {
  const StripeAim aim = AimOf(p, stripe);
  const Vector3 along = aim.far_point_R - aim.emitter_R;
  const Vector3 near = DatumPoint(p, stripe, p.row_ahead_m.front()) - aim.emitter_R;
  messages::StripeLaser laser;
  laser.p_RoE_R = aim.emitter_R;
  laser.normal_R = Vector3(-along.y(), along.x(), 0.0).normalized();
  laser.axis_R = (near.normalized() + along.normalized()).normalized();
  laser.half_fan_rad = 0.5 * p.fan_rad;
  laser.camera = CameraOf(stripe);
  return laser;
}

template <typename Condition>
bool HoldsForEveryPoint(const LightStripeParams& p, Condition condition) {
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    for (std::size_t stripe = 0; stripe < kStripes; ++stripe) {
      if (!condition(stripe, DatumPoint(p, stripe, p.row_ahead_m[row]))) return false;
    }
  }
  return true;
}

}  // namespace

bool IsLaidOut(const LightStripeParams& p) {
  const double nearest = p.front_x_m + p.row_ahead_m.front();
  return std::is_sorted(p.row_ahead_m.begin(), p.row_ahead_m.end()) &&
         p.row_ahead_m.front() < p.row_ahead_m.back() && nearest > p.camera_x_m &&
         nearest > p.emitter_x_m && p.camera_height_m > p.datum_z_m &&
         p.emitter_height_m > p.datum_z_m;
}

bool RowsFitTheImage(const LightStripeParams& p) {
  const double half = 0.5 * static_cast<double>(p.rows) * p.row_pitch_rad();
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    if (std::abs(RowAngle(p, row)) > half) return false;
  }
  return true;
}

bool ColumnsFitTheImage(const LightStripeParams& p) {
  const double half = 0.5 * static_cast<double>(p.columns) * p.column_pitch_rad();
  return HoldsForEveryPoint(p, [&](std::size_t stripe, const Vector3& point) {
    const Vector3 ray = point - CameraPosition(p, CameraOf(stripe));
    return std::abs(std::atan2(ray.y(), std::hypot(ray.x(), ray.z()))) <= half;
  });
}

bool PointsFitTheFans(const LightStripeParams& p) {
  return HoldsForEveryPoint(p, [&](std::size_t stripe, const Vector3& point) {
    const messages::StripeLaser laser = LaserOf(p, stripe);
    const double cosine = laser.axis_R.dot((point - laser.p_RoE_R).normalized());
    return cosine >= std::cos(laser.half_fan_rad);
  });
}

bool PointsAreInRange(const LightStripeParams& p) {
  return HoldsForEveryPoint(p, [&](std::size_t stripe, const Vector3& point) {
    return (point - CameraPosition(p, CameraOf(stripe))).norm() <= p.max_range_m;
  });
}

messages::StripeCalibration TrueCalibration(const LightStripeParams& params) {
  messages::StripeCalibration calibration;
  for (int i = 0; i < 2; ++i) {
    messages::StripeCamera& camera = calibration.cameras[static_cast<std::size_t>(i)];
    camera.X_RC.translation() = CameraPosition(params, i);
    camera.X_RC.linear() =
        Eigen::AngleAxisd(params.camera_pitch_rad, Vector3::UnitY()).toRotationMatrix();
    camera.column_pitch_rad = params.column_pitch_rad();
    camera.row_pitch_rad = params.row_pitch_rad();
  }
  for (std::size_t stripe = 0; stripe < kStripes; ++stripe) {
    calibration.lasers[stripe] = LaserOf(params, stripe);
  }
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    const double pitch = params.row_pitch_rad();
    calibration.row_angle_rad[row] = pitch * std::round(RowAngle(params, row) / pitch);
  }
  calibration.datum_z_m = params.datum_z_m;
  return calibration;
}

}  // namespace rockyard::sensing
