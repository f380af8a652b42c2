// Hazards that the rover feels: touch, tilt, articulation, motor current (Matthies 1995, section 6,
// which names the sensors; the criteria are assumptions). The on-board side of a drive feels by it
// every tick.
//
//   touch:        a contact switch is closed; side by the place of the switch
//   tilt:         atan2(|(f_x, f_y)|, f_z) > max_tilt of the specific force f, its angle to the
//                 rover's z axis (0 without any force); the cause is on the side that is higher,
//                 ahead where the rover pitches more than it rolls
//   articulation: |bogie| > max_bogie, on its side; |rocker| > max_rocker, on the side whose front
//                 end is higher (the differential turns the other rocker as far the other way)
//   stall:        a motor above max_current whose wheel turns by less than max_turn_share of what
//                 it was told; side of the wheels that stall, ahead where both
//
// A criterion has to hold for its number of ticks in a row; the stall has to hold that long at one
// wheel. Kinds are felt independently of each other. A high current is no hazard by itself: a wheel
// that climbs takes nearly as much as one that is stuck, but it turns. Ticks in which a wheel is
// told to rest neither add to its stall nor end it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "messages/vehicle_state.h"
#include "messages/wheels.h"
#include "perception/hazard_params.h"

namespace rockyard::perception {

// Returns the angle between the rover's z axis and the specific force, rad.
double TiltOf(const math::Vector3& specific_force_R);

// How far the drive motors were told to turn over a tick, and how far their encoders say that they
// turned, rad, positive forward.
struct WheelTurns {
  messages::PerWheel<double> told_rad{};
  messages::PerWheel<double> turned_rad{};
};

// What the rover feels after an on-board tick. `by_kind` follows VehicleHazardKind. Its order
// decides which of several hazards the rover gets away from first (HazardToAvoid).
struct FeltHazards {
  std::array<std::optional<messages::VehicleHazard>, messages::kVehicleHazardKindCount> by_kind;
  bool touches_behind = false;  // whatever else is touched
};

// Returns the hazard to get away from: of several the first by kind. A touch behind is not among
// them, as the rover drives away from it by going on.
std::optional<messages::VehicleHazard> HazardToAvoid(const FeltHazards& felt);

// Counts the ticks for which each criterion holds.
class VehicleHazardDetector {
 public:
  explicit VehicleHazardDetector(const VehicleHazardParams& params) : params_(params) {}

  // Returns the hazards that hold after the next on-board tick.
  FeltHazards Observe(const messages::VehicleState& state, const WheelTurns& turns);

  // Forgets the ticks counted so far.
  void Reset();

 private:
  using Kind = messages::VehicleHazardKind;

  // Counts the ticks in a row of one kind, and returns the hazard once there are enough.
  std::optional<messages::VehicleHazard> Debounced(Kind kind,
                                                   std::optional<messages::HazardSide> now,
                                                   std::int64_t ticks);
  std::optional<messages::HazardSide> Tilted(const math::Vector3& specific_force_R) const;
  std::optional<messages::HazardSide> Bent(const messages::Articulation& angles) const;
  // Counts the ticks of each wheel that stalls, and returns where those with enough of them are.
  std::optional<messages::HazardSide> Stalled(const messages::PerWheel<double>& current_A,
                                              const WheelTurns& turns);

  VehicleHazardParams params_;
  std::array<std::int64_t, messages::kVehicleHazardKindCount> ticks_{};
  messages::PerWheel<std::int64_t> stalled_ticks_{};
  std::int64_t ticks_behind_ = 0;
};

}  // namespace rockyard::perception
