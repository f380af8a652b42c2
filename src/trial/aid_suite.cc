#include "trial/aid_suite.h"

#include <algorithm>
#include <cmath>

#include "localization/aid_fixes.h"
#include "trial/goal_designation.h"

namespace rockyard::trial {
namespace {

localization::SunAlmanac AlmanacOf(const sensing::SunSensorParams& sun) {
  return {.latitude_rad = sun.latitude_rad,
          .declination_rad = math::SunDeclination(sun.areocentric_longitude_rad),
          .start_solar_time_h = sun.start_solar_time_h,
          .north_heading_rad = sun.north_heading_rad};
}

sensing::LanderPlace SeenFrom(const DriveParams& drive, core::TrialKey key) {
  sensing::LanderPlace lander = LanderPlaceOf(drive.course, key);
  if (!drive.sensors.aids.lander_fix.shares_pan_error) lander.pan_error_rad = 0.0;
  return lander;
}

}  // namespace

AidSuite::AidSuite(const DriveParams& drive, core::TrialKey key, const terrain::Terrain& terrain,
                   CaptureCounter& captures)
    : terrain_(terrain),
      captures_(captures),
      params_(drive.sensors.aids),
      almanac_(AlmanacOf(params_.sun)),
      lander_fix_(params_.lander_fix, SeenFrom(drive, key), key),
      sun_(params_.sun, key),
      beacon_(params_.beacon, LanderPlaceOf(drive.course, key), key),
      lander_schedule_(params_.lander_fix.schedule),
      sun_schedule_(params_.sun.schedule),
      beacon_schedule_(params_.beacon.schedule) {}

bool AidSuite::Tick(const math::Transform& X_WR, double time_s,
                    localization::Estimator& estimator) {
  if (!params_.AnyEnabled()) return false;
  MeasureAll(X_WR, time_s, estimator);
  bool corrected = false;
  for (auto next = waiting_.begin(); next != waiting_.end();) {
    if (next->ready_s > time_s) {
      ++next;
      continue;
    }
    corrected = HandIn(next->fix, estimator) || corrected;
    next = waiting_.erase(next);
  }
  return corrected;
}

void AidSuite::MeasureAll(const math::Transform& X_WR, double time_s,
                          localization::Estimator& estimator) {
  const double way_m = estimator.estimate().pose.distance_m;
  if (lander_schedule_.IsDue(way_m, time_s)) {
    Take(lander_fix_.Observe(X_WR, terrain_, lander_number_++, SunElevation_rad(time_s)),
         time_s + params_.lander_fix.schedule.delay_s, estimator);
  }
  if (sun_schedule_.IsDue(way_m, time_s)) {
    Take(LookForSun(X_WR, time_s, estimator), time_s + params_.sun.schedule.delay_s, estimator);
  }
  if (beacon_schedule_.IsDue(way_m, time_s)) {
    Take(AskBeacon(X_WR, estimator), time_s + params_.beacon.schedule.delay_s, estimator);
  }
}

std::optional<double> AidSuite::SunElevation_rad(double time_s) const {
  if (!params_.sun.schedule.enabled) return std::nullopt;
  return std::asin(std::clamp(almanac_.Sun_W(time_s).z(), -1.0, 1.0));
}

std::optional<messages::PoseFix> AidSuite::LookForSun(const math::Transform& X_WR, double time_s,
                                                      const localization::Estimator& estimator) {
  const math::Vector3 sun_W = almanac_.Sun_W(time_s);
  const auto sighting = sun_.Observe(X_WR, sun_W, terrain_, sun_number_++);
  if (!sighting) return std::nullopt;
  return localization::HeadingFromSun(*sighting, estimator.estimate().attitude, sun_W,
                                      params_.sun.tilt_sd_rad);
}

std::optional<messages::PoseFix> AidSuite::AskBeacon(const math::Transform& X_WR,
                                                     const localization::Estimator& estimator) {
  const auto reading = beacon_.Observe(X_WR, beacon_number_++);
  if (!reading) return std::nullopt;
  return localization::PlaceFromBeacon(*reading, estimator.estimate());
}

void AidSuite::Take(std::optional<messages::PoseFix> fix, double ready_s,
                    localization::Estimator& estimator) {
  if (!fix) {
    ++counts_.unanswered;
    return;
  }
  fix->capture = captures_.Next();
  estimator.Capture(fix->capture);
  waiting_.push_back({ready_s, *fix});
}

bool AidSuite::HandIn(const messages::PoseFix& fix, localization::Estimator& estimator) {
  const localization::AidUse use = estimator.Update(fix);
  estimator.Forget(fix.capture);
  switch (use) {
    case localization::AidUse::kUsed:
      ++counts_.used;
      return true;
    case localization::AidUse::kUsedInDoubt:
      ++counts_.used;
      ++counts_.in_doubt;
      return true;
    case localization::AidUse::kGatedOut:
      ++counts_.gated_out;
      return false;
    case localization::AidUse::kUnknown:
    case localization::AidUse::kNoInterest:
      return false;
  }
  return false;
}

}  // namespace rockyard::trial
