#include "app/next_command.h"

#include <fmt/format.h>

#include "batch/communicator.h"
#include "campaign/shell_word.h"

namespace rockyard::app {

std::string NextCommand(const std::filesystem::path& folder, Finished what) {
  if (what == Finished::kShard) return "rockyard merge SHARD... --out FOLDER";
  return "rockyard report " + campaign::ShellPath(folder.string());
}

std::string NextLine(const std::filesystem::path& folder, Finished what,
                     const std::string& resume) {
  if (resume.empty()) return fmt::format("  next: {}\n", NextCommand(folder, what));
  const auto launch = batch::FindLaunch();
  return fmt::format("  next: {}{}\n", launch ? fmt::format("mpirun -n {} ", launch->ranks) : "",
                     resume);
}

}  // namespace rockyard::app
