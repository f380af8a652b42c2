#include "experiments/mission/sol.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "math/angles.h"

namespace rockyard::experiments {

SolEnd SolEndOf(truth::TrialOutcome outcome) {
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
      return SolEnd::kNoPath;
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
