#include "experiments/three_rock_run/run_story.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::experiments {
namespace {

// Least turn that counts as one: a rover that turns at all turns by an increment of 10 deg.
constexpr double kLeastTurn_rad = math::DegToRad(5.0);

// Returns the first alarm that some rock raised.
const RockEvent* FirstTrueAlarm(const RunHistory& history) {
  const auto& alarms = history.alarms();
  const auto found = std::find_if(alarms.begin(), alarms.end(),
                                  [](const RockEvent& alarm) { return alarm.rock.has_value(); });
  return found == alarms.end() ? nullptr : &*found;
}

double PathOfFirstScrape(const RunHistory& history, int rock) {
  for (const RockEvent& scrape : history.scrapes()) {
    if (scrape.rock == rock) return scrape.path_m;
  }
  return -1.0;
}

double ErrorAfter(const RunHistory& history, const RockEvent& event) {
  const Moment* settled = history.At(event.path_m + kSettled_m);
  return (settled != nullptr ? *settled : history.moments().back()).heading_error_rad;
}

}  // namespace

FirstRockStory TellFirstRock(const RunHistory& history, const ThreeRockTold& told) {
  FirstRockStory story;
  story.unscraped = history.Scrapes(kRockA) == 0;
  const RockEvent* alarm = FirstTrueAlarm(history);
  story.false_alarm = !history.alarms().empty() && !history.alarms().front().rock.has_value();
  if (alarm == nullptr || alarm->rock != kRockA) return story;
  story.detected = std::abs(alarm->path_m - told.a_path_m) <= told.a_path_tolerance_m;
  story.turned = std::abs(history.TurnAfter(*alarm).turned_rad) >= kLeastTurn_rad;
  return story;
}

SecondRockStory TellSecondRock(const RunHistory& history, const ThreeRockTold& told, bool passed) {
  SecondRockStory story;
  story.passed = passed;
  story.unseen = history.FirstAlarm(kRockB) == nullptr;
  const RockEvent* alarm = history.FirstAlarm(kRockA);
  story.scraped = history.Scrapes(kRockB) >= told.b_scrapes && alarm != nullptr &&
                  PathOfFirstScrape(history, kRockB) > alarm->path_m;
  return story;
}

ThirdRockStory TellThirdRock(const RunHistory& history, const ThreeRockTold& told, bool arrived,
                             double length_m) {
  ThirdRockStory story;
  story.arrived = arrived;
  story.length = std::abs(length_m - told.length_m) <= told.length_tolerance_m;
  const RockEvent* alarm = history.FirstAlarm(kRockC);
  if (alarm == nullptr) return story;
  const RockEvent* b_scrape = history.LastScrape(kRockB);
  story.detected = b_scrape != nullptr && b_scrape->path_m < alarm->path_m;
  const double turned_rad = std::abs(history.TurnAfter(*alarm).turned_rad);
  story.turned = std::abs(turned_rad - told.c_turn_rad) <= told.c_turn_tolerance_rad;
  const RockEvent* c_scrape = history.LastScrape(kRockC);
  story.scraped = c_scrape != nullptr && c_scrape->path_m > alarm->path_m;
  return story;
}

HeadingStages StagesOf(const RunHistory& history) {
  const RockEvent* a = history.FirstAlarm(kRockA);
  const RockEvent* c = history.FirstAlarm(kRockC);
  const RockEvent* b_scrape = history.LastScrape(kRockB);
  const RockEvent* c_scrape = history.LastScrape(kRockC);
  EXPECT(a != nullptr && c != nullptr && b_scrape != nullptr && c_scrape != nullptr);
  const AvoidanceTurn turn = history.TurnAfter(*a);
  const double sign = turn.turned_rad < 0.0 ? -1.0 : 1.0;
  const auto deg = [&](double error_rad) { return sign * math::RadToDeg(error_rad); };
  const std::vector<Moment>& moments = history.moments();
  return {deg(moments[turn.end].heading_error_rad), deg(ErrorAfter(history, *b_scrape)),
          deg(moments[c->moment].heading_error_rad), deg(ErrorAfter(history, *c_scrape)),
          deg(moments.back().heading_error_rad)};
}

namespace {

// Activities and events must have the names that truth/trace.h lists.
std::vector<Moment> MomentsOf(const truth::Trace& trace) {
  std::vector<Moment> moments;
  moments.reserve(trace.samples.size());
  double path_m = 0.0;
  for (const truth::TraceSample& sample : trace.samples) {
    if (!moments.empty()) {
      path_m += math::Hypot(sample.pose.x_m - moments.back().pose.x_m,
                            sample.pose.y_m - moments.back().pose.y_m);
    }
    const double error_rad = math::WrapAngle(sample.estimate.heading_rad - sample.pose.heading_rad);
    moments.push_back({sample.time_s, path_m, sample.pose, error_rad, sample.activity == "turn"});
  }
  return moments;
}

// Returns the index of the rock nearest to the zone, if it is within reach_m of the zone.
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
  const auto [sine, cosine] = math::SinCos(rover.heading_rad);
  const double x_m = cosine * dx_m + sine * dy_m;
  const double y_m = cosine * dy_m - sine * dx_m;
  const double beyond_x_m = std::max({zone.rear_x_m - x_m, 0.0, x_m - zone.front_x_m});
  const double beyond_y_m = std::max(0.0, std::abs(y_m) - zone.half_width_m);
  return math::Hypot(beyond_x_m, beyond_y_m) - 0.5 * rock.diameter_m;
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
