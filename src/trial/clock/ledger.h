// The simulated clock and the batteries: what every activity takes. The one clock of a trial: what
// times, rates and energies of its record are made of.
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

class Ledger {
 public:
  // Batteries of 0 Wh are never empty, unless there is a sun, which supplies what it can before
  // them: then they are empty as soon as it does not suffice.
  Ledger(const PowerBudget& budget, double battery_wh,
         const std::optional<SolarSupply>& sun = std::nullopt)
      : budget_(budget), battery_wh_(battery_wh), sun_(sun) {}

  void Spend(Activity activity, double duration_s);
  // What goes on beside that: its own power, no time of the clock.
  void SpendBeside(Activity activity, double duration_s);

  // Closed form of a stall that nobody ends: what is left in the batteries, at stall power. Spends
  // nothing. Zero where the batteries are never empty.
  Stall StallUntilEmpty() const;

  double time_s() const { return time_s_; }
  // Alone and beside others: where some went on at once, all together are more than time_s().
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
  // Of energy_wh(), what came from the batteries.
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
  double shortfall_J_ = 0.0;  // beyond the sun
  std::array<double, kActivityCount> by_activity_s_{};
  std::array<double, kActivityCount> beside_by_activity_s_{};
};

}  // namespace rockyard::trial
