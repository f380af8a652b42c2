// The rockyard command, from its arguments to its exit code. main calls it, and tests in their own
// process.
#pragma once

namespace rockyard::app {

// Parses the arguments, runs the subcommand, tells every failure on standard error (PrintProblems),
// and returns an ExitCode (console.h). Throws nothing.
int RunCommandLine(int argc, const char* const* argv);

}  // namespace rockyard::app
