// How often operators can command the rover: what a command needs, against what a sol can carry.
#pragma once

#include <cstdint>

#include "experiments/mission/mission_params.h"

namespace rockyard::experiments {

// Bits that a command needs from the lander: its own images, compressed, and what the rover sent.
double NeededBits(const MissionDayParams& day);

// What the lander sends in a sol: rate times hours.
double SolBits(const MissionDayParams& day);

// Images of the lander that fit into a sol beside what a command needs, whole ones.
std::int64_t SpareImages(const MissionDayParams& day);

// Sols from one command to the next, 1 at least: as many as the bits take, and as many as pass
// until images have come (downlink_h at most, and the light time), operators have planned, and the
// command has gone up before the next window opens.
std::int64_t SolsPerCommand(const MissionDayParams& day);

}  // namespace rockyard::experiments
