// Aids of localization in a drive: when they are asked, when they answer, what became of it.
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

// Each by the number of its measurement, from 0 in a trial; none where it is not due.
struct AidRequest {
  std::optional<std::int64_t> lander = {};
  std::optional<std::int64_t> sun = {};
  std::optional<std::int64_t> beacon = {};
};

// None where an aid was not asked, and where it saw or heard nothing.
struct AidAnswer {
  std::optional<messages::PoseFix> lander = {};
  std::optional<messages::SunSighting> sun = {};
  std::optional<messages::BeaconReading> beacon = {};
};

// The aids of localization of one drive: when they measure, when their data arrive, and what
// becomes of them.

// All aids of one drive draw from one counter: an estimator tells their moments apart by number.
class CaptureCounter {
 public:
  messages::CaptureNumber Next() { return next_++; }

 private:
  messages::CaptureNumber next_ = 0;
};

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

// How often.
struct AidCounts {
  std::int64_t used = 0;
  std::int64_t in_doubt = 0;    // of these, after the estimator doubted itself
  std::int64_t gated_out = 0;   // turned away
  std::int64_t unanswered = 0;  // was due, and saw or heard nothing
};

localization::SunAlmanac AlmanacOf(const sensing::SunSensorParams& sun);

// The moment of a measurement is captured as it is taken; what on-board software makes of it is
// handed to the estimator `delay_s` later.
class AidSuite {
 public:
  // `captures` outlives it.
  AidSuite(const sensing::AidParams& params, CaptureCounter& captures);

  // Once a control tick, after the estimator took it: what is to be measured now.
  AidRequest Due(const localization::Estimator& estimator, double time_s);
  // Takes what was measured of that, and hands in what is ready. Returns whether the estimate was
  // corrected.
  bool Take(const AidRequest& request, const AidAnswer& answer, double time_s,
            localization::Estimator& estimator);

  // What was taken before operators moved the rover is of no use any more.
  void OnPlaced() { waiting_.clear(); }

  const AidCounts& counts() const { return counts_; }

 private:
  struct Waiting {
    double ready_s = 0.0;
    messages::PoseFix fix;
  };

  // Captures the moment of `fix`, or counts that there is none.
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
