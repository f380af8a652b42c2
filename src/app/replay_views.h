// Scans and steps of a trial, listed or drawn.
#pragma once

#include "app/exit_code.h"
#include "app/replay_options.h"

namespace rockyard::app {

// Runs the trial again. Draws the scan or step that the options name into a folder, or else lists
// all of them. kDiffers where the record is not the stored one. Throws core::UserError.
ExitCode ShowViews(const ReplayOptions& options);

}  // namespace rockyard::app
