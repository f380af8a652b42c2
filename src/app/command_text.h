// A command line as it can be typed again, and the one next command that the text of `run`, `sweep`
// and `merge` ends with. Pages of reports show the command that made them.
#pragma once

#include <filesystem>
#include <string>

namespace CLI {
class App;
}

namespace rockyard::app {

// Returns a subcommand that has been parsed with all that it was given, quoted for a POSIX shell:
// "rockyard run scenarios/a.json --trials 10".
std::string CommandText(const CLI::App& command);

// Returns the command that goes on with a campaign that stopped: the CommandText with --resume, and
// without the options that hold for its first session alone, such as --force, which would set the
// campaign aside.
std::string ResumeText(const CLI::App& command);

// What a folder holds once its trials have been run: a whole campaign, or one shard.
enum class Finished { kWhole, kShard };

// Returns the command that makes more of the folder: `report` of a whole campaign, `merge` of a
// shard.
std::string NextCommand(const std::filesystem::path& folder, Finished what);

// Returns "  next: COMMAND\n": `resume`, which goes on with a campaign that stopped, under mpirun
// where this process is; or NextCommand where `resume` is empty. The line is never broken, so that
// people can copy the command.
std::string NextLine(const std::filesystem::path& folder, Finished what, const std::string& resume);

}  // namespace rockyard::app
