// What a drive tells of its course, where somebody asks for a trace.
#include <string>
#include <utility>

#include "trial/drive.h"

namespace rockyard::trial {
namespace {

std::string Name(Activity activity) {
  switch (activity) {
    case Activity::kDriving:
      return "drive";
    case Activity::kTurning:
      return "turn";
    case Activity::kSteering:
      return "steer";
    case Activity::kScanning:
      return "scan";
    case Activity::kStalled:
      return "stall";
  }
  return "";
}

}  // namespace

void Drive::Record(std::string kind, std::string detail) {
  if (trace_ == nullptr) return;
  trace_->events.push_back(
      {ledger_.time_s(), math::ToPose2(rover_->state().X_WR), std::move(kind), std::move(detail)});
}

void Drive::Sample(Activity activity) {
  if (trace_ == nullptr) return;
  trace_->samples.push_back({ledger_.time_s(), math::ToPose2(rover_->state().X_WR),
                             math::Tilt(rover_->state().X_WR), dead_reckoning_.estimate(),
                             Name(activity)});
}

}  // namespace rockyard::trial
