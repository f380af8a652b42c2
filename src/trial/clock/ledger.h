// The simulated clock and the batteries: what every activity takes. Drive spends on it, the referee
// reads it. It is the one clock of a trial: times, rates and energies of the record come from it,
// and they depend on its sums stretch by stretch: two stretches spent as one have other last bits.
#pragma once

#include <array>
#include <optional>

#include "trial/clock/power.h"

namespace rockyard::trial {

// What a rover that spins its wheels in vain still takes.
struct Stall {
  double time_s = 0.0;
  double energy_wh = 0.0;
};

// The ledger of one trial.
class Ledger {
 public:
  // A sun supplies what it can before the batteries. Batteries of 0 Wh are never empty without a
  // sun; with one they are empty as soon as the sun does not suffice.
  Ledger(const PowerBudget& budget, double battery_wh,
         const std::optional<SolarSupply>& sun = std::nullopt)
      : budget_(budget), battery_wh_(battery_wh), sun_(sun) {}

  // Spends time of the clock on an activity.
  void Spend(Activity activity, double duration_s);
  // Spends the power of an activity that goes on beside another one, and no time of the clock.
  void SpendBeside(Activity activity, double duration_s);

  // Returns what a stall takes that nobody ends, in closed form: what is left in the batteries, at
  // stall power; zero where the batteries are never empty. Spends nothing.
  Stall StallUntilEmpty() const;

  double time_s() const { return time_s_; }
  // Returns the time of an activity, alone and beside others; where some went on at once, all
  // activities together are more than time_s().
  double time_s(Activity activity) const { return time_alone_s(activity) + beside_s(activity); }
  double time_alone_s(Activity activity) const {
    return by_activity_s_[static_cast<std::size_t>(activity)];
  }
  double energy_wh() const { return energy_J_ / kJoulesPerWattHour; }
  double energy_wh(Activity activity) const {
    return (budget_.Power(activity) * time_alone_s(activity) +
            budget_.PowerBeside(activity) * beside_s(activity)) /
           kJoulesPerWattHour;
  }
  // Returns the part of energy_wh() that came from the batteries.
  double battery_drawn_wh() const { return (sun_ ? shortfall_J_ : energy_J_) / kJoulesPerWattHour; }
  bool empty() const {
    if (sun_) return battery_drawn_wh() > battery_wh_;
    return has_end() && energy_wh() >= battery_wh_;
  }

 private:
  static constexpr double kJoulesPerWattHour = 3600.0;

  double beside_s(Activity activity) const {
    return beside_by_activity_s_[static_cast<std::size_t>(activity)];
  }
  bool has_end() const { return battery_wh_ > 0.0; }

  PowerBudget budget_;
  double battery_wh_;
  std::optional<SolarSupply> sun_;
  double time_s_ = 0.0;
  double energy_J_ = 0.0;
  double shortfall_J_ = 0.0;  // what the sun did not supply
  std::array<double, kActivityCount> by_activity_s_{};
  std::array<double, kActivityCount> beside_by_activity_s_{};
};

}  // namespace rockyard::trial
