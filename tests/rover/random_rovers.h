// Rovers by chance, each of which a scenario could take.
#pragma once

#include <cmath>
#include <random>

#include "core/archive.h"
#include "core/error.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// A rover all of whose numbers are up to a quarter away from the default ones, with bogies and
// steering by chance.
class RandomRovers {
 public:
  RoverParams Next() {
    for (;;) {
      core::JsonValue json = core::WriteParams(RoverParams{});
      Scatter(json);
      json.Find("geometry")->Set("middle_wheel_x_m", core::JsonValue(0.05 * Share()));
      json.Find("geometry")->Set("bogie_end", core::JsonValue(Share() > 0.0 ? "rear" : "front"));
      json.Find("geometry")
          ->Set("steered_wheels", core::JsonValue(Share() > 0.0 ? "all" : "corners"));
      RoverParams rover;
      try {
        core::ReadParams(json, rover);
        return rover;
      } catch (const core::UserError&) {
        // Its parts found no room.
      }
    }
  }

 private:
  // From -1 to 1.
  double Share() { return 2.0 * std::ldexp(static_cast<double>(random_() >> 11), -53) - 1.0; }

  void Scatter(core::JsonValue& json) {
    for (core::JsonMember& member : json.members()) {
      if (member.value.Is(core::JsonValue::Type::kObject)) Scatter(member.value);
      if (member.value.Is(core::JsonValue::Type::kReal)) {
        member.value = core::JsonValue(member.value.number() * (1.0 + 0.25 * Share()));
      }
    }
  }

  std::mt19937_64 random_{7};
};

}  // namespace rockyard::rover
