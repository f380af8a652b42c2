// Why a drive ended: what its outcome alone leaves open. The referee gives a cause; reports, tables
// of causes and missions find it again from a record.
//
// Must stay: the sentences, to the letter. A record keeps no cause but its sentence (`detail`), by
// which CauseOf finds the cause; with another sentence all stored runs would lose theirs. Hashes of
// records leave the sentence out.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "truth/record.h"

namespace rockyard::truth {

// Append only, at the same place as in kEndCauses.
enum class EndCause {
  kArrived,
  kBelievedOnly,
  kFellOver,
  kBellyOnRock,
  kNoMotion,
  kSankIn,
  kGaveUp,            // by the navigator
  kNoticedStuck,      // by the navigator, from what the rover measures
  kPatienceDistance,  // by the operator: driven so far without coming nearer to the goal
  kPatienceTurning,   // by the operator: turned so much without coming nearer
  kPatienceTime,      // by the operator: so long without coming nearer
  kBatteriesEmpty,
  kTimeLimit,
  kLeftArena,
  kFoundRock,
  kRockNotFound,
  kExcessiveSlip,
  // Of a plugin or a process that decides; IsNavigatorFault.
  kNavigatorThrew,
  kNavigatorNonsense,
  kNavigatorMessage,
  kNavigatorEnded,
  kNavigatorCrashed,
  kNavigatorCpuTime,
  kNavigatorMemory,
  kNavigatorSilent,
};

// What files, tables and records say of a cause.
struct EndCauseInfo {
  std::string_view name;  // in files; must stay
  TrialOutcome outcome;
  std::string_view label;     // a few words for a table, below the outcome
  std::string_view sentence;  // the `detail` of a record: a sentence without its subject, the rover
  std::string_view setting;   // path of the parameter that decided; empty where none did
};

// The causes in the order of EndCause. No two of one outcome have the same sentence.
inline constexpr std::array<EndCauseInfo, 25> kEndCauses = {{
    {"arrived", TrialOutcome::kGoalReached, "arrived", "arrived at the goal",
     "course.goal_radius_m"},
    {"believed_only", TrialOutcome::kFalseGoal, "believed only",
     "believed to have arrived, but was not at the goal", "course.goal_radius_m"},
    {"fell_over", TrialOutcome::kTipOver, "fell over", "tilted until it fell over",
     "referee.tip_over_deg"},
    {"belly_on_rock", TrialOutcome::kHighCentred, "belly on a rock",
     "hung with its belly on a rock and moved no further", "referee.stall_window_s"},
    {"no_motion", TrialOutcome::kJammed, "wheels turned in vain",
     "moved no further although its wheels were told to turn", "referee.stall_window_s"},
    {"sank_in", TrialOutcome::kJammed, "sank into the soil",
     "sank into the soil beyond the axles of its wheels", ""},
    {"gave_up", TrialOutcome::kNoPath, "navigator gave up", "found no way on and gave up", ""},
    {"noticed_stuck", TrialOutcome::kNoPath, "noticed it was stuck",
     "noticed that it was stuck, and gave up", ""},
    {"patience_distance", TrialOutcome::kNoPath, "patience: distance",
     "drove on without coming nearer to the goal until its operator ended the run",
     "referee.no_path_distance_m"},
    {"patience_turning", TrialOutcome::kNoPath, "patience: turning",
     "turned in place without coming nearer to the goal until its operator ended the run",
     "referee.no_path_turn_deg"},
    {"patience_time", TrialOutcome::kNoPath, "patience: time",
     "came no nearer to the goal for so long that its operator ended the run",
     "referee.no_path_time_s"},
    {"batteries_empty", TrialOutcome::kEnergyDepleted, "batteries empty",
     "had emptied its batteries before it arrived", "energy.battery_wh"},
    {"time_limit", TrialOutcome::kTimeLimit, "time was over",
     "had not arrived when the time of the run was over", "referee.time_limit_s"},
    {"left_arena", TrialOutcome::kLeftArena, "left the arena", "drove past an end of the arena",
     "terrain.arena"},
    {"found_rock", TrialOutcome::kGoalReached, "found the rock", "found the rock at its goal",
     "course.goal_rock.enabled"},
    {"rock_not_found", TrialOutcome::kFalseGoal, "found no rock",
     "believed to have arrived, but had not found the rock at its goal",
     "course.goal_rock.enabled"},
    {"excessive_slip", TrialOutcome::kExcessiveSlip, "slipped too much",
     "stopped because its wheels slipped more than it should stand",
     "perception.visual_odometry.slip_check.limit"},
    {"navigator_threw", TrialOutcome::kNavigatorFault, "navigator failed",
     "stopped because its navigator reported an error", ""},
    {"navigator_nonsense", TrialOutcome::kNavigatorFault, "nonsense decided",
     "stopped because its navigator decided what cannot be done", ""},
    {"navigator_message", TrialOutcome::kNavigatorFault, "wrong message",
     "stopped because its navigator answered with no right message", ""},
    {"navigator_ended", TrialOutcome::kNavigatorFault, "navigator ended",
     "stopped because the process of its navigator ended", ""},
    {"navigator_crashed", TrialOutcome::kNavigatorFault, "navigator crashed",
     "stopped because its navigator crashed the process that ran it", ""},
    {"navigator_cpu_time", TrialOutcome::kNavigatorFault, "navigator too slow",
     "stopped because its navigator used more CPU time than it may",
     "navigation.limits.decision_cpu_s"},
    {"navigator_memory", TrialOutcome::kNavigatorFault, "navigator too large",
     "stopped because its navigator used more memory than it may", "navigation.limits.memory_mb"},
    {"navigator_silent", TrialOutcome::kNavigatorFault, "no answer",
     "stopped because its navigator gave no answer", "navigation.limits.answer_s"},
}};

constexpr const EndCauseInfo& Info(EndCause cause) {
  return kEndCauses[static_cast<std::size_t>(cause)];
}

// Return whether a limit of the run ended the drive: the operator's patience or the time. Such a
// rover had neither arrived nor failed, and what it would have come to is not known.
constexpr bool IsLimit(EndCause cause) {
  return cause == EndCause::kPatienceDistance || cause == EndCause::kPatienceTurning ||
         cause == EndCause::kPatienceTime || cause == EndCause::kTimeLimit;
}
bool EndedByLimit(const Record& record);

// Return the cause that has this outcome and this sentence; nothing for a measurement, for a fault
// of the simulator, and for a sentence of another version. The sentence of a navigator's fault is
// followed by ": " and what the navigator said.
std::optional<EndCause> CauseOf(TrialOutcome outcome, std::string_view detail);
inline std::optional<EndCause> CauseOf(const Record& record) {
  return CauseOf(record.outcome, record.detail);
}
// Returns the name of a record's cause; "" where CauseOf finds none.
std::string_view CauseName(const Record& record);

// Returns whether an outcome has more than one cause, so that its count leaves open which.
bool HasSeveralCauses(TrialOutcome outcome);

}  // namespace rockyard::truth
