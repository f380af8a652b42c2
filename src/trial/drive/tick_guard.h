// Ends a drive that has no end of its own; RunTrial asks it before each decision. Its limits decide
// which trials are faults; no other record depends on them.
#pragma once

#include <cstdint>
#include <stdexcept>

namespace rockyard::trial {

// Says that a drive has no end.
struct DriveWithoutEnd : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Counts the decisions of a drive. Must stay: decisions, not seconds of a clock, so that it ends
// the same drives on every machine. The referee ends a drive in simulated time; but a navigator
// that always stands still is never judged, and looks that take no time never bring time_limit_s
// nearer. Both would be faults of the program, and become simulator faults; of a plugin or process
// they are faults of the navigator. So does a drive without limit of time or patience that goes on
// for ever.
class TickGuard {
 public:
  // Most decisions where there is no time limit: at 20 Hz nearly three hours of motion, 1.5 km at
  // 0.15 m/s, some hundred times what the longest drives of a course take; simulated in seconds.
  static constexpr std::int64_t kUnlimited = 200'000;
  // Decisions for each control tick up to the time limit: one move and one look, and as much again.
  static constexpr double kTicksPerStep = 4.0;
  static constexpr std::int64_t kMin = 100'000;  // decisions on top, for short limits
  // Most decisions in a row that take no simulated time.
  static constexpr std::int64_t kMaxWithoutTime = 10'000;

  // `time_limit_s` 0: no limit.
  TickGuard(double time_limit_s, double tick_s)
      : left_(time_limit_s > 0.0
                  ? kMin + static_cast<std::int64_t>(kTicksPerStep * time_limit_s / tick_s)
                  : kUnlimited) {}

  // Counts a decision; called before each. Throws DriveWithoutEnd, which becomes the fault.
  void Observe(double time_s) {
    if (--left_ < 0) throw DriveWithoutEnd("the drive makes more decisions than its time has");
    if (time_s > last_s_) {
      without_time_ = 0;
      last_s_ = time_s;
    } else if (++without_time_ > kMaxWithoutTime) {
      throw DriveWithoutEnd("the drive makes decisions that take no time, without an end");
    }
  }

 private:
  std::int64_t left_;
  double last_s_ = -1.0;
  std::int64_t without_time_ = 0;
};

}  // namespace rockyard::trial
