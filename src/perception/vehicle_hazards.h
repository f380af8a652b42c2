// Hazards that the rover feels: touch, tilt, articulation, motor current (Matthies 1995, section 6,
// which names the sensors; the criteria are assumptions).
//
//   touch:        a contact switch is closed; side by the place of the switch
//   tilt:         acos(f_z / |f|) > max_tilt of the specific force f; the cause is on the side that
//                 is higher, ahead where the rover pitches more than it rolls
//   articulation: |bogie| > max_bogie, on its side; |rocker| > max_rocker, on the side whose front
//                 end is higher (the differential turns the other rocker as far the other way)
//   current:      any motor above max_current; side of the wheels above it, ahead where both
//
// A criterion has to hold for its number of ticks in a row. Of several at once the first in that
// order is reported.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "messages/vehicle_state.h"
#include "perception/vehicle_hazard_params.h"

namespace rockyard::perception {

// Angle between the rover's z axis and the specific force, rad.
double TiltOf(const math::Vector3& specific_force_R);

class VehicleHazardDetector {
 public:
  explicit VehicleHazardDetector(const VehicleHazardParams& params) : params_(params) {}

  // The hazard that holds after the next on-board tick, if any.
  std::optional<messages::VehicleHazard> Observe(const messages::VehicleState& state);

  // Forgets the ticks counted so far.
  void Reset() { ticks_.fill(0); }

 private:
  using Kind = messages::VehicleHazardKind;

  // Counts the ticks in a row of one kind; the side once there are enough.
  std::optional<messages::VehicleHazard> Debounced(Kind kind,
                                                   std::optional<messages::HazardSide> now,
                                                   std::int64_t ticks);
  std::optional<messages::HazardSide> Tilted(const math::Vector3& specific_force_R) const;
  std::optional<messages::HazardSide> Bent(const messages::Articulation& angles) const;
  std::optional<messages::HazardSide> Strained(const messages::PerWheel<double>& current_A) const;

  VehicleHazardParams params_;
  std::array<std::int64_t, messages::kVehicleHazardKindCount> ticks_{};
};

}  // namespace rockyard::perception
