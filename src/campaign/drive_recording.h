// A drive that is driven again with somebody watching, and its plan view.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "replay/data.h"
#include "scenario/scenario.h"
#include "truth/trace.h"

namespace rockyard::campaign {

// The course of one drive, and what the rover saw and chose on the way.
struct DriveRecording {
  truth::TracedTrial traced;
  std::vector<replay::ReplayScan> scans;
  std::vector<replay::ReplayStep> steps;
  std::vector<replay::ReplayLook> looks;  // those that have images
};

// Most points of one step that are kept, evenly spread over those that the look gave.
inline constexpr std::size_t kMaxStepPoints = 120;

// Drives the trial: a pure function of its arguments, with the record of the campaign, bit for bit.
// A simulator fault ends the recording where it happens. Throws core::UserError where the scenario
// is no drive. Memory: some 0.4 kB a control tick, and 60 kB a step of a map-based navigator, 30 kB
// a look with images.
DriveRecording RecordDrive(const scenario::Scenario& scenario, std::uint64_t seed,
                           std::uint64_t trial);

// Every moment of the recording in the order of time, with the angles of the rover's links.
std::vector<replay::ReplayPose> PosesOf(const scenario::Scenario& scenario,
                                        const truth::Trace& trace);

// An SVG file in the manner of Matthies 1995, figure 16: octagons at the positions and of the sizes
// of rocks, true path solid, dead-reckoned path dotted, filled circles on both where obstacles were
// detected, an x at start and goal. Rocks lie where they lay at the start. Cost: that of building
// the terrain.
std::string PlanView(const scenario::Scenario& scenario, const truth::TracedTrial& traced);

}  // namespace rockyard::campaign
