#include "experiments/three_rock_run/run_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/angles.h"

namespace rockyard::experiments {
namespace {

std::vector<Moment> MomentsOf(const truth::Trace& trace) {
  std::vector<Moment> moments;
  moments.reserve(trace.samples.size());
  double path_m = 0.0;
  for (const truth::TraceSample& sample : trace.samples) {
    if (!moments.empty()) {
      path_m += std::hypot(sample.pose.x_m - moments.back().pose.x_m,
                           sample.pose.y_m - moments.back().pose.y_m);
    }
    const double error_rad = math::WrapAngle(sample.estimate.heading_rad - sample.pose.heading_rad);
    moments.push_back({sample.time_s, path_m, sample.pose, error_rad, sample.activity == "turn"});
  }
  return moments;
}

// Index of the rock nearest to the zone, if it is within reach_m of it.
std::optional<int> NearestRock(std::span<const PlacedRock> rocks, const math::Pose2& rover,
                               const RoverZone& zone, double reach_m) {
  std::optional<int> nearest;
  double least_m = reach_m;
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    const double gap_m = GapToZone(rocks[i], rover, zone);
    if (gap_m > least_m) continue;
    least_m = gap_m;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

}  // namespace

double GapToZone(const PlacedRock& rock, const math::Pose2& rover, const RoverZone& zone) {
  const double dx_m = rock.x_m - rover.x_m;
  const double dy_m = rock.y_m - rover.y_m;
  const double cosine = std::cos(rover.heading_rad);
  const double sine = std::sin(rover.heading_rad);
  const double x_m = cosine * dx_m + sine * dy_m;
  const double y_m = cosine * dy_m - sine * dx_m;
  const double beyond_x_m = std::max({zone.rear_x_m - x_m, 0.0, x_m - zone.front_x_m});
  const double beyond_y_m = std::max(0.0, std::abs(y_m) - zone.half_width_m);
  return std::hypot(beyond_x_m, beyond_y_m) - 0.5 * rock.diameter_m;
}

RunHistory::RunHistory(const truth::Trace& trace, std::span<const PlacedRock> rocks,
                       const RoverZone& array, const RoverZone& body)
    : moments_(MomentsOf(trace)) {
  if (moments_.empty()) return;
  constexpr double kAnywhere_m = std::numeric_limits<double>::infinity();
  for (const truth::TraceEvent& event : trace.events) {
    const bool alarm = event.kind == "hazard";
    if (!alarm && event.kind != "scrape") continue;
    const auto after = std::upper_bound(
        moments_.begin(), moments_.end() - 1, event.time_s,
        [](double time_s, const Moment& moment) { return time_s < moment.time_s; });
    const RockEvent read{after->path_m, static_cast<std::size_t>(after - moments_.begin()),
                         alarm ? NearestRock(rocks, event.pose, array, kAlarmReach_m)
                               : NearestRock(rocks, event.pose, body, kAnywhere_m)};
    (alarm ? alarms_ : scrapes_).push_back(read);
  }
}

const Moment* RunHistory::At(double path_m) const {
  const auto found =
      std::lower_bound(moments_.begin(), moments_.end(), path_m,
                       [](const Moment& moment, double path) { return moment.path_m < path; });
  return found == moments_.end() ? nullptr : &*found;
}

const RockEvent* RunHistory::FirstAlarm(int rock) const {
  const auto found = std::find_if(alarms_.begin(), alarms_.end(),
                                  [&](const RockEvent& alarm) { return alarm.rock == rock; });
  return found == alarms_.end() ? nullptr : &*found;
}

const RockEvent* RunHistory::LastScrape(int rock) const {
  const auto found = std::find_if(scrapes_.rbegin(), scrapes_.rend(),
                                  [&](const RockEvent& scrape) { return scrape.rock == rock; });
  return found == scrapes_.rend() ? nullptr : &*found;
}

int RunHistory::Scrapes(int rock) const {
  return static_cast<int>(std::count_if(scrapes_.begin(), scrapes_.end(),
                                        [&](const RockEvent& s) { return s.rock == rock; }));
}

AvoidanceTurn RunHistory::TurnAfter(const RockEvent& alarm) const {
  AvoidanceTurn turn{0.0, alarm.moment};
  double last_m = alarm.path_m;
  double heading_rad = moments_[alarm.moment > 0 ? alarm.moment - 1 : 0].pose.heading_rad;
  for (std::size_t i = alarm.moment; i < moments_.size(); ++i) {
    const Moment& moment = moments_[i];
    if (moment.path_m - last_m > kTurnChain_m) break;
    if (moment.turning) {
      turn.turned_rad += math::WrapAngle(moment.pose.heading_rad - heading_rad);
      turn.end = i;
      last_m = moment.path_m;
    }
    heading_rad = moment.pose.heading_rad;
  }
  return turn;
}

}  // namespace rockyard::experiments
