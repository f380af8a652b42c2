// What one sol of a mission leaves behind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "experiments/mission/sol_energy.h"
#include "math/pose.h"
#include "truth/record.h"

namespace rockyard::experiments {

// What ended the drive of a sol.
enum class SolEnd {
  kGoal,       // the rover declared to be at its goal, truly or not
  kTime,       // the window closed
  kEnergy,     // batteries empty, and the sun did not suffice
  kStuck,      // jammed or high-centred
  kNoPath,     // the navigator gave up, or its operator's patience was at an end
  kSlip,       // stopped, as its wheels were seen to slip
  kTipped,     // fell over
  kNoCommand,  // there was no drive: the command had not come
};
inline constexpr std::size_t kSolEnds = 8;
inline constexpr std::array<std::string_view, kSolEnds> kSolEndNames{
    "goal", "time", "energy", "stuck", "no_path", "slip", "tipped", "no_command"};

// Throws std::logic_error for outcomes that drives of a mission do not have.
SolEnd SolEndOf(truth::TrialOutcome outcome);

// What became of the lander's image of the day.
enum class LanderSight {
  kNotTaken,
  kFound,
  kUnseen,    // too far, or hidden
  kOnTheWay,  // taken while it drove: one of the aids of that drive
};

struct Sol {
  SolEnd end = SolEnd::kNoCommand;
  std::int64_t goal = 0;                // number of the goal that it was about, from 0
  double distance_m = 0.0;              // true path
  double drive_time_s = 0.0;            // from the start of the drive to its end
  math::Pose2 truth;                    // in the evening
  math::Pose2 believed;                 // then, after the lander's update
  double unaided_error_m = 0.0;         // of the believed position before that update
  std::optional<double> position_sd_m;  // as believed then; empty without an account of errors
  std::optional<bool> inside_95;        // whether its 95 % region of x, y, heading holds the truth
  LanderSight sight = LanderSight::kNotTaken;
  bool believed_reached = false;  // the goal, by operators
  bool truly_reached = false;
  SolEnergy energy;
  double battery_left_wh = 0.0;

  double PositionError_m() const;
  double HeadingError_rad() const;  // absolute
};

}  // namespace rockyard::experiments
