// How far the steering motors turned.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/check.h"
#include "messages/wheels.h"

namespace rockyard::trial {

// The total turning of each steering motor, to and fro alike:
//   sum over ticks of |angle - angle before|,
// in truth. Within a tick the motors go one way, so that nothing of their turning is missed. Howard
// 2012, section 3, compares navigators by its mean over the motors ("average aggregate displacement
// of a single steering motor").
class SteerCounter {
 public:
  // At least one wheel is steered.
  explicit SteerCounter(const messages::PerWheel<bool>& steered) : steered_(steered) {
    EXPECT(std::count(steered.begin(), steered.end(), true) > 0);
  }

  // Starts, or starts again with wheels that were turned by hand: that turning does not count.
  void Restart(const messages::PerWheel<double>& steer_rad) { last_rad_ = steer_rad; }

  // Once a control tick, with the true angles.
  void Observe(const messages::PerWheel<double>& steer_rad) {
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      if (steered_[i]) turned_rad_[i] += std::abs(steer_rad[i] - last_rad_[i]);
    }
    last_rad_ = steer_rad;
  }

  // Mean over the steered wheels.
  double mean_rad() const {
    double sum_rad = 0.0;
    for (const double turned_rad : turned_rad_) sum_rad += turned_rad;
    return sum_rad / static_cast<double>(std::count(steered_.begin(), steered_.end(), true));
  }

  // Of the motor that turned most.
  double max_rad() const { return *std::max_element(turned_rad_.begin(), turned_rad_.end()); }

 private:
  messages::PerWheel<bool> steered_;
  messages::PerWheel<double> last_rad_{};
  messages::PerWheel<double> turned_rad_{};  // 0 of wheels that are not steered
};

}  // namespace rockyard::trial
