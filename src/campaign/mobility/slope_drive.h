// One rover on one slope: it drives until its slip is steady, and what its state says then. The
// command `mobility` draws its charts from such drives. They are made by the rover that trials
// drive (rover/rover.h), on a plane without rocks.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "messages/wheels.h"
#include "rover/rover_params.h"
#include "terrain/soil_params.h"

namespace rockyard::campaign {

// Where the rover heads on the slope; across it the left side is up.
enum class SlopeWay { kUp, kDown, kAcross };

// What it does there.
enum class SlopeState {
  kDrives,  // steadily
  kCreeps,  // its slip still changed when the way was used up: its values are those of the end
  kSpins,   // its wheels turn and it gets nowhere
  kSlides,  // it moves against its wheels, or downhill at more than twice their speed
  kStalls,  // its motors do not turn
  kTurns,   // across the slope it turns off, however it steers
  kTips,    // it leans 30 deg beyond the slope
};

struct SlopePoint {
  double slope_rad = 0.0;
  SlopeState state = SlopeState::kDrives;
  // 1 - v / (omega r) along the rover's heading, of the mean rim, within [-1, 1]; 1 where it spins,
  // stalls or slides back.
  double slip = 0.0;
  double side_slip_rad = 0.0;  // angle from its heading to its motion, positive downhill
  messages::PerWheel<double> load_N{};
  messages::PerWheel<double> sinkage_m{};
  messages::PerWheel<double> torque_Nm{};
  messages::PerWheel<double> power_W{};  // torque times rate
  // Whether these mean anything: not where it tips, turns off, or slides off across the slope.
  bool has_values = true;
};

// Drives straight ahead on a slope in [0, pi/2) and returns what it comes to. Across the slope its
// heading is held by steering. The rover stands on the slope first, and then rolls on its rims for
// windows of the way in which wheels dig in (SlipSinkage), until two of them after another differ
// from the one before by less than 1e-4 of slip, 100 windows at most. A rover that slides or stalls
// is not driven on. Draws nothing. Cost: about 0.2 ms for fidelity quasi_static.
SlopePoint DriveSlope(const rover::RoverParams& params, const terrain::SoilParams& soil,
                      double slope_rad, SlopeWay way);

// Returns the rover with all its masses times a factor: every wheel carries so much more.
rover::RoverParams Loaded(const rover::RoverParams& params, double factor);

}  // namespace rockyard::campaign

template <>
struct rockyard::core::EnumNames<rockyard::campaign::SlopeWay> {
  static constexpr std::array<std::string_view, 3> kNames{"up", "down", "across"};
};

template <>
struct rockyard::core::EnumNames<rockyard::campaign::SlopeState> {
  static constexpr std::array<std::string_view, 7> kNames{"drives", "creeps", "spins", "slides",
                                                          "stalls", "turns",  "tips"};
};
