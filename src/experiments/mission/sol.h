// What one sol of a mission leaves behind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/random.h"
#include "experiments/mission/mission_params.h"
#include "math/pose.h"
#include "trial/clock/power.h"
#include "trial/run_trial.h"
#include "truth/end_cause.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Wh. Sources and sinks add up to the same.
struct SolEnergy {
  // Sinks.
  std::array<double, trial::kActivityCount> drive_wh{};  // by activity of the drive
  double idle_wh = 0.0;
  double transmit_wh = 0.0;  // modem and the rover that is awake meanwhile
  double sleep_wh = 0.0;
  // Sources.
  double sun_wh = 0.0;
  double battery_wh = 0.0;
  double overdrawn_wh = 0.0;  // that a drive took from batteries which had just become empty

  double sun_available_wh = 0.0;  // what the cells could have given

  double Drive() const;
  double Sinks() const { return Drive() + idle_wh + transmit_wh + sleep_wh; }
  double Sources() const { return sun_wh + battery_wh + overdrawn_wh; }

  SolEnergy& operator+=(const SolEnergy& other);
};

// Keeps the books of one sol, whose time 0 is the opening of its window.
class SolBooks {
 public:
  // `battery_wh`: what the batteries hold at the beginning.
  SolBooks(const trial::SolarSupply& sun, double battery_wh);

  // A drive, by its own ledger, which knew the same sun and batteries.
  void AddDrive(const trial::DriveEnd& drive);
  // A steady load from begin_s to end_s, added to `sink`. With empty batteries it takes what the
  // sun gives of it: what is off then, is off.
  void AddLoad(double load_W, double begin_s, double end_s, double& sink_wh);

  SolEnergy& energy() { return energy_; }
  double battery_wh() const { return battery_wh_; }

 private:
  trial::SolarSupply sun_;
  double battery_wh_;
  SolEnergy energy_;
};

// What ended the drive of a sol. Records hold its number and, in columns, its name: append only.
enum class SolEnd {
  kGoal,       // the rover declared to be at its goal, truly or not
  kTime,       // the window closed
  kEnergy,     // batteries empty, and the sun did not suffice
  kStuck,      // jammed or high-centred
  kNoPath,     // the navigator gave up
  kSlip,       // stopped, as its wheels were seen to slip
  kTipped,     // fell over
  kNoCommand,  // there was no drive: the command had not come
  kPatience,   // the operator's was at an end, as it came no nearer
};
inline constexpr std::size_t kSolEnds = 9;
inline constexpr std::array<std::string_view, kSolEnds> kSolEndNames{
    "goal", "time", "energy", "stuck", "no_path", "slip", "tipped", "no_command", "patience"};

// Throws std::logic_error for outcomes that drives of a mission do not have.
SolEnd SolEndOf(truth::TrialOutcome outcome, std::optional<truth::EndCause> cause);

// What became of the lander's image of the day. Records hold its number: append only.
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
  math::Pose2 believed;                 // then, after the lander's update, in W as far as it knows
  double unaided_error_m = 0.0;         // of the believed position before that update
  std::optional<double> position_sd_m;  // as believed then; empty without an account of errors
  std::optional<bool> inside_95;        // whether its 95 % region of x, y, heading holds the truth
  // The same in the lander's frame, in which goals are told.
  double goal_frame_error_m = 0.0;
  std::optional<bool> goal_frame_inside_95;
  LanderSight sight = LanderSight::kNotTaken;
  bool believed_reached = false;  // the goal, by operators
  bool truly_reached = false;
  SolEnergy energy;
  double battery_left_wh = 0.0;

  double PositionError_m() const;
  double HeadingError_rad() const;  // absolute
};

// The key of a sol, from 0: trial number mission * kMostSols + sol of the same seed, so that no two
// sols share a stream. What lasts a mission (rocks, ground, pan error, what the lander's fixes have
// in common) is drawn by the key of the mission itself, with purposes that no sol draws by its own.
// Missions of one seed and number meet the same noise sol by sol, whatever aids they have.
inline core::TrialKey SolKey(core::TrialKey mission, std::int64_t sol) {
  return {mission.seed, mission.trial * kMostSols + static_cast<std::uint32_t>(sol)};
}

// How often operators can command the rover: what a command needs, against what a sol can carry.

// Bits that a command needs from the lander: its own images, compressed, and what the rover sent.
double NeededBits(const MissionDayParams& day);

// What the lander sends in a sol: rate times hours.
double SolBits(const MissionDayParams& day);

// Images of the lander that fit into a sol beside what a command needs, whole ones.
std::int64_t SpareImages(const MissionDayParams& day);

// Sols from one command to the next, 1 at least: as many as the bits take, and as many as pass
// until images have come (downlink_h at most, and the light time), operators have planned, and the
// command has gone up before the next window opens.
std::int64_t SolsPerCommand(const MissionDayParams& day);

}  // namespace rockyard::experiments
