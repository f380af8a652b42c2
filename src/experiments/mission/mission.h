// One mission: sol after sol a command, a drive, an evening and a night. The experiment "mission"
// runs one for each record.
//
// The rover stays in one rock field. On each morning it stands where it stood in the evening
// before, and believes what it believed then (trial/run_trial.h). Operators designate the next goal
// in the lander's images with the errors of Matthies 1995, section 4. In the evening the lander
// finds the rover in its images, where the mission has that aid and the lander sees the rover.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "experiments/mission/mission_params.h"
#include "experiments/mission/sol.h"
#include "localization/estimator.h"
#include "sensing/aids.h"
#include "terrain/field.h"
#include "trial/clock/power.h"
#include "trial/drive_params.h"
#include "trial/run_trial.h"

namespace rockyard::experiments {

// Why a mission ended. Must stay: the names, as each is a column of the records, called "end_" and
// its name; stored runs hold them.
enum class MissionEnd {
  kSolsDone,
  kGoalsDone,  // operators believe to have been at every goal, or have given it up
  kNoPower,    // batteries empty, and no sun that carries a drive
  kTipped,
  kStuck,      // for stuck_sols in a row
  kLost,       // beyond the radio's range
  kLeftField,  // beyond the rocks that the simulation laid out
};
inline constexpr std::array<std::string_view, 7> kMissionEndNames{
    "sols_done", "goals_done", "no_power", "tipped", "stuck", "lost", "left_field"};

struct MissionCourse {
  MissionEnd end = MissionEnd::kSolsDone;
  std::vector<Sol> sols;
  std::int64_t goals_given_up = 0;
  std::int64_t goals_reached = 0;   // truly, where operators went on to the next
  std::int64_t goals_believed = 0;  // where operators believed it
  std::int64_t wrong_beliefs = 0;   // of goals_believed, not truly
};

class Mission {
 public:
  // The mission is a pure function of these. `params` and `drive` outlive it.
  Mission(const MissionParams& params, const trial::DriveParams& drive, core::TrialKey key);

  MissionCourse Run();

 private:
  // The hours of one sol's drive.
  struct Window {
    double begin_s = 0.0;  // after the opening of window_h
    double length_s = 0.0;
  };

  // Returns the sun of a sol, from start_s after the opening of its window on.
  trial::SolarSupply SunFrom(std::int64_t sol, double start_s) const;
  // Returns the hours of a sol's drive; none where the rover has no power for one.
  std::optional<Window> WindowOf(std::int64_t sol) const;
  // Returns the scenario of a drive to the present goal within the window.
  trial::DriveParams DriveOf(const Window& window) const;
  // Drives, if a command has come, and books the sol's energy. `told` becomes the goal as it was
  // designated, where there was a command.
  Sol RunSol(std::int64_t number, const Window& window, messages::Goal& told);
  trial::DriveEnd DriveOn(std::int64_t number, const Window& window, Sol& sol,
                          messages::Goal& told);
  // Takes the lander's image of the day, of a rover that stands at X_WR, and tells the rover what
  // it shows.
  LanderSight UpdateByLander(std::int64_t number, const math::Transform& X_WR);
  // Changes the rover's memory by a fix: an estimator that weighs fixes weighs it, another one is
  // told the place.
  void Believe(const messages::PoseFix& fix);
  // Returns the estimator that goes on by what is remembered.
  std::unique_ptr<localization::Estimator> Awake() const;
  math::Pose2 BelievedInWorld() const;
  void TellBelief(Sol& sol) const;
  // Judges whether operators hold the goal for reached, and whether they go on to the next one.
  void JudgeGoal(const messages::Goal& told, Sol& sol, MissionCourse& course);
  // Returns why the mission ends after this sol; nothing where it goes on.
  std::optional<MissionEnd> EndAfter(const Sol& sol);

  // In this order: the field keeps clear of goals_, and the lander may share pan_error_rad_.
  const MissionParams& params_;
  const trial::DriveParams& drive_;
  core::TrialKey key_;
  std::vector<messages::Goal> goals_;
  terrain::Field field_;
  double pan_error_rad_;
  sensing::LanderFix lander_;

  math::Pose2 truth_;
  localization::EstimatorMemory memory_;
  double battery_wh_;
  std::size_t goal_ = 0;
  std::int64_t attempts_ = 0;    // at goal_
  std::int64_t stuck_sols_ = 0;  // in a row
};

}  // namespace rockyard::experiments
