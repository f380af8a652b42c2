#include "trial/ledger.h"

#include <algorithm>

#include "core/check.h"

namespace rockyard::trial {

double Ledger::Power(Activity activity) const {
  const double base = params_.cpu_W + params_.gyro_W;
  switch (activity) {
    case Activity::kDriving:
    case Activity::kTurning:
    case Activity::kStalled:
      return base + params_.driving_W;
    case Activity::kSteering:
      return base + params_.steering_W;
    case Activity::kScanning:
      return params_.hazard_detection_W;
  }
  return base;
}

void Ledger::Spend(Activity activity, double duration_s) {
  EXPECT(duration_s >= 0.0);
  time_s_ += duration_s;
  by_activity_s_[static_cast<std::size_t>(activity)] += duration_s;
  energy_J_ += Power(activity) * duration_s;
}

void Ledger::SpendRestStalled() {
  const double rest_J = params_.battery_wh * kJoulesPerWattHour - energy_J_;
  Spend(Activity::kStalled, std::max(0.0, rest_J) / Power(Activity::kStalled));
}

}  // namespace rockyard::trial
