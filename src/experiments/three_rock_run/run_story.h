// What happened on a drive among a few rocks, read from its trace; whether it went as the published
// run is told, and what its heading error was at each stage. The experiment "three_rock_run" judges
// its drives by it, so that its records depend on every condition and length here. It sees the
// truth: rocks are told apart by where they truly are.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiments/three_rock_run/three_rock_run_params.h"
#include "math/pose.h"
#include "truth/trace.h"

namespace rockyard::experiments {

struct PlacedRock {
  double x_m = 0.0;  // centre, in W
  double y_m = 0.0;
  double diameter_m = 0.0;
  double height_m = 0.0;
};

// A rectangle of the rover's frame that lies evenly about its x axis.
struct RoverZone {
  double rear_x_m = 0.0;
  double front_x_m = 0.0;
  double half_width_m = 0.0;
};

// A control tick of the drive.
struct Moment {
  double time_s = 0.0;
  double path_m = 0.0;             // true, of the rover's centre, up to here
  math::Pose2 pose;                // true
  double heading_error_rad = 0.0;  // believed less true
  bool turning = false;            // in place
};

// An alarm that was believed, or a scrape.
struct RockEvent {
  double path_m = 0.0;
  std::size_t moment = 0;   // index of the first moment after the event, or of the last moment
  std::optional<int> rock;  // index of the rock; none for an alarm without a rock
};

// The turn in place by which the rover answers an alarm: every tick of turning that follows it by
// no more than kTurnChain_m of path since the alarm or the tick of turning before.
struct AvoidanceTurn {
  double turned_rad = 0.0;  // true, positive to the left
  std::size_t end = 0;      // index of the moment at its end; that of the alarm without a turn
};

// Path without turning after which an avoidance is over. Looks during an avoidance are one scan
// interval (0.065 m) apart.
inline constexpr double kTurnChain_m = 0.15;
// How far from the array the nearest rock may be to own an alarm. Elevations are seen wrongly by
// less, but the rover pitches and rolls.
inline constexpr double kAlarmReach_m = 0.10;

class RunHistory {
 public:
  // Reads `trace` of a drive among `rocks`. `array` is the ground that the hazard sensor measures,
  // `body` the rover's outline. Cost: linear in the trace.
  RunHistory(const truth::Trace& trace, std::span<const PlacedRock> rocks, const RoverZone& array,
             const RoverZone& body);

  const std::vector<Moment>& moments() const { return moments_; }
  const std::vector<RockEvent>& alarms() const { return alarms_; }
  const std::vector<RockEvent>& scrapes() const { return scrapes_; }

  // Returns the first moment at which the path is at least path_m; null where it never is.
  const Moment* At(double path_m) const;

  // Returns the first alarm of a rock; null where there was none.
  const RockEvent* FirstAlarm(int rock) const;
  // Returns the last scrape of a rock; null where there was none.
  const RockEvent* LastScrape(int rock) const;
  int Scrapes(int rock) const;

  AvoidanceTurn TurnAfter(const RockEvent& alarm) const;

 private:
  std::vector<Moment> moments_;
  std::vector<RockEvent> alarms_;
  std::vector<RockEvent> scrapes_;
};

// Returns the gap from the edge of a round rock to a zone of a rover at `rover`, m; negative where
// the rock's circle reaches into the zone by that much or covers its edge.
double GapToZone(const PlacedRock& rock, const math::Pose2& rover, const RoverZone& zone);

// Indices of the rocks in the order in which they are placed.
inline constexpr int kRockA = 0;
inline constexpr int kRockB = 1;
inline constexpr int kRockC = 2;

// Conditions on rock A, which do not depend on what lies beyond it.
struct FirstRockStory {
  bool false_alarm = false;  // the first alarm belongs to no rock
  bool detected = false;     // A raised the first other alarm, at about the told path
  bool turned = false;       // the rover turned in place then
  bool unscraped = false;

  bool AsTold(const ThreeRockTold& told) const {
    return detected && turned && unscraped && (false_alarm || !told.false_alarm);
  }
};

// Conditions on rock B.
struct SecondRockStory {
  bool unseen = false;   // raised no alarm
  bool scraped = false;  // as often as told, or more, and after A was detected
  bool passed = false;   // the rover went on and arrived

  bool AsTold() const { return unseen && scraped && passed; }
};

// Conditions on rock C and on the run as a whole.
struct ThirdRockStory {
  bool detected = false;  // after the last scrape of B
  bool turned = false;    // in place by about the told angle
  bool scraped = false;   // after it was detected
  bool arrived = false;   // the rover believed to be at the goal
  bool length = false;    // as told

  bool AsTold() const { return detected && turned && scraped && arrived && length; }
};

FirstRockStory TellFirstRock(const RunHistory& history, const ThreeRockTold& told);
SecondRockStory TellSecondRock(const RunHistory& history, const ThreeRockTold& told, bool passed);
ThirdRockStory TellThirdRock(const RunHistory& history, const ThreeRockTold& told, bool arrived,
                             double length_m);

// Heading errors, believed less true, deg, counted positive towards the side to which the rover
// turned at rock A. What an underestimated turn leaves there is negative, as in the published run.
struct HeadingStages {
  double after_a_deg = 0.0;  // at the end of the turn in place at A
  double after_b_deg = 0.0;  // kSettled_m past the last scrape of B
  double at_c_deg = 0.0;     // as C is detected
  double after_c_deg = 0.0;  // kSettled_m past the last scrape of C, or at the end
  double final_deg = 0.0;
};

// Path after a scrape at which the scrape's jump is in the estimate.
inline constexpr double kSettled_m = 0.10;

// Returns the stages of a drive in which A and C were detected, and B and C scraped (FirstRockStory
// and so on).
HeadingStages StagesOf(const RunHistory& history);

}  // namespace rockyard::experiments
