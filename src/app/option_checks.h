// Checks that hold for the options of every command (AddCommands calls them last), the message for
// a value that an option refuses, and the options by which the commands `trace` and `replay` name a
// trial.
#pragma once

#include <optional>

#include "campaign/trial_source.h"
#include "core/error.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace rockyard::app {

// Adds checks to every option of the command and of its subcommands, on top of its own. An empty
// value is refused, which the parser would take for none. Numbers must be finite, as a range of the
// parser lets NaN pass, and decimal; leading zeros mean nothing. Call it when all options have been
// added.
void CheckEveryValue(CLI::App& app);

// Makes every subcommand refuse, before it does anything, an output file that is one of the files
// that it reads, by whatever name. campaign/output_folder.h refuses other files that cannot be
// meant.
void KeepEveryInput(CLI::App& app);

// Returns the command that shows the help of `command`: "rockyard plan claim --help".
std::string HelpOf(const CLI::App& command);

// Returns the problem of an option whose value was refused: the option, what is wrong, and what
// would be right (of an option that takes one of a few words, those words, the nearest first).
// Returns nothing for other errors of the parser.
std::optional<core::Problem> RefusedValue(const CLI::App& command, const CLI::ParseError& error);

// Adds SCENARIO_OR_RUN, --trial, --cell, --seed and --set to `trace` or `replay`. `request` must
// outlive the command.
void AddTrialOptions(CLI::App& command, campaign::TrialRequest& request);

// Replaces the name of a scenario in the request by its file. Throws core::UserError where the
// source is no scenario, and where it is a folder that holds runs but is none itself.
void FindSource(campaign::TrialRequest& request);

// Prints that a trial repeats its stored record, where it does; or, where `repeats_stored` is
// absent and `source` is the folder of a run, that the trial is pending and compared with nothing.
void PrintRepetition(std::optional<bool> repeats_stored, const std::string& source);

}  // namespace rockyard::app
