#include "trial/aids/aid_suite.h"

#include "math/sun_position.h"

namespace rockyard::trial {

localization::SunAlmanac AlmanacOf(const sensing::SunSensorParams& sun) {
  return {.latitude_rad = sun.latitude_rad,
          .declination_rad = math::SunDeclination(sun.areocentric_longitude_rad),
          .start_solar_time_h = sun.start_solar_time_h,
          .north_heading_rad = sun.north_heading_rad};
}

AidSuite::AidSuite(const sensing::AidParams& params, CaptureCounter& captures)
    : captures_(&captures),
      params_(params),
      almanac_(AlmanacOf(params_.sun)),
      lander_schedule_(params_.lander_fix.schedule),
      sun_schedule_(params_.sun.schedule),
      beacon_schedule_(params_.beacon.schedule) {}

AidRequest AidSuite::Due(const localization::Estimator& estimator, double time_s) {
  const double way_m = estimator.estimate().pose.distance_m;
  AidRequest request;
  if (lander_schedule_.IsDue(way_m, time_s)) request.lander = lander_number_++;
  if (sun_schedule_.IsDue(way_m, time_s)) request.sun = sun_number_++;
  if (beacon_schedule_.IsDue(way_m, time_s)) request.beacon = beacon_number_++;
  return request;
}

bool AidSuite::Take(const AidRequest& request, const AidAnswer& answer, double time_s,
                    localization::Estimator& estimator) {
  const messages::LocalizationEstimate& believed = estimator.estimate();
  if (request.lander) {
    Keep(answer.lander, time_s + params_.lander_fix.schedule.delay_s, estimator);
  }
  if (request.sun) {
    std::optional<messages::PoseFix> fix;
    if (answer.sun) {
      fix = localization::HeadingFromSun(*answer.sun, believed.attitude, almanac_.Sun_W(time_s),
                                         params_.sun.tilt_sd_rad);
    }
    Keep(fix, time_s + params_.sun.schedule.delay_s, estimator);
  }
  if (request.beacon) {
    std::optional<messages::PoseFix> fix;
    if (answer.beacon) fix = localization::PlaceFromBeacon(*answer.beacon, believed);
    Keep(fix, time_s + params_.beacon.schedule.delay_s, estimator);
  }
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

void AidSuite::Keep(std::optional<messages::PoseFix> fix, double ready_s,
                    localization::Estimator& estimator) {
  if (!fix) {
    ++counts_.unanswered;
    return;
  }
  fix->capture = captures_->Next();
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
