#include "experiments/mission/sol.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "math/angles.h"
#include "math/functions.h"
#include "math/sun_position.h"

namespace rockyard::experiments {
namespace {

constexpr double kJoulesPerWattHour = 3600.0;

}  // namespace

double SolEnergy::Drive() const { return std::accumulate(drive_wh.begin(), drive_wh.end(), 0.0); }

SolEnergy& SolEnergy::operator+=(const SolEnergy& other) {
  for (std::size_t i = 0; i < drive_wh.size(); ++i) drive_wh[i] += other.drive_wh[i];
  idle_wh += other.idle_wh;
  transmit_wh += other.transmit_wh;
  sleep_wh += other.sleep_wh;
  sun_wh += other.sun_wh;
  battery_wh += other.battery_wh;
  overdrawn_wh += other.overdrawn_wh;
  sun_available_wh += other.sun_available_wh;
  return *this;
}

SolBooks::SolBooks(const trial::SolarSupply& sun, double battery_wh)
    : sun_(sun), battery_wh_(battery_wh) {
  energy_.sun_available_wh = sun_.Energy_J(0.0, math::kSolOfMars_s) / kJoulesPerWattHour;
}

void SolBooks::AddDrive(const trial::DriveEnd& drive) {
  double drawn_wh = 0.0;
  for (std::size_t i = 0; i < drive.energy_wh.size(); ++i) {
    energy_.drive_wh[i] += drive.energy_wh[i];
    drawn_wh += drive.energy_wh[i];
  }
  const double from_battery_wh = std::min(drive.battery_wh, battery_wh_);
  energy_.sun_wh += drawn_wh - drive.battery_wh;
  energy_.battery_wh += from_battery_wh;
  energy_.overdrawn_wh += drive.battery_wh - from_battery_wh;
  battery_wh_ -= from_battery_wh;
}

void SolBooks::AddLoad(double load_W, double begin_s, double end_s, double& sink_wh) {
  const double sun_wh = sun_.Used_J(load_W, begin_s, end_s) / kJoulesPerWattHour;
  const double short_wh = sun_.Shortfall_J(load_W, begin_s, end_s) / kJoulesPerWattHour;
  const double from_battery_wh = std::min(short_wh, battery_wh_);
  energy_.sun_wh += sun_wh;
  energy_.battery_wh += from_battery_wh;
  battery_wh_ -= from_battery_wh;
  sink_wh += sun_wh + from_battery_wh;
}

SolEnd SolEndOf(truth::TrialOutcome outcome, std::optional<truth::EndCause> cause) {
  using truth::TrialOutcome;
  switch (outcome) {
    case TrialOutcome::kGoalReached:
    case TrialOutcome::kFalseGoal:
      return SolEnd::kGoal;
    case TrialOutcome::kTipOver:
      return SolEnd::kTipped;
    case TrialOutcome::kHighCentred:
    case TrialOutcome::kJammed:
      return SolEnd::kStuck;
    case TrialOutcome::kNoPath:
      return cause && truth::IsLimit(*cause) ? SolEnd::kPatience : SolEnd::kNoPath;
    case TrialOutcome::kEnergyDepleted:
      return SolEnd::kEnergy;
    case TrialOutcome::kTimeLimit:
      return SolEnd::kTime;
    case TrialOutcome::kExcessiveSlip:
      return SolEnd::kSlip;
    // No drive of a mission has these: its arena is open, and a fault of the simulation is thrown.
    case TrialOutcome::kLeftArena:
    case TrialOutcome::kNavigatorFault:
    case TrialOutcome::kSimulatorFault:
    case TrialOutcome::kMeasured:
      break;
  }
  throw std::logic_error("a sol does not end as " + std::string(truth::Name(outcome)));
}

double Sol::PositionError_m() const {
  return math::Hypot(believed.x_m - truth.x_m, believed.y_m - truth.y_m);
}

double Sol::HeadingError_rad() const {
  return std::abs(math::WrapAngle(believed.heading_rad - truth.heading_rad));
}

namespace {

constexpr double kSecondsPerHour = 3600.0;
constexpr double kSecondsPerMinute = 60.0;

}  // namespace

double NeededBits(const MissionDayParams& day) {
  return day.RoverBits() +
         static_cast<double>(day.lander_images) * day.lander_image_bits / day.compression;
}

double SolBits(const MissionDayParams& day) {
  return day.downlink_bit_s * day.downlink_h * kSecondsPerHour;
}

std::int64_t SpareImages(const MissionDayParams& day) {
  const double spare = SolBits(day) - NeededBits(day);
  if (spare <= 0.0 || day.lander_image_bits <= 0.0) return 0;
  return static_cast<std::int64_t>(spare * day.compression / day.lander_image_bits);
}

std::int64_t SolsPerCommand(const MissionDayParams& day) {
  const double needed = NeededBits(day);
  const double sols_of_bits = std::ceil(needed / SolBits(day));
  // The last session carries the bits that are left.
  const double last_s =
      (needed - std::max(0.0, sols_of_bits - 1.0) * SolBits(day)) / day.downlink_bit_s;
  const double answer_s = last_s + 2.0 * day.latency_min * kSecondsPerMinute +
                          day.planning_h * kSecondsPerHour + day.Window_s();
  const double sols = std::max(0.0, sols_of_bits - 1.0) + std::ceil(answer_s / math::kSolOfMars_s);
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(sols));
}

}  // namespace rockyard::experiments
