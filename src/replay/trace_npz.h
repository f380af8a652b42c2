// The course of one trial as arrays for other tools: the files of `trace --npz` and of --traces of
// `run` and `sweep`.
#pragma once

#include <span>
#include <string>

#include "replay/data.h"
#include "truth/trace.h"

namespace rockyard::replay {

// Everything that a trace file holds.
struct TraceArrays {
  const truth::TracedTrial& traced;
  std::span<const ReplayPose> poses;  // every moment of the trace
  std::span<const ReplayScan> scans;
  std::span<const ReplayStep> steps;
  std::span<const ReplayOverlay> overlays;
  std::size_t overlay_every = 1;  // as ReplayData has it
  std::string cell;
  std::string record_hash;
  core::Provenance provenance;
};

// Returns a NumPy file with the arrays that README.md of this folder lists, at full precision. Must
// stay: names and shapes of the arrays, which other programs read; what changes them raises
// kFormatVersion (trace_npz.cc). The same trial of the same build gives the same bytes, except for
// what `meta` says of the machine (its name and the level of its processor).
std::string TraceNpz(const TraceArrays& arrays);

}  // namespace rockyard::replay
