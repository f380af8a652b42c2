// Aids of localization in a drive, on board: when they are asked, when their data arrive, and what
// becomes of them. Onboard keeps it; Drive hands its requests to the sensors of the world
// (drive/aid_sensors.h) and their answers back. Records depend on the numbers of measurements, by
// which noise is drawn, and on the order in which moments are captured (lander, sun, beacon) and
// ready fixes are handed in (as captured).
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "localization/aid_fixes.h"
#include "localization/estimator.h"
#include "messages/aids.h"
#include "sensing/aid_params.h"

namespace rockyard::trial {

// What is to be measured now: for each aid the number of the measurement, from 0 in a trial;
// nothing where it is not due.
struct AidRequest {
  std::optional<std::int64_t> lander = {};
  std::optional<std::int64_t> sun = {};
  std::optional<std::int64_t> beacon = {};
};

// What was measured; nothing where an aid was not asked, or saw or heard nothing.
struct AidAnswer {
  std::optional<messages::PoseFix> lander = {};
  std::optional<messages::SunSighting> sun = {};
  std::optional<messages::BeaconReading> beacon = {};
};

// Numbers moments. Must stay: all aids of one drive, visual odometry as well, take numbers from one
// counter, as an estimator tells their moments apart by number.
class CaptureCounter {
 public:
  messages::CaptureNumber Next() { return next_++; }

 private:
  messages::CaptureNumber next_ = 0;
};

// When the measurements of one aid are due, by way and by time; the first is due one interval after
// the start. A measurement that comes late (a tick is longer than the interval) does not put the
// next ones off.
class AidSchedule {
 public:
  explicit AidSchedule(const sensing::AidScheduleParams& params) : params_(params) {}

  // Returns whether a measurement is due at this odometer and simulated time, neither of which
  // falls.
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

// Counts of measurements, columns of truth/drive_record.h.
struct AidCounts {
  std::int64_t used = 0;        // that corrected the estimate
  std::int64_t in_doubt = 0;    // that were used after the estimator doubted itself
  std::int64_t gated_out = 0;   // that were turned away
  std::int64_t unanswered = 0;  // that were due, and saw or heard nothing
};

// Returns the almanac of a scenario, which the rover and the simulated sun go by.
localization::SunAlmanac AlmanacOf(const sensing::SunSensorParams& sun);

// The aids of one drive. The moment of a measurement is captured as it is taken; what on-board
// software makes of the measurement is handed to the estimator `delay_s` later.
class AidSuite {
 public:
  // `captures` outlives it.
  AidSuite(const sensing::AidParams& params, CaptureCounter& captures);

  // Returns what is to be measured now; called once a control tick, after the estimator took it.
  AidRequest Due(const localization::Estimator& estimator, double time_s);
  // Takes what was measured, and hands in what is ready. Returns whether the estimate was
  // corrected.
  bool Take(const AidRequest& request, const AidAnswer& answer, double time_s,
            localization::Estimator& estimator);

  // Drops what was taken before operators moved the rover.
  void OnPlaced() { waiting_.clear(); }

  const AidCounts& counts() const { return counts_; }

 private:
  struct Waiting {
    double ready_s = 0.0;
    messages::PoseFix fix;
  };

  // Captures the moment of `fix`, or counts a measurement without one.
  void Keep(std::optional<messages::PoseFix> fix, double ready_s,
            localization::Estimator& estimator);
  bool HandIn(const messages::PoseFix& fix, localization::Estimator& estimator);

  CaptureCounter* captures_;
  sensing::AidParams params_;
  localization::SunAlmanac almanac_;
  AidSchedule lander_schedule_;
  AidSchedule sun_schedule_;
  AidSchedule beacon_schedule_;
  std::int64_t lander_number_ = 0;
  std::int64_t sun_number_ = 0;
  std::int64_t beacon_number_ = 0;
  std::vector<Waiting> waiting_;  // in the order of their captures
  AidCounts counts_;
};

}  // namespace rockyard::trial
