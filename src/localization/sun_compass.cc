#include "localization/sun_compass.h"

#include <cmath>

#include "core/check.h"
#include "math/angles.h"

namespace rockyard::localization {

math::Vector3 SunAlmanac::Sun_W(double time_s) const {
  const double time_h = start_solar_time_h + 24.0 * time_s / math::kSolOfMars_s;
  return math::ToUnitVector(math::SunPosition(latitude_rad, declination_rad, time_h),
                            north_heading_rad);
}

messages::PoseFix HeadingFromSun(const messages::SunSighting& sighting,
                                 const messages::AttitudeEstimate& attitude,
                                 const math::Vector3& sun_W, double tilt_sd_rad) {
  const double level = std::hypot(sun_W.x(), sun_W.y());
  EXPECT(level > 0.0);
  const math::Transform X_LR =
      math::MakePose(math::Vector3::Zero(), 0.0, attitude.pitch_rad, attitude.roll_rad);
  const math::Vector3 sun_L = X_LR.linear() * sighting.sun_R;
  const double tangent = sun_W.z() / level;
  constexpr int kHeading = messages::Index(messages::PoseCoordinate::kHeading);
  messages::PoseFix fix;
  fix.capture = sighting.capture;
  fix.measured.set(kHeading);
  fix.pose_W[kHeading] =
      math::WrapAngle(std::atan2(sun_W.y(), sun_W.x()) - std::atan2(sun_L.y(), sun_L.x()));
  // cos(elevation) = level, tan(elevation) = tangent.
  const double across_rad = sighting.direction_sd_rad / level;
  const double tilt_rad = tilt_sd_rad * tangent;
  fix.covariance(kHeading, kHeading) = across_rad * across_rad + tilt_rad * tilt_rad;
  return fix;
}

}  // namespace rockyard::localization
