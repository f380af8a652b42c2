// The inner loops of the fast correlator, compiled for every instruction set and chosen at run
// time. Each call does one row. Definitions of what they compute stand in correlator.h.
#pragma once

#include <cstdint>
#include <span>

#include "vision/stereo/correlator_state.h"
#include "vision/stereo/subpixel.h"

namespace rockyard::vision {

// Lanes of 16 bits of the vectors of the instruction set that is in use.
int VectorLanes();

// Lays a row of both images into a slot of the state.
void LoadRow(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right, int slot,
             CorrelatorState& state);

// Moves the scores down by a row: the differences of one slot come, those of the other go.
void SlideRow(int slot_in, int slot_out, CorrelatorState& state);

// As SlideRow, then the best of either image.
void ScoreRow(int slot_in, int slot_out, CorrelatorState& state);

// Brings together what right pixels found in vectors of different j, and writes right_index.
void GatherRightBest(CorrelatorState& state);

// Checks and sub-pixel interpolation: from the best of either image to `row`, in the order of
// pixels.
void DecideRow(const PeakLimits& limits, CorrelatorState& state);

}  // namespace rockyard::vision
