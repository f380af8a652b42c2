// What the command tells the shell: 0 done, 1 a comparison differs, 2 bad input, 3 too many
// simulator faults, 4 inconclusive, 5 failed while running, 130 interrupted.
#pragma once

#include "campaign/outcome.h"

namespace rockyard::app {

using ExitCode = campaign::Outcome;

}  // namespace rockyard::app
