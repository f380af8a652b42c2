// Parameters of driving without stopping to look: Howard 2012, section 2.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"

namespace rockyard::navigation {

// How looking, planning and driving follow each other.
enum class DriveCycle {
  kStopAndLook,  // Goldberg 2002: at rest, one after the other
  kCsod,  // continuous steering or driving: it looks and plans while it drives arcs, and stands
          // to steer
  kCsad,  // continuous steering and driving: it drives clothoid splines and stands for nothing
};

// Where a plan that is made on the move begins.
enum class PlanStart {
  kPredicted,  // from where it looked, along the motion under way, at the speed that it had
  kEstimated,  // where the rover believes to be when the plan is ready: as if planning took no time
};

// What a rover does on the move where no new plan is safe.
enum class NoSafePlan {
  kStop,    // at once, and looks about as it does at rest
  kFinish,  // drives on as far as the motion under way was judged, and stops there
};

// What a rover does at the end of its motion where the next plan is not ready.
enum class LatePlan {
  kWait,         // stands until it is
  kStopAndLook,  // drops what is under way and looks again, at rest
};

struct GestaltContinuousParams {
  DriveCycle cycle = DriveCycle::kStopAndLook;
  double motion_m = 1.0;
  double replan_fraction = 0.5;
  PlanStart plan_start = PlanStart::kPredicted;
  NoSafePlan no_safe_plan = NoSafePlan::kStop;
  LatePlan late_plan = LatePlan::kWait;

  // Driven between two plans, m, where none is late.
  double ReplanDistance_m() const { return replan_fraction * motion_m; }

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::DriveCycle> {
  static constexpr std::array<std::string_view, 3> kNames{"stop_and_look", "csod", "csad"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::PlanStart> {
  static constexpr std::array<std::string_view, 2> kNames{"predicted", "estimated"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::NoSafePlan> {
  static constexpr std::array<std::string_view, 2> kNames{"stop", "finish"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::LatePlan> {
  static constexpr std::array<std::string_view, 2> kNames{"wait", "stop_and_look"};
};
