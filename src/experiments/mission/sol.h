// What one sol of a mission leaves behind, its energy and its random key; and how often operators
// can command the rover. The mission fills it in, its experiment makes columns of it, and doubts of
// scenarios ask how many sols a command takes.
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

// The energy of a sol, Wh. Sources and sinks add up to the same.
struct SolEnergy {
  // Sinks.
  std::array<double, trial::kActivityCount> drive_wh{};  // by activity of the drive
  double idle_wh = 0.0;
  double transmit_wh = 0.0;  // modem, and the rover that is awake while it sends
  double sleep_wh = 0.0;
  // Sources.
  double sun_wh = 0.0;
  double battery_wh = 0.0;
  double overdrawn_wh = 0.0;  // what a drive took as batteries became empty

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

  // Books a drive, by its own ledger, which knew the same sun and batteries.
  void AddDrive(const trial::DriveEnd& drive);
  // Books a steady load from begin_s to end_s, added to `sink`. With empty batteries it takes what
  // the sun gives of it; a load that nothing supplies is off.
  void AddLoad(double load_W, double begin_s, double end_s, double& sink_wh);

  SolEnergy& energy() { return energy_; }
  double battery_wh() const { return battery_wh_; }

 private:
  trial::SolarSupply sun_;
  double battery_wh_;
  SolEnergy energy_;
};

// What ended the drive of a sol. Records hold its number, and names of columns its name
// (kSolEndNames): append only.
enum class SolEnd {
  kGoal,       // the rover declared to be at its goal, truly or not
  kTime,       // the window closed
  kEnergy,     // batteries were empty, and the sun did not suffice
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

// Returns what ended the sol. Throws std::logic_error for outcomes that drives of a mission do not
// have.
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
  std::int64_t goal = 0;         // number of the sol's goal, from 0
  double distance_m = 0.0;       // true path
  double drive_time_s = 0.0;     // from the start of the drive to its end
  math::Pose2 truth;             // in the evening
  math::Pose2 believed;          // in the evening, after the lander's update, in W
  double unaided_error_m = 0.0;  // of the believed position before the lander's update
  // As believed in the evening; both are empty where the rover keeps no account of its error.
  std::optional<double> position_sd_m;
  std::optional<bool> inside_95;  // the believed 95 % region of x, y, heading holds the truth
  // The error and inside_95 in the lander's frame, in which goals are told.
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

// Returns the key of a sol, from 0. Must stay: trial number mission * kMostSols + sol of the same
// seed, so that no two sols share a stream, and every record depends on it. What lasts a mission
// (rocks, ground, pan error, what the lander's fixes have in common) is drawn by the key of the
// mission itself, with purposes that no sol draws by its own. Missions of one seed and number meet
// the same noise sol by sol, whatever aids they have.
inline core::TrialKey SolKey(core::TrialKey mission, std::int64_t sol) {
  return {mission.seed, mission.trial * kMostSols + static_cast<std::uint32_t>(sol)};
}

// Returns the bits that a command needs from the lander: its own images, compressed, and what the
// rover sent.
double NeededBits(const MissionDayParams& day);

// Returns the bits that the lander sends in a sol: rate times hours.
double SolBits(const MissionDayParams& day);

// Returns how many whole images of the lander fit into a sol beside what a command needs.
std::int64_t SpareImages(const MissionDayParams& day);

// Returns the sols from one command to the next, 1 at least: as many as the bits take, and as many
// as pass until images have come (downlink_h at most, and the light time), operators have planned,
// and the command has gone up before the next window opens.
std::int64_t SolsPerCommand(const MissionDayParams& day);

}  // namespace rockyard::experiments
