#include "trial/clock/ledger.h"

#include <algorithm>

#include "core/check.h"

namespace rockyard::trial {

void Ledger::Spend(Activity activity, double duration_s) {
  EXPECT(duration_s >= 0.0);
  if (sun_) {
    shortfall_J_ += sun_->Shortfall_J(budget_.Power(activity), time_s_, time_s_ + duration_s);
  }
  time_s_ += duration_s;
  by_activity_s_[static_cast<std::size_t>(activity)] += duration_s;
  energy_J_ += budget_.Power(activity) * duration_s;
}

void Ledger::SpendBeside(Activity activity, double duration_s) {
  EXPECT(duration_s >= 0.0);
  // What the sun gives to one activity it cannot give to another one beside it.
  EXPECT(!sun_ || budget_.PowerBeside(activity) * duration_s == 0.0);
  beside_by_activity_s_[static_cast<std::size_t>(activity)] += duration_s;
  energy_J_ += budget_.PowerBeside(activity) * duration_s;
}

Stall Ledger::StallUntilEmpty() const {
  // A sun is left out: missions, which have one, refuse stuck rovers that run on.
  const double rest_J = std::max(0.0, battery_wh_ * kJoulesPerWattHour - energy_J_);
  return {rest_J / budget_.Power(Activity::kStalled), rest_J / kJoulesPerWattHour};
}

}  // namespace rockyard::trial
