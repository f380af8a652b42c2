#include "trial/drive/aid_sensors.h"

#include <algorithm>
#include <optional>

#include "math/functions.h"
#include "trial/aids/aid_suite.h"
#include "trial/course/goal_designation.h"

namespace rockyard::trial {
namespace {

sensing::LanderPlace SeenFrom(const DriveParams& drive, core::TrialKey key) {
  sensing::LanderPlace lander = LanderPlaceOf(drive.course, key);
  if (!drive.sensors.aids.lander_fix.shares_pan_error) lander.pan_error_rad = 0.0;
  return lander;
}

}  // namespace

AidSensors::AidSensors(const DriveParams& drive, core::TrialKey key,
                       const terrain::Terrain& terrain)
    : terrain_(terrain),
      sun_is_told_(drive.sensors.aids.sun.schedule.enabled),
      almanac_(AlmanacOf(drive.sensors.aids.sun)),
      lander_fix_(drive.sensors.aids.lander_fix, SeenFrom(drive, key), key),
      sun_(drive.sensors.aids.sun, key),
      beacon_(drive.sensors.aids.beacon, LanderPlaceOf(drive.course, key), key) {}

AidAnswer AidSensors::Answer(const AidRequest& request, const math::Transform& X_WR,
                             double time_s) const {
  AidAnswer answer;
  if (request.lander) {
    std::optional<double> elevation_rad;
    if (sun_is_told_) {
      elevation_rad = math::Asin(std::clamp(almanac_.Sun_W(time_s).z(), -1.0, 1.0));
    }
    answer.lander = lander_fix_.Observe(X_WR, terrain_, *request.lander, elevation_rad);
  }
  if (request.sun) {
    answer.sun = sun_.Observe(X_WR, almanac_.Sun_W(time_s), terrain_, *request.sun);
  }
  if (request.beacon) answer.beacon = beacon_.Observe(X_WR, *request.beacon);
  return answer;
}

}  // namespace rockyard::trial
