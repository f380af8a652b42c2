// What a rover asks of the aids of localization at one tick, and what they answer.
#pragma once

#include <cstdint>
#include <optional>

#include "messages/aids.h"

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

}  // namespace rockyard::trial
