// The course of one trial as arrays for other tools.
#pragma once

#include <span>
#include <string>

#include "replay/data.h"
#include "truth/trace.h"

namespace rockyard::replay {

// Everything that a trace file holds.
struct TraceArrays {
  const truth::TracedTrial& traced;
  std::span<const ReplayPose> poses;  // of the trace, every moment
  std::span<const ReplayScan> scans;
  std::span<const ReplayStep> steps;
  std::string cell;
  std::string record_hash;
  core::Provenance provenance;
};

// A NumPy file whose arrays README.md of this folder lists, at full precision. The same trial of
// the same build gives the same bytes, except for the name of the machine in `meta`.
std::string TraceNpz(const TraceArrays& arrays);

}  // namespace rockyard::replay
