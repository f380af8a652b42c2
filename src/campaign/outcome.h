/// @file
/// How work ended.
#pragma once

namespace rockyard::campaign {

/// The numbers are exit codes, of worker processes and of the command.
enum class Outcome {
  kDone = 0,           ///< all of it, and nothing differs
  kDiffers = 1,        ///< a comparison differs
  kBadInput = 2,       ///< nothing written
  kTooManyFaults = 3,  ///< simulator faults above the stated fraction
  kInconclusive = 4,   ///< nothing differs, but something is underpowered
  kFailed = 5,         ///< a disk or the machine failed while running; what was finished is stored
  kInterrupted = 130,  ///< somebody asked for an early end; what was finished is stored
};

}  // namespace rockyard::campaign
