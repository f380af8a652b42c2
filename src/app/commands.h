// The subcommands, most in a file each. RunCommandLine adds them to its parser.
//
// Add...() describes a subcommand to the parser. When the user names the subcommand, its callback
// runs, and throws core::UserError for what is wrong with the input. The callback runs after
// Add...() has returned: it owns the options that the parser fills. A callback that can end
// otherwise than kDone sets `exit_code`, which must outlive the parsing.
//
// Must agree: docs/commands is made from the descriptions, and a test compares. After a change call
// `rockyard help --format markdown --out docs/commands`.
#pragma once

#include <string>

#include "app/console.h"

namespace CLI {
class App;
}

namespace rockyard::app {

void AddRunCommand(CLI::App& app, ExitCode& exit_code);
void AddBaselineCommand(CLI::App& app);
void AddSweepCommand(CLI::App& app, ExitCode& exit_code);
void AddCheckCommand(CLI::App& app, ExitCode& exit_code);
void AddMergeCommand(CLI::App& app, ExitCode& exit_code);
void AddCompareCommand(CLI::App& app, ExitCode& exit_code);
void AddReplayCommand(CLI::App& app, ExitCode& exit_code);
void AddReportCommand(CLI::App& app, ExitCode& exit_code);
void AddRoverCommand(CLI::App& app);
void AddRenderCommand(CLI::App& app, ExitCode& exit_code);
void AddCalibrateCommand(CLI::App& app);
void AddStereoCommand(CLI::App& app);
void AddVoCommand(CLI::App& app, ExitCode& exit_code);
void AddCylinderCommand(CLI::App& app, ExitCode& exit_code);
void AddMobilityCommand(CLI::App& app, ExitCode& exit_code);
void AddBenchCommand(CLI::App& app, ExitCode& exit_code);
void AddTerrainCommand(CLI::App& app);
void AddTraceCommand(CLI::App& app, ExitCode& exit_code);
void AddValidateCommand(CLI::App& app);
void AddDefaultsCommand(CLI::App& app);
void AddSchemaCommand(CLI::App& app);
void AddListCommand(CLI::App& app);
void AddParametersCommand(CLI::App& app);
void AddPlanCommand(CLI::App& app);
void AddMetricsCommand(CLI::App& app);
void AddNewCommand(CLI::App& app);
void AddHelpCommand(CLI::App& app);
void AddCompletionCommand(CLI::App& app);  // after all others, which it completes

// Adds all of them, their examples, and the checks that hold for every option (option_checks.h).
void AddCommands(CLI::App& app, ExitCode& exit_code);

// Returns what `rockyard` alone says: what the program is, three commands to begin with, where the
// documentation is, and a line for every subcommand.
std::string StartText(const CLI::App& app);

}  // namespace rockyard::app
