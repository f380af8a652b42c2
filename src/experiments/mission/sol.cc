#include "experiments/mission/sol.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "math/angles.h"
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
    case TrialOutcome::kLeftArena:
    case TrialOutcome::kSimulatorFault:
    case TrialOutcome::kMeasured:
      break;
  }
  throw std::logic_error("a sol does not end as " + std::string(truth::Name(outcome)));
}

double Sol::PositionError_m() const {
  return std::hypot(believed.x_m - truth.x_m, believed.y_m - truth.y_m);
}

double Sol::HeadingError_rad() const {
  return std::abs(math::WrapAngle(believed.heading_rad - truth.heading_rad));
}

}  // namespace rockyard::experiments
