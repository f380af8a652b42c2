// Courses of drives that are put together by hand, for tests of the experiment "three_rock_run".
#pragma once

#include <cmath>
#include <string>

#include "math/angles.h"
#include "truth/trace.h"

namespace rockyard::experiments {

// A drive of ticks of a second each, from the origin along x.
class TraceByHand {
 public:
  TraceByHand() { Add("drive"); }

  // Straight ahead in steps of `step_m`.
  TraceByHand& Drive(double length_m, double step_m = 0.05) {
    const auto steps = static_cast<int>(std::lround(length_m / step_m));
    for (int i = 0; i < steps; ++i) {
      pose_.x_m += step_m * std::cos(pose_.heading_rad);
      pose_.y_m += step_m * std::sin(pose_.heading_rad);
      Add("drive");
    }
    return *this;
  }

  // In place, by ticks of 5 deg; the rover believes `believed` of it.
  TraceByHand& Turn(double deg, double believed = 1.0) {
    const auto ticks = static_cast<int>(std::lround(std::abs(deg) / 5.0));
    for (int i = 0; i < ticks; ++i) {
      const double tick_rad = math::DegToRad(deg) / ticks;
      pose_.heading_rad = math::WrapAngle(pose_.heading_rad + tick_rad);
      error_rad_ += (believed - 1.0) * tick_rad;
      Add("turn");
    }
    return *this;
  }

  // The believed heading jumps with the next tick.
  TraceByHand& Jump(double deg) {
    error_rad_ += math::DegToRad(deg);
    return *this;
  }

  TraceByHand& Event(const std::string& kind) {
    trace_.events.push_back({time_s_, pose_, kind, ""});
    return *this;
  }

  const truth::Trace& trace() const { return trace_; }
  const math::Pose2& pose() const { return pose_; }

 private:
  void Add(const std::string& activity) {
    time_s_ += 1.0;
    truth::TraceSample sample;
    sample.time_s = time_s_;
    sample.pose = pose_;
    sample.estimate.heading_rad = math::WrapAngle(pose_.heading_rad + error_rad_);
    sample.activity = activity;
    trace_.samples.push_back(sample);
  }

  truth::Trace trace_;
  math::Pose2 pose_;
  double error_rad_ = 0.0;
  double time_s_ = 0.0;
};

}  // namespace rockyard::experiments
