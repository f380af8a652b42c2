// What no command may be given, what the parser says of a value that an option may not have, and
// the options that name a trial.
#pragma once

#include <optional>

#include "campaign/trial_source.h"
#include "core/error.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace rockyard::app {

// Lets every option of the command and of its subcommands refuse, on top of its own checks, an
// empty value, which the parser would take for none, where it takes a real number "nan" and "inf"
// (a range lets NaN pass, since NaN lies neither below nor above it), and numbers that are not
// decimal; leading zeros mean nothing. Called when all options have been added.
void CheckEveryValue(CLI::App& app);

// Lets every subcommand refuse, before it does anything, an output file that is one of the files
// that it is given to read, by whatever name. More is refused by campaign/output_folder.h.
void KeepEveryInput(CLI::App& app);

// What tells of a command: "rockyard plan claim --help".
std::string HelpOf(const CLI::App& command);

// The option, what is wrong with its value, and what would be right: the words that it takes where
// it takes one of a few, with the nearest of them first. Nothing for other errors of the parser.
std::optional<core::Problem> RefusedValue(const CLI::App& command, const CLI::ParseError& error);

// What `rockyard trace` and `rockyard replay` share: which trial, and whether it repeats its
// record.

// Adds SCENARIO_OR_RUN, --trial, --cell, --seed and --set to a command. `request` must outlive it.
void AddTrialOptions(CLI::App& command, campaign::TrialRequest& request);

// Makes of the name of a scenario its file. Throws core::UserError where it is neither that nor one
// run.
void FindSource(campaign::TrialRequest& request);

// Says that a trial repeats its stored record, where it does, and of one of a run (`source` is its
// folder) that has none yet that it is compared with nothing.
void PrintRepetition(std::optional<bool> repeats_stored, const std::string& source);

}  // namespace rockyard::app
