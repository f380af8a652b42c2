// The experiment "three_rock_run" (make_experiment.cc): drives like the one of Matthies 1995,
// figures 7 and 8.
//
// One run draws a goal and rock A, and drives. Where the drive goes as the published run is told,
// the run draws places of rock B beside the way that the rover took, until a drive among both goes
// as told, then places of rock C likewise. A drive depends on no rock that it has not come to, so
// that the last one is a drive among all three. The outcome of a run is `measured`; conditions,
// tries and errors are columns.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "experiments/three_rock_run/run_story.h"
#include "experiments/three_rock_run/three_rock_run_params.h"
#include "trial/drive_params.h"
#include "truth/drive_record.h"
#include "truth/record.h"

namespace rockyard::experiments {

// The numbers of a rock as they are drawn.
struct DrawnRock {
  double along_m = 0.0;   // A: gap before the rover; B: path to it; C: path from B to it
  double offset_m = 0.0;  // of its centre beside the rover's way, to the left
  double diameter_m = 0.0;
  double height_m = 0.0;
};

// What the streams of a trial are for. Records depend on the substreams of kExperiment: one for the
// goal and rock A, then one for each place that is tried of B, and of C (StreamOf).
enum class DrawnPart { kStart, kSecondRock, kThirdRock };

// Returns the stream of the number-th try, from 0.
core::RandomStream StreamOf(DrawnPart part, std::int64_t number, core::TrialKey key);

// Return uniform numbers of the prior, the next ones of `stream`. Must stay: the order along,
// offset, diameter, height.
double DrawUniform(const UniformRange& range, core::RandomStream& stream);
DrawnRock DrawRock(const RockPrior& prior, core::RandomStream& stream);

// Returns the place of rock A, so that a rover on the line to the goal, whose front is front_x_m
// ahead of its centre, comes to within the rock's gap at path_m.
PlacedRock PlaceFirstRock(const DrawnRock& rock, double path_m, double front_x_m);

// Returns the place of a rock beside the way that was driven: `offset_m` to the left of the rover
// where its centre had come to path_m. None where the run ended before.
std::optional<PlacedRock> PlaceOnPath(const DrawnRock& rock, double path_m,
                                      const RunHistory& history);

// What the paper tells of the run in numbers (section 5), signed as HeadingStages. Meanings of the
// columns "..._below" repeat them: both change together.
inline constexpr HeadingStages kPublishedStages{-5.0, 10.0, 10.0, 15.0, 15.3};
inline constexpr double kPublishedPositionError_m = 1.0;

// A rock that was not placed.
inline constexpr PlacedRock kNowhere{
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

// How many tries of rock C met each of its conditions.
struct ThirdRockCounts {
  int detected = 0;
  int turned = 0;
  int scraped = 0;
  int arrived = 0;
  int length = 0;

  void Add(const ThirdRockStory& story) {
    detected += story.detected ? 1 : 0;
    turned += story.turned ? 1 : 0;
    scraped += story.scraped ? 1 : 0;
    arrived += story.arrived ? 1 : 0;
    length += story.length ? 1 : 0;
  }
};

// What the columns of one run tell.
struct ThreeRockRecord {
  FirstRockStory a_story;
  bool a_as_told = false;
  bool b_as_told = false;
  bool accepted = false;
  int b_tries = 0;
  int b_unseen = 0;
  int b_scraped = 0;
  int b_passed = 0;
  int c_tries = 0;
  ThirdRockCounts c_counts;

  double goal_m = 0.0;
  double b_path_m = 0.0;
  // The rocks that were tried last.
  PlacedRock a = kNowhere;
  PlacedRock b = kNowhere;
  PlacedRock c = kNowhere;

  // Ends of accepted runs; 0 of other runs.
  int b_scrapes = 0;
  int c_scrapes = 0;
  HeadingStages stages;
  double heading_error_deg = 0.0;  // absolute
  double position_error_m = 0.0;
  double length_m = 0.0;

  // Takes the end of the drive that was accepted.
  void SetEnd(const RunHistory& history, const truth::DriveRecord& end) {
    b_scrapes = history.Scrapes(kRockB);
    c_scrapes = history.Scrapes(kRockC);
    stages = StagesOf(history);
    heading_error_deg = end.heading_error_deg;
    position_error_m = end.position_error_m;
    length_m = end.true_distance_m;
  }
};

template <typename Visitor>
void ForEachColumn(const ThreeRockRecord& r, Visitor visit) {
  using enum truth::ColumnRole;
  const auto flag = [](bool value) { return value ? 1.0 : 0.0; };
  const auto told = [&](bool value) { return flag(r.accepted && value); };
  visit({"runs", "1", "layouts drawn", kTrials}, 1.0);
  visit({"false_alarm", "1", "an alarm without a rock came before any other", kCount, "runs"},
        flag(r.a_story.false_alarm));
  visit({"a_detected", "1", "A raised the first true alarm, where told", kCount, "runs"},
        flag(r.a_story.detected));
  visit({"a_turned", "1", "turned in place after A's alarm", kCount, "runs"},
        flag(r.a_story.turned));
  visit({"a_unscraped", "1", "A was not scraped", kCount, "runs"}, flag(r.a_story.unscraped));
  visit({"a_as_told", "1", "all conditions on A", kCount, "runs"}, flag(r.a_as_told));
  visit({"b_tries", "1", "places of B that were tried", kBase}, r.b_tries);
  visit({"b_unseen", "1", "B raised no alarm", kCount, "b_tries"}, r.b_unseen);
  visit({"b_scraped", "1", "B was scraped as often as told", kCount, "b_tries"}, r.b_scraped);
  visit({"b_passed", "1", "arrived, in belief and to 2 m in truth, with A and B alone", kCount,
         "b_tries"},
        r.b_passed);
  visit({"b_as_told", "1", "all conditions on A and B", kCount, "b_tries"}, flag(r.b_as_told));
  visit({"c_tries", "1", "places of C that were tried", kBase}, r.c_tries);
  visit({"c_detected", "1", "C raised an alarm after B's last scrape", kCount, "c_tries"},
        r.c_counts.detected);
  visit({"c_turned", "1", "turned in place at C by about the told angle", kCount, "c_tries"},
        r.c_counts.turned);
  visit({"c_scraped", "1", "C was scraped after its alarm", kCount, "c_tries"}, r.c_counts.scraped);
  visit({"arrived", "1", "believed to be at the goal", kCount, "c_tries"}, r.c_counts.arrived);
  visit({"length_told", "1", "true length as told", kCount, "c_tries"}, r.c_counts.length);
  visit({"c_as_told", "1", "all conditions on a drive among all three", kCount, "c_tries"},
        flag(r.accepted));
  visit({"accepted", "1", "all conditions: a run like the published one", kMainCount, "runs"},
        flag(r.accepted));
  visit({"heading_error_deg", "deg", "final heading error, absolute", kSum, "accepted"},
        r.heading_error_deg);
  visit({"position_error_m", "m", "final position error", kSum, "accepted"}, r.position_error_m);
  visit({"length_m", "m", "true length", kSum, "accepted"}, r.length_m);
  visit({"after_a_deg", "deg", "heading error after the turn at A, positive to the side of it",
         kSum, "accepted"},
        r.stages.after_a_deg);
  visit({"after_b_deg", "deg", "the same after the last scrape of B", kSum, "accepted"},
        r.stages.after_b_deg);
  visit({"at_c_deg", "deg", "the same as C is detected", kSum, "accepted"}, r.stages.at_c_deg);
  visit({"after_c_deg", "deg", "the same after the last scrape of C", kSum, "accepted"},
        r.stages.after_c_deg);
  visit({"final_deg", "deg", "the same at the end", kSum, "accepted"}, r.stages.final_deg);
  visit({"heading_below", "1", "heading_error_deg below the published 15.3", kCount, "accepted"},
        told(r.heading_error_deg < kPublishedStages.final_deg));
  visit({"position_below", "1", "position_error_m below the published 1.0", kCount, "accepted"},
        told(r.position_error_m < kPublishedPositionError_m));
  visit({"after_a_below", "1", "after_a_deg below the published -5", kCount, "accepted"},
        told(r.stages.after_a_deg < kPublishedStages.after_a_deg));
  visit({"after_b_below", "1", "after_b_deg below the published 10", kCount, "accepted"},
        told(r.stages.after_b_deg < kPublishedStages.after_b_deg));
  visit({"at_c_below", "1", "at_c_deg below the published 10", kCount, "accepted"},
        told(r.stages.at_c_deg < kPublishedStages.at_c_deg));
  visit({"after_c_below", "1", "after_c_deg below the published 15", kCount, "accepted"},
        told(r.stages.after_c_deg < kPublishedStages.after_c_deg));
  visit({"b_scrapes", "1", "scrapes of B", kSum, "accepted"}, r.b_scrapes);
  visit({"c_scrapes", "1", "scrapes of C", kSum, "accepted"}, r.c_scrapes);
  visit({"goal_m", "m", "start to goal"}, r.goal_m);
  const auto rock = [&](const std::string& name, const PlacedRock& placed) {
    const std::string what = name == "a" ? "A" : name == "b" ? "B" : "C";
    visit({name + "_x_m", "m", "centre of rock " + what + "; none where it was not placed"},
          placed.x_m);
    visit({name + "_y_m", "m", "to the left"}, placed.y_m);
    visit({name + "_diameter_m", "m", "its diameter"}, placed.diameter_m);
    visit({name + "_height_m", "m", "its height above the ground"}, placed.height_m);
  };
  rock("a", r.a);
  rock("b", r.b);
  rock("c", r.c);
}

// Returns every column but the number of the cell, in the order of ForEachColumn.
const truth::RecordSchema& ThreeRockColumns();

class ThreeRockRunExperiment final : public CellExperiment {
 public:
  // The experiment replaces the rocks and the goal of `drive`.
  ThreeRockRunExperiment(const ThreeRockRunParams& params, trial::DriveParams drive);

 private:
  struct Driven;

  struct Course;  // a goal, and rocks so far

  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override;
  ThreeRockRecord RecordUnder(core::TrialKey key) const;
  Driven DriveAmong(const Course& course) const;
  // Try places of a rock until the drive goes as told. Return whether it did.
  bool TrySecondRock(const RunHistory& with_a, Course& course, ThreeRockRecord& record) const;
  bool TryThirdRock(const RunHistory& with_b, Course& course, ThreeRockRecord& record) const;

  ThreeRockRunParams params_;
  trial::DriveParams drive_;
  RoverZone array_;
  RoverZone body_;
};

}  // namespace rockyard::experiments
