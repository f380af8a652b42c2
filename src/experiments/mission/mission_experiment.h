// The experiment "mission" (make_experiment.cc): one run is one mission of many sols.
//
// Its outcome is `measured`; MissionColumns lists what is counted. With mission.sol_columns a block
// of columns for every sol follows, with NaN for sols that the mission did not last.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/cell_experiment.h"
#include "experiments/mission/mission.h"
#include "experiments/mission/mission_params.h"
#include "math/angles.h"
#include "trial/clock/power.h"
#include "trial/drive_params.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Sols after which the paper's mission is over: its primary mission of a week, and its goal of four
// weeks. Must stay: columns are named by them.
inline constexpr std::array<std::int64_t, 2> kCheckpoints{7, 30};

// Where the rover is at a checkpoint, or where its mission ended before that.
struct Checkpoint {
  bool lasted = false;  // the mission lasted up to the checkpoint
  double position_error_m = 0.0;
  double heading_error_deg = 0.0;
  double position_sd_m = 0.0;  // as believed
  bool judged = false;         // the rover keeps account of its error
  bool inside_95 = false;
  double goal_frame_error_m = 0.0;
  bool goal_frame_inside_95 = false;
};

// What the columns of one mission tell.
struct MissionRecord {
  std::int64_t goals = 0;
  std::int64_t spare_images = 0;  // in a sol, see SpareImages
  MissionCourse course;
  std::array<Checkpoint, kCheckpoints.size()> checkpoints;
  double distance_m = 0.0;
  double longest_sol_m = 0.0;
  std::array<std::int64_t, kSolEnds> sol_ends{};
  std::int64_t sights = 0;  // days on which the lander took its image
  std::int64_t unseen = 0;  // of `sights`, without the rover in them
  SolEnergy energy;
  double battery_left_wh = 0.0;

  MissionRecord(const MissionParams& params, MissionCourse course);
};

namespace mission_columns {

// Returns a column that counts some of the base `of`.
truth::ValueInfo Count(const std::string& name, const std::string& meaning, const std::string& of);
// Returns a column of a sum in that unit, with a mean for each of the base `of`.
truth::ValueInfo Sum(const std::string& name, const std::string& unit, const std::string& meaning,
                     const std::string& of = "missions");

}  // namespace mission_columns

// Calls visit(column, value) for what a sum of energies holds.
template <typename Visitor>
void ForEachEnergyColumn(const SolEnergy& e, Visitor visit) {
  // Must have the order of trial::Activity.
  constexpr std::array<std::string_view, trial::kActivityCount> kActivities{
      "drive", "turn", "steer", "scan", "stall", "imaging", "compute", "overhead"};
  const auto sum = [&](const std::string& name, const std::string& meaning, double value) {
    visit(mission_columns::Sum(name, "Wh", meaning), value);
  };
  sum("sun_wh", "source: taken from the sun", e.sun_wh);
  sum("battery_wh", "source: taken from the batteries", e.battery_wh);
  sum("overdrawn_wh", "source: taken in the moment in which batteries became empty",
      e.overdrawn_wh);
  for (std::size_t i = 0; i < kActivities.size(); ++i) {
    sum(std::string(kActivities[i]) + "_wh", "sink: that activity of drives", e.drive_wh[i]);
  }
  sum("idle_wh", "sink: awake after drives", e.idle_wh);
  sum("transmit_wh", "sink: awake and transmitting", e.transmit_wh);
  sum("sleep_wh", "sink: asleep", e.sleep_wh);
  sum("sun_available_wh", "what the cells could have given", e.sun_available_wh);
}

template <typename Visitor>
void ForEachCheckpointColumn(const MissionRecord& r, Visitor visit) {
  const auto flag = [](bool value) { return value ? 1.0 : 0.0; };
  using mission_columns::Count;
  using mission_columns::Sum;
  for (std::size_t i = 0; i < kCheckpoints.size(); ++i) {
    const Checkpoint& point = r.checkpoints[i];
    const std::string after = "after_" + std::to_string(kCheckpoints[i]);
    const std::string when =
        " after " + std::to_string(kCheckpoints[i]) + " sols, or at the end of a shorter mission";
    visit(Count(after, "missions that lasted so many sols", "missions"), flag(point.lasted));
    visit(Sum(after + "_position_m", "m", "position error" + when), point.position_error_m);
    visit(truth::ValueInfo{after + "_position_error_m", "m", "the same",
                           truth::ColumnRole::kSquares, "missions"},
          point.position_error_m * point.position_error_m);
    visit(Sum(after + "_heading_deg", "deg", "absolute heading error" + when),
          point.heading_error_deg);
    visit(Sum(after + "_believed_sd_m", "m",
              "root of the summed variances of x and y that the rover believes" + when,
              after + "_judged"),
          point.position_sd_m);
    visit(Count(after + "_judged", "rovers that keep account of their error", "missions"),
          flag(point.judged));
    visit(Count(after + "_inside_95",
                "of these, the true pose lies in the region that the rover believes to hold it "
                "with 95 %",
                after + "_judged"),
          flag(point.inside_95));
    visit(Sum(after + "_goal_frame_m", "m",
              "position error in the lander's frame, in which goals are told," + when),
          point.goal_frame_error_m);
    visit(Count(after + "_goal_frame_inside_95",
                "of these, the true pose lies in that region in the lander's frame",
                after + "_judged"),
          flag(point.goal_frame_inside_95));
  }
}

// Calls visit(column, value) for every column of a mission.
template <typename Visitor>
void ForEachColumn(const MissionRecord& r, Visitor visit) {
  using mission_columns::Count;
  using mission_columns::Sum;
  const MissionCourse& c = r.course;
  const auto number = [](std::int64_t value) { return static_cast<double>(value); };
  visit(truth::ValueInfo{"missions", "1", "missions", truth::ColumnRole::kTrials}, 1.0);
  visit(truth::ValueInfo{"goals", "1", "goals of the list", truth::ColumnRole::kBase},
        number(r.goals));
  visit(truth::ValueInfo{"goals_reached", "1",
                         "the rover was truly within course.goal_radius_m when operators went on",
                         truth::ColumnRole::kMainCount, "goals"},
        number(c.goals_reached));
  visit(Count("goals_believed", "operators believed it to be", "goals"), number(c.goals_believed));
  visit(Count("wrong_beliefs", "of these, it truly was not", "goals_believed"),
        number(c.wrong_beliefs));
  visit(Count("goals_given_up", "operators went on without believing it", "goals"),
        number(c.goals_given_up));
  visit(truth::ValueInfo{"sols", "1", "sols of the missions", truth::ColumnRole::kBase},
        number(static_cast<std::int64_t>(c.sols.size())));
  for (std::size_t i = 0; i < kSolEnds; ++i) {
    visit(Count("sols_" + std::string(kSolEndNames[i]), "sols that ended so", "sols"),
          number(r.sol_ends[i]));
  }
  for (std::size_t i = 0; i < kMissionEndNames.size(); ++i) {
    visit(Count("end_" + std::string(kMissionEndNames[i]), "missions that ended so", "missions"),
          static_cast<std::size_t>(c.end) == i ? 1.0 : 0.0);
  }
  visit(Sum("distance_m", "m", "true path length"), r.distance_m);
  visit(Sum("longest_sol_m", "m", "the most of it in one sol"), r.longest_sol_m);
  ForEachCheckpointColumn(r, visit);
  visit(truth::ValueInfo{"sights", "1", "images in which the lander looked for a rover at rest",
                         truth::ColumnRole::kBase},
        number(r.sights));
  visit(Count("unseen", "of these, without it: too far, or hidden", "sights"), number(r.unseen));
  visit(Sum("spare_images", "1",
            "images of the lander that a sol's volume holds beside what a "
            "command needs"),
        number(r.spare_images));
  ForEachEnergyColumn(r.energy, visit);
  visit(Sum("battery_left_wh", "Wh", "what the batteries hold at the end"), r.battery_left_wh);
}

// Calls visit(column, value) for every column of sol `number`, from 1. `sol` is null where the
// mission did not last so long; then every value is NaN.
template <typename Visitor>
void ForEachSolColumn(std::int64_t number, const Sol* sol, Visitor visit) {
  const std::string prefix = "sol_" + std::to_string(number) + "_";
  const Sol none;
  const Sol& s = sol == nullptr ? none : *sol;
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  const auto value = [&](const std::string& name, const std::string& unit,
                         const std::string& meaning, double x) {
    visit(truth::ValueInfo{prefix + name, unit, meaning}, sol == nullptr ? kNothing : x);
  };
  const auto flag = [](bool yes) { return yes ? 1.0 : 0.0; };
  // Records hold the numbers of SolEnd and LanderSight; the meanings of "end" and "sight" must list
  // them.
  value("end", "1",
        "0 goal, 1 time, 2 energy, 3 stuck, 4 no path, 5 slip, 6 tipped, 7 no command, 8 patience",
        static_cast<double>(s.end));
  value("goal", "1", "number of its goal, from 0", static_cast<double>(s.goal));
  value("believed", "1", "operators believed the goal reached", flag(s.believed_reached));
  value("reached", "1", "it truly was", flag(s.truly_reached));
  value("distance_m", "m", "true path length", s.distance_m);
  value("drive_time_s", "s", "from the start of the drive to its end", s.drive_time_s);
  value("x_m", "m", "true place in the evening", s.truth.x_m);
  value("y_m", "m", "the same", s.truth.y_m);
  value("unaided_error_m", "m", "position error before the lander's update", s.unaided_error_m);
  value("position_error_m", "m", "and after it", s.PositionError_m());
  value("heading_error_deg", "deg", "absolute, after it", math::RadToDeg(s.HeadingError_rad()));
  value("position_sd_m", "m", "as believed after it", s.position_sd_m.value_or(kNothing));
  value("sight", "1", "of the lander: 0 no image, 1 found, 2 unseen, 3 on the way",
        static_cast<double>(s.sight));
  ForEachEnergyColumn(s.energy, [&](const truth::ValueInfo& column, double x) {
    value(column.name, column.unit, column.meaning, x);
  });
  value("battery_left_wh", "Wh", "in the evening of the night", s.battery_left_wh);
}

// Returns every column but the number of the cell and those of sols (mission.sol_columns), in the
// order of ForEachColumn.
const truth::RecordSchema& MissionColumns();

class MissionExperiment final : public CellExperiment {
 public:
  MissionExperiment(const MissionParams& params, trial::DriveParams drive);

 private:
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override;

  MissionParams params_;
  trial::DriveParams drive_;
};

}  // namespace rockyard::experiments
