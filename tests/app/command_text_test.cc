#include "app/command_text.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "app/commands.h"

namespace rockyard::app {
namespace {

class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    AddCommands(app_, exit_code_);
    // Called when all is parsed, before the callbacks of subcommands, which own their options.
    app_.parse_complete_callback([] { throw CLI::Success(); });
  }

  const CLI::App& Parsed(const std::string& name, std::vector<std::string> words) {
    const CLI::App* command = app_.get_subcommand(name);
    words.insert(words.begin(), name);
    std::reverse(words.begin(), words.end());  // as this parser wants them
    EXPECT_THROW(app_.parse(words), CLI::Success);
    return *command;
  }

 private:
  CLI::App app_{"test", "rockyard"};
  ExitCode exit_code_ = ExitCode::kDone;
};

TEST_F(CommandLine, IsWhatWasTyped) {
  const CLI::App& command = Parsed(
      "run", {"--trials", "30", "a b.json", "--set", "a=1", "--set", "name='it'", "--quiet"});
  EXPECT_EQ(CommandText(command),
            "rockyard run 'a b.json' --trials 30 --set a=1 --set 'name='\\''it'\\''' --quiet");
}

TEST_F(CommandLine, NamesNoFileThatLooksLikeAnOption) {
  EXPECT_EQ(CommandText(Parsed("run", {"--quiet", "--out", "-o", "--set", "-p=1", "--", "-x"})),
            "rockyard run ./-x --set -p=1 --out -o --quiet");
  EXPECT_EQ(CommandText(Parsed("run", {"./-x", "--out", "-o", "--set", "-p=1", "--quiet"})),
            "rockyard run ./-x --set -p=1 --out -o --quiet")
      << "what was printed means the same";
}

TEST_F(CommandLine, ResumesWithoutSettingAside) {
  EXPECT_EQ(ResumeText(Parsed("sweep", {"s.json", "--force", "--out", "x"})),
            "rockyard sweep s.json --out x --resume");
  EXPECT_EQ(ResumeText(Parsed("run", {"s.json", "--resume", "--retry-faults"})),
            "rockyard run s.json --resume");
}

TEST(NextCommand, IsThePage) {
  EXPECT_EQ(NextCommand("runs/a b", Finished::kWhole), "rockyard report 'runs/a b'");
}

TEST(NextCommand, TakesNoFolderForAnOption) {
  const std::string command = NextCommand("-x", Finished::kWhole);
  EXPECT_NE(command.find(" ./-x"), std::string::npos) << command;
}

TEST(NextCommand, ShardsAreMerged) {
  EXPECT_EQ(NextCommand("runs/a", Finished::kShard), "rockyard merge SHARD... --out FOLDER");
}

TEST(NextLine, GoesOnWithWhatStopped) {
  EXPECT_EQ(NextLine("runs/a", Finished::kWhole, "rockyard run a.json --resume"),
            "  next: rockyard run a.json --resume\n");
  EXPECT_EQ(NextLine("runs/a", Finished::kShard, ""),
            "  next: rockyard merge SHARD... --out FOLDER\n");
}

}  // namespace
}  // namespace rockyard::app
