// Fixes by aids of localization: what they say of the pose, and whether they are believed. The
// error-state filter gates its measurements by Gate, and the aids of a drive make their fixes of
// what was measured by PlaceFromBeacon and HeadingFromSun. Records depend on it where the estimator
// takes fixes: on counts of fixes, and on all that a corrected pose decides.
//
// A measurement of m values with the residual r of covariance S is let in where r' S^-1 r is at
// most the chi-squared quantile of 1 - chance with m degrees of freedom: a filter that knows its
// own error turns away one good measurement in 1 / chance. A filter that does not (wheels slipped,
// the gyro was shaken) would turn all measurements away, for ever. So the `patience`-th measurement
// that is turned away in a row is let in, after the filter has doubted itself by as much as that
// measurement asks for. Each kind of measurement has a gate of its own: good measurements of the
// heading do not excuse wrong ones of the place. Wrong measurements that come singly, with
// probability p each, are let in by that with p^patience.
#pragma once

#include <array>
#include <cstdint>

#include "localization/error_state_filter_params.h"
#include "math/sun_position.h"
#include "messages/aids.h"
#include "messages/estimates.h"

namespace rockyard::localization {

// What becomes of one measurement.
enum class GateAnswer {
  kIn,
  kOut,
  kDoubtYourself,  // to be let in, once the filter has made its own error larger
};

// The gate of one kind of measurement.
class Gate {
 public:
  explicit Gate(const GateParams& params);

  // Judges a measurement of 1 to 6 values by its r' S^-1 r.
  GateAnswer Ask(double mahalanobis_squared, int values);
  // Forgets what was turned away.
  void Restart() { turned_away_ = 0; }

 private:
  static constexpr int kMostValues = 6;

  std::array<double, kMostValues + 1> limit_{};  // by the number of values
  std::int64_t patience_;
  std::int64_t turned_away_ = 0;  // in a row
};

// Returns the place that a beacon's reading tells, in W: p = s + r (cos b, sin b) about the station
// s. Its covariance is sd_r^2 along and (range^2 + sd_r^2) sd_b^2 across the direction to the place
// where the rover was believed to be at the reading. With the measured range and bearing in their
// stead, the weight of a place would depend on its error: a place whose range came out short would
// count as nearly exact across, and all places would lie towards the station by sd_r^2 over the
// range (Bordonaro, Willett and Bar-Shalom 2014, decorrelated converted measurements). Limits:
// directions are weighed by range squared, which is narrow across where the belief is much wider
// along than the range; a wrong belief turns the ellipse; the place is too near by sd_b^2 / 2 of
// the range (0.14 % for 3 deg).
messages::PoseFix PlaceFromBeacon(const messages::BeaconReading& reading,
                                  const messages::LocalizationEstimate& believed);

// What on-board software knows of the sky.
struct SunAlmanac {
  double latitude_rad = 0.0;
  double declination_rad = 0.0;
  double start_solar_time_h = 12.0;  // true solar time when the drive begins
  double north_heading_rad = 0.0;    // of north in W

  // Returns the unit vector to the sun, in W, time_s after the drive began.
  math::Vector3 Sun_W(double time_s) const;
};

// Returns the heading at the moment of the sighting, for the attitude that was believed then and
// `sun_W` as the almanac says. The sun's measured direction is turned level by roll and pitch,
// s_L = Ry(pitch) Rx(roll) s_R; the heading is the sun's true azimuth less that of s_L. A tilt that
// is wrong by e about the horizontal direction to the sun shifts the azimuth of s_L by
// e tan(elevation), and a measured direction that is wrong across by d shifts it by
// d / cos(elevation): a high sun is a poor compass. Roll and pitch each have a standard deviation
// of tilt_sd_rad. The sun stands neither in the zenith nor below the horizon.
messages::PoseFix HeadingFromSun(const messages::SunSighting& sighting,
                                 const messages::AttitudeEstimate& attitude,
                                 const math::Vector3& sun_W, double tilt_sd_rad);

}  // namespace rockyard::localization
