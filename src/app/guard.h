// Exceptions become messages and exit codes.
#pragma once

#include <functional>

#include "app/exit_code.h"

namespace rockyard::app {

// What `action` returns. An exception out of it is told on the terminal: kBadInput for
// core::UserError, kFailed for anything else.
ExitCode Guarded(const std::function<ExitCode()>& action);

}  // namespace rockyard::app
