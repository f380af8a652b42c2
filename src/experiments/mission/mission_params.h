// Parameters of the experiment "mission", a mission of many sols. A default decides the records of
// scenarios that leave it out; a bound only refuses files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "messages/estimates.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// Most sols of a mission, and the stride of their random keys (SolKey). Must stay: another number
// is other noise in every mission of a seed but number 0.
inline constexpr std::uint32_t kMostSols = 1024;

// When operators find the rover in the lander's images of a day.
enum class LanderUpdate {
  kNone,
  kNoon,     // while it drives, or where it stands if it has ended its drive by then
  kEvening,  // at the end of its drive; the place is uplinked on the next morning
};

// Where the rover is to go, one place after the other.
struct MissionGoalsParams {
  std::vector<double> x_m{3.0, 6.0};
  std::vector<double> y_m{0.0, 0.0};
  std::int64_t attempts = 3;

  // Returns the goals. Lists of different lengths, which Visit refuses, give as many as the shorter
  // one has.
  std::vector<messages::Goal> Places() const;

  void Visit(core::FieldVisitor& v);
};

// The hours of a sol and what operators need for a command.
struct MissionDayParams {
  double window_h = 4.0;
  double latency_min = 11.0;
  double downlink_bit_s = 1260.0;
  double downlink_h = 2.5;
  double planning_h = 12.0;
  double lander_image_bits = 256.0 * 256.0 * 8.0;
  std::int64_t lander_images = 4;
  double rover_image_bits = 768.0 * 484.0 * 8.0;
  std::int64_t rover_images = 1;
  double telemetry_bits = 2e5;
  double compression = 1.0;
  double radio_bit_s = 2000.0;

  double Window_s() const { return 3600.0 * window_h; }
  // Returns the bits that the rover sends to the lander for a command, images compressed.
  double RoverBits() const;
  // Returns how long RoverBits takes after a drive, s.
  double TransmitTime_s() const { return RoverBits() / radio_bit_s; }

  void Visit(core::FieldVisitor& v);
};

// What supplies the rover, and what it draws besides its drive.
struct MissionPowerParams {
  double noon_W = 16.0;
  double dust_loss_per_sol = 0.0028;
  double battery_wh = 150.0;
  double modem_W = 2.5;
  double idle_W = 3.77;
  double sleep_W = 0.32;

  void Visit(core::FieldVisitor& v);
};

struct MissionParams {
  std::int64_t sols = 30;
  LanderUpdate lander_update = LanderUpdate::kEvening;
  double lander_x_m = 0.0;
  double lander_y_m = 0.0;
  double radio_range_m = 500.0;
  std::int64_t stuck_sols = 3;
  bool sol_columns = false;
  MissionGoalsParams goals;
  MissionDayParams day;
  MissionPowerParams power;

  void Visit(core::FieldVisitor& v);
};

// Requires what a drive does, and fixed rocks in an open arena that holds every goal, drives to one
// goal each, one activity at a time, a day that the evening fits into, and a sun that rises. Each
// failure names the parameter, what is wrong and a remedy.
void RequireMission(const MissionParams& mission, const trial::DriveParams& drive,
                    core::FieldVisitor& v);

}  // namespace rockyard::experiments

template <>
struct rockyard::core::EnumNames<rockyard::experiments::LanderUpdate> {
  static constexpr std::array<std::string_view, 3> kNames{"none", "noon", "evening"};
};
