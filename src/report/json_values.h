// JSON values that several result files hold.
#pragma once

#include "core/json_value.h"
#include "statistics/proportions.h"

namespace rockyard::report {

// Of summary.json and its like.
inline constexpr int kSchemaVersion = 2;

// [low, high], null where there is none.
inline core::JsonValue EndsOf(const statistics::Interval& interval) {
  return core::JsonValue(
      core::JsonValue::List{core::NumberOrNull(interval.low), core::NumberOrNull(interval.high)});
}

}  // namespace rockyard::report
