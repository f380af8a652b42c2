// When an aid measures next.
#pragma once

#include <cmath>
#include <cstdint>

#include "sensing/aid_params.h"

namespace rockyard::trial {

// Counts measurements by way and by time; the first is due one interval after the start. One that
// comes late (a tick is longer than the interval) does not put the next ones off.
class AidSchedule {
 public:
  explicit AidSchedule(const sensing::AidScheduleParams& params) : params_(params) {}

  // Whether a measurement is due at this odometer and simulated time, neither of which falls.
  bool IsDue(double way_m, double time_s) {
    if (!params_.enabled) return false;
    const bool by_way = Passes(way_m, params_.every_m, ways_);
    const bool by_time = Passes(time_s, params_.every_s, times_);
    return by_way || by_time;
  }

 private:
  static bool Passes(double value, double every, double& passed) {
    if (every <= 0.0) return false;
    const double whole = std::floor(value / every);
    if (whole <= passed) return false;
    passed = whole;
    return true;
  }

  sensing::AidScheduleParams params_;
  double ways_ = 0.0;   // whole intervals of way so far
  double times_ = 0.0;  // and of time
};

}  // namespace rockyard::trial
