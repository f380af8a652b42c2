// The aids of localization of one drive: when they measure, when their data arrive, and what
// becomes of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.h"
#include "localization/aid_fixes.h"
#include "localization/estimator.h"
#include "messages/aids.h"
#include "sensing/aid_params.h"
#include "sensing/aids.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

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

// The moment of a measurement is captured as it is taken; what on-board software makes of it is
// handed to the estimator `delay_s` later. The sensors see the truth, the estimator messages.
class AidSuite {
 public:
  // `terrain` and `captures` outlive it.
  AidSuite(const DriveParams& drive, core::TrialKey key, const terrain::Terrain& terrain,
           CaptureCounter& captures);

  // Once a control tick, after the estimator took it. Returns whether the estimate was corrected.
  bool Tick(const math::Transform& X_WR, double time_s, localization::Estimator& estimator);

  // What was taken before operators moved the rover is of no use any more.
  void OnPlaced() { waiting_.clear(); }

  const AidCounts& counts() const { return counts_; }

 private:
  struct Waiting {
    double ready_s = 0.0;
    messages::PoseFix fix;
  };

  void MeasureAll(const math::Transform& X_WR, double time_s, localization::Estimator& estimator);
  // Captures the moment of `fix`, or counts that there is none.
  void Take(std::optional<messages::PoseFix> fix, double ready_s,
            localization::Estimator& estimator);
  // Of the sun of `sensors.aids.sun` where that aid is there.
  std::optional<double> SunElevation_rad(double time_s) const;
  std::optional<messages::PoseFix> LookForSun(const math::Transform& X_WR, double time_s,
                                              const localization::Estimator& estimator);
  std::optional<messages::PoseFix> AskBeacon(const math::Transform& X_WR,
                                             const localization::Estimator& estimator);
  bool HandIn(const messages::PoseFix& fix, localization::Estimator& estimator);

  const terrain::Terrain& terrain_;
  CaptureCounter& captures_;
  sensing::AidParams params_;
  localization::SunAlmanac almanac_;
  sensing::LanderFix lander_fix_;
  sensing::SunSensor sun_;
  sensing::RadioBeacon beacon_;
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
