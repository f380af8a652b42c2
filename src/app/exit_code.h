// What the command tells the shell.
#pragma once

namespace rockyard::app {

enum class ExitCode {
  kDone = 0,
  kDiffers = 1,        // a comparison differs
  kBadInput = 2,       // nothing written
  kTooManyFaults = 3,  // simulator faults above the stated fraction
  kInconclusive = 4,   // nothing differs, but something is underpowered
  kFailed = 5,         // a disk or the machine failed while running; what was finished is stored
  kInterrupted = 130,  // by Ctrl-C or another polite signal; what was finished is stored
};

}  // namespace rockyard::app
