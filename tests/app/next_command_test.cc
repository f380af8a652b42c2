#include "app/next_command.h"

#include <gtest/gtest.h>

#include <string>

namespace rockyard::app {
namespace {

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
