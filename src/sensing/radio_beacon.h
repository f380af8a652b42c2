// Range and bearing by radio between lander and rover (Matthies 1995, section 5).
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "messages/aids.h"
#include "sensing/aid_params.h"
#include "sensing/lander_fix.h"

namespace rockyard::sensing {

// Range and bearing of the rover as seen from the lander, each with normal errors. Ranges are never
// below 0. Limits: radio is heard through rocks, and reflections disturb nothing.
class RadioBeacon {
 public:
  RadioBeacon(const RadioBeaconParams& params, const LanderPlace& station, core::TrialKey key)
      : params_(params), station_(station), key_(key) {}

  // Nothing beyond the range. `number` counts measurements from 0 (stream kRadioBeacon, substream
  // number).
  std::optional<messages::BeaconReading> Observe(const math::Transform& X_WR,
                                                 std::int64_t number) const;

 private:
  RadioBeaconParams params_;
  LanderPlace station_;
  core::TrialKey key_;
};

}  // namespace rockyard::sensing
