// What no command may be given, and what the parser says of a value that an option may not have.
#pragma once

#include <optional>

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
// that it is given to read, by whatever name. More is refused by campaign/output_file.h, and of
// folders by campaign/output_folder.h.
void KeepEveryInput(CLI::App& app);

// What tells of a command: "rockyard plan claim --help".
std::string HelpOf(const CLI::App& command);

// The option, what is wrong with its value, and what would be right: the words that it takes where
// it takes one of a few, with the nearest of them first. Nothing for other errors of the parser.
std::optional<core::Problem> RefusedValue(const CLI::App& command, const CLI::ParseError& error);

}  // namespace rockyard::app
