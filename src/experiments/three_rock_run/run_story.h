// Whether a drive went as the published run is told, and what its heading error was at each stage.
#pragma once

#include "experiments/three_rock_run/run_history.h"
#include "experiments/three_rock_run/three_rock_run_params.h"

namespace rockyard::experiments {

// Indices of the rocks in the order in which they are placed.
inline constexpr int kRockA = 0;
inline constexpr int kRockB = 1;
inline constexpr int kRockC = 2;

// Conditions on rock A, which do not depend on what lies beyond it.
struct FirstRockStory {
  bool false_alarm = false;  // a hazard was believed where there is none, before A was detected
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
// turned at rock A: what an underestimated turn leaves there is negative, as in the published run.
struct HeadingStages {
  double after_a_deg = 0.0;  // at the end of the turn in place at A
  double after_b_deg = 0.0;  // kSettled_m past the last scrape of B
  double at_c_deg = 0.0;     // as C is detected
  double after_c_deg = 0.0;  // kSettled_m past the last scrape of C, or at the end
  double final_deg = 0.0;
};

// Path after a scrape at which its jump is in the estimate.
inline constexpr double kSettled_m = 0.10;

// Of a drive in which A and C were detected, and B and C scraped (FirstRockStory and so on).
HeadingStages StagesOf(const RunHistory& history);

}  // namespace rockyard::experiments
