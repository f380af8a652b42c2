// The light stripe sensor once more, plain and slow: walks along the searched columns of a
// scanline, lays each column's viewing ray into the light plane, and asks point by point what is
// solid. Shares with the sensor only the calibration and the searched columns.
#pragma once

#include <cmath>

#include "sensing/light_stripe.h"
#include "terrain/terrain.h"
#include "vision/lens.h"

namespace rockyard::sensing {

class ReferenceStripe {
 public:
  ReferenceStripe(const LightStripe& sensor, const LightStripeParams& params,
                  const terrain::Terrain& terrain, const math::Transform& X_WR)
      : sensor_(sensor), params_(params), terrain_(terrain), X_WR_(X_WR) {}

  messages::StripePixel Find(std::size_t row, std::size_t stripe) const {
    const auto& laser = sensor_.calibration().lasers[stripe];
    const auto& camera = sensor_.calibration().cameras[static_cast<std::size_t>(laser.camera)];
    const auto [first, last] = sensor_.searched(row, stripe);
    // Walk from the end near the emitter.
    const auto point = [&](double column) { return PlanePoint(row, stripe, column); };
    const auto gap = [&](double column) { return (point(column) - laser.p_RoE_R).norm(); };
    const bool forward = gap(first) < gap(last);
    const double begin = forward ? first - 0.5 : last + 0.5;
    const double step = forward ? 0.05 : -0.05;
    if (MeetsSolid(laser.p_RoE_R, point(begin), 0.0)) return {};
    for (double column = begin; column >= first - 0.5 && column <= last + 0.5; column += step) {
      const math::Vector3 p_R = point(column);
      if (!Solid(p_R)) continue;
      if ((p_R - camera.X_RC.translation()).norm() > params_.max_range_m) return {};
      if (MeetsSolid(camera.X_RC.translation(), p_R, 0.002)) return {};
      if (MeetsSolid(laser.p_RoE_R, p_R, 0.002)) return {};
      return {.detected = true, .column_px = std::round(column - 0.5 * step)};
    }
    return {};
  }

 private:
  math::Vector3 PlanePoint(std::size_t row, std::size_t stripe, double column) const {
    const auto& laser = sensor_.calibration().lasers[stripe];
    const auto& camera = sensor_.calibration().cameras[static_cast<std::size_t>(laser.camera)];
    const math::Vector3 ray =
        camera.X_RC.linear() *
        vision::PixelRay(camera,
                         {column, static_cast<double>(sensor_.calibration().scanline_px[row])});
    const math::Vector3 eye = camera.X_RC.translation();
    return eye + ray * laser.normal_R.dot(laser.p_RoE_R - eye) / laser.normal_R.dot(ray);
  }

  bool Solid(const math::Vector3& p_R) const {
    const math::Vector3 p = X_WR_ * p_R;
    if (p.z() <= terrain_.ground().Height(p.x(), p.y())) return true;
    for (const terrain::Rock& rock : terrain_.rocks()) {
      const math::Vector3 d = p - rock.center_W;
      const double along = std::cos(rock.yaw_rad) * d.x() + std::sin(rock.yaw_rad) * d.y();
      const double across = -std::sin(rock.yaw_rad) * d.x() + std::cos(rock.yaw_rad) * d.y();
      const math::Vector3 scaled(along / rock.semi_axes_m.x(), across / rock.semi_axes_m.y(),
                                 d.z() / rock.semi_axes_m.z());
      if (scaled.squaredNorm() <= 1.0) return true;
    }
    return false;
  }

  // True if anything solid lies between the points, all but the last `margin_m`.
  bool MeetsSolid(const math::Vector3& from_R, const math::Vector3& to_R, double margin_m) const {
    const double length = (to_R - from_R).norm() - margin_m;
    const math::Vector3 direction = (to_R - from_R).normalized();
    for (double s = 0.0; s < length; s += 0.0005) {
      if (Solid(from_R + s * direction)) return true;
    }
    return false;
  }

  const LightStripe& sensor_;
  const LightStripeParams& params_;
  const terrain::Terrain& terrain_;
  const math::Transform& X_WR_;
};

}  // namespace rockyard::sensing
