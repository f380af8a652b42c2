#include "app/next_command.h"

#include <fmt/format.h>

#include "batch/communicator.h"
#include "campaign/shell_word.h"
#include "web/page.h"

namespace rockyard::app {

std::string NextCommand(const std::filesystem::path& folder, Finished what) {
  const std::string word = campaign::ShellPath(folder.string());
  if (what == Finished::kShard) return "rockyard merge SHARD... --out FOLDER";
  if (web::PagesBuilt()) return "rockyard report " + word;
  switch (what) {
    case Finished::kDrives:
      return fmt::format("rockyard trace {} --trial 0", word);
    case Finished::kMeasurement:
      return fmt::format("rockyard replay {} --trial 0 --list", word);
    default:
      return fmt::format("rockyard trace {} --cell 0 --trial 0", word);
  }
}

std::string NextLine(const std::filesystem::path& folder, Finished what,
                     const std::string& resume) {
  if (resume.empty()) return fmt::format("  next: {}\n", NextCommand(folder, what));
  const auto launch = batch::FindLaunch();
  return fmt::format("  next: {}{}\n", launch ? fmt::format("mpirun -n {} ", launch->ranks) : "",
                     resume);
}

}  // namespace rockyard::app
