#include "experiments/three_rock_run/run_story.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "math/angles.h"

namespace rockyard::experiments {
namespace {

// A rover that turns at all turns by an increment of 10 deg.
constexpr double kLeastTurn_rad = math::DegToRad(5.0);

// The first alarm that some rock raised.
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

}  // namespace rockyard::experiments
