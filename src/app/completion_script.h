// Completion of the command line by the shell.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace rockyard::app {

enum class Shell { kBash, kZsh, kFish };

// A script that completes the subcommands of the parser, their options, what options take where
// that is one of a few words, names and settings that the program looks up (LookUp),
// and files elsewhere. Made from the parser itself, so that it knows
// every option. Limits: the subcommands of subcommands (rockyard plan) are completed with the
// options of them all; names of cells are not known to it.
std::string CompletionScript(const CLI::App& app, Shell shell);

}  // namespace rockyard::app
