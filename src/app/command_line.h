// The rockyard command.
#pragma once

namespace rockyard::app {

// Parses the arguments, runs the subcommand, reports every failure on standard error as
// "error: PATH: reason" and "  try: suggestion", and returns the exit code (console.h). Throws
// nothing.
int RunCommandLine(int argc, const char* const* argv);

}  // namespace rockyard::app
