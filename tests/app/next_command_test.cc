#include "app/next_command.h"

#include <gtest/gtest.h>

#include <string>

#include "web/page.h"

namespace rockyard::app {
namespace {

TEST(NextCommand, IsThePageWhereThisBuildHasPages) {
  for (const Finished what : {Finished::kDrives, Finished::kMeasurement, Finished::kSweep}) {
    const std::string command = NextCommand("runs/a b", what);
    EXPECT_NE(command.find(" 'runs/a b'"), std::string::npos) << command;
    EXPECT_EQ(command.starts_with("rockyard report "), web::PagesBuilt()) << command;
  }
}

TEST(NextCommand, TakesNoFolderForAnOption) {
  const std::string command = NextCommand("-x", Finished::kDrives);
  EXPECT_NE(command.find(" ./-x"), std::string::npos) << command;
}

TEST(NextCommand, ShardsAreMerged) {
  EXPECT_EQ(NextCommand("runs/a", Finished::kShard), "rockyard merge SHARD... --out FOLDER");
}

TEST(NextLine, GoesOnWithWhatStopped) {
  EXPECT_EQ(NextLine("runs/a", Finished::kDrives, "rockyard run a.json --resume"),
            "  next: rockyard run a.json --resume\n");
  EXPECT_EQ(NextLine("runs/a", Finished::kShard, ""),
            "  next: rockyard merge SHARD... --out FOLDER\n");
}

}  // namespace
}  // namespace rockyard::app
