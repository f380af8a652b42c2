#include "localization/aid_fixes.h"

#include <limits>

#include "core/check.h"
#include "core/random.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::localization {

Gate::Gate(const GateParams& params) : patience_(params.patience) {
  for (int values = 1; values <= kMostValues; ++values) {
    limit_[static_cast<std::size_t>(values)] =
        params.chance > 0.0 ? core::ChiSquaredQuantile(1.0 - params.chance, values)
                            : std::numeric_limits<double>::infinity();
  }
}

GateAnswer Gate::Ask(double mahalanobis_squared, int values) {
  EXPECT(values >= 1 && values <= kMostValues);
  if (mahalanobis_squared <= limit_[static_cast<std::size_t>(values)]) {
    turned_away_ = 0;
    return GateAnswer::kIn;
  }
  // Only measurements in a row count: a good one between them shows that the filter is not lost.
  ++turned_away_;
  if (patience_ == 0 || turned_away_ < patience_) return GateAnswer::kOut;
  turned_away_ = 0;
  return GateAnswer::kDoubtYourself;
}

namespace {

// Returns the mean of d d', where d leads from the station to the rover as believed before the
// reading.
Eigen::Matrix2d BelievedPlace_m2(const messages::BeaconReading& reading,
                                 const messages::LocalizationEstimate& believed) {
  const messages::PoseEstimate& pose = believed.world ? believed.world->pose : believed.pose;
  const Eigen::Vector2d d(pose.x_m - reading.station_x_m, pose.y_m - reading.station_y_m);
  Eigen::Matrix2d mean = d * d.transpose();
  if (believed.world) {
    mean += believed.world->covariance.topLeftCorner<2, 2>();
  } else if (believed.covariance) {
    mean += believed.covariance->topLeftCorner<2, 2>();
  }
  return mean;
}

}  // namespace

messages::PoseFix PlaceFromBeacon(const messages::BeaconReading& reading,
                                  const messages::LocalizationEstimate& believed) {
  constexpr int kX = messages::Index(messages::PoseCoordinate::kX);
  constexpr int kY = messages::Index(messages::PoseCoordinate::kY);
  messages::PoseFix fix;
  fix.capture = reading.capture;
  fix.measured.set(kX).set(kY);
  fix.pose[kX] = reading.station_x_m + reading.range_m * math::Cos(reading.bearing_rad);
  fix.pose[kY] = reading.station_y_m + reading.range_m * math::Sin(reading.bearing_rad);
  const Eigen::Matrix2d place_m2 = BelievedPlace_m2(reading, believed);
  const double range_m2 = place_m2.trace();
  const Eigen::Matrix2d along = range_m2 > 0.0 ? Eigen::Matrix2d(place_m2 / range_m2)
                                               : Eigen::Matrix2d(0.5 * Eigen::Matrix2d::Identity());
  const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - along;
  const double range_variance_m2 = reading.range_sd_m * reading.range_sd_m;
  const double bearing_variance = reading.bearing_sd_rad * reading.bearing_sd_rad;
  fix.covariance.topLeftCorner<2, 2>() =
      range_variance_m2 * along + (range_m2 + range_variance_m2) * bearing_variance * across;
  return fix;
}

math::Vector3 SunAlmanac::Sun_W(double time_s) const {
  const double time_h = start_solar_time_h + 24.0 * time_s / math::kSolOfMars_s;
  return math::ToUnitVector(math::SunPosition(latitude_rad, declination_rad, time_h),
                            north_heading_rad);
}

messages::PoseFix HeadingFromSun(const messages::SunSighting& sighting,
                                 const messages::AttitudeEstimate& attitude,
                                 const math::Vector3& sun_W, double tilt_sd_rad) {
  const double level = math::Hypot(sun_W.x(), sun_W.y());
  EXPECT(level > 0.0);
  const math::Transform X_LR =
      math::MakePose(math::Vector3::Zero(), 0.0, attitude.pitch_rad, attitude.roll_rad);
  const math::Vector3 sun_L = X_LR.linear() * sighting.sun_R;
  const double tangent = sun_W.z() / level;
  constexpr int kHeading = messages::Index(messages::PoseCoordinate::kHeading);
  messages::PoseFix fix;
  fix.capture = sighting.capture;
  fix.measured.set(kHeading);
  fix.pose[kHeading] =
      math::WrapAngle(math::Atan2(sun_W.y(), sun_W.x()) - math::Atan2(sun_L.y(), sun_L.x()));
  // cos(elevation) = level, tan(elevation) = tangent, of the almanac: the weight of a fix must not
  // depend on its own error.
  const double across_rad = sighting.direction_sd_rad / level;
  const double tilt_rad = tilt_sd_rad * tangent;
  fix.covariance(kHeading, kHeading) = across_rad * across_rad + tilt_rad * tilt_rad;
  return fix;
}

}  // namespace rockyard::localization
