// The simulated clock and the batteries: what every activity takes.
#pragma once

#include <array>

#include "trial/clock_params.h"
#include "trial/energy_params.h"

namespace rockyard::trial {

// One major function at a time (Matthies 1995 sec. 2.1.2).
enum class Activity { kDriving, kTurning, kSteering, kScanning, kStalled };
inline constexpr std::size_t kActivityCount = 5;

class Ledger {
 public:
  explicit Ledger(const EnergyParams& params) : params_(params) {}

  // Electrical power of an activity, W: computer and gyro plus the function itself. Hazard
  // detection is published as a sum that includes them.
  double Power(Activity activity) const;

  void Spend(Activity activity, double duration_s);

  // Closed form of a stall that nobody ends: spends what is left in the batteries at stall power.
  void SpendRestStalled();

  double time_s() const { return time_s_; }
  double time_s(Activity activity) const {
    return by_activity_s_[static_cast<std::size_t>(activity)];
  }
  double energy_wh() const { return energy_J_ / kJoulesPerWattHour; }
  bool empty() const { return energy_wh() >= params_.battery_wh; }

 private:
  static constexpr double kJoulesPerWattHour = 3600.0;

  EnergyParams params_;
  double time_s_ = 0.0;
  double energy_J_ = 0.0;
  std::array<double, kActivityCount> by_activity_s_{};
};

}  // namespace rockyard::trial
