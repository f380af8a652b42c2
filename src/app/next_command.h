// What to type next: the last line of what a campaign says on a terminal.
#pragma once

#include <filesystem>
#include <string>

namespace rockyard::app {

// What a folder holds once its trials have been run: all of a campaign, or one machine's share.
enum class Finished { kWhole, kShard };

// One command that shows more of the folder: its page for a browser, or how shares become one.
std::string NextCommand(const std::filesystem::path& folder, Finished what);

// "  next: COMMAND\n": how to go on with a campaign that stopped (`resume`, empty where it did
// not), else NextCommand. Never broken, however long, so that it can be copied.
std::string NextLine(const std::filesystem::path& folder, Finished what, const std::string& resume);

}  // namespace rockyard::app
