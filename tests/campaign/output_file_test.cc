#include "campaign/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"
#include "core/test_folder.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

class OutputFile : public testing::Test {
 protected:
  std::string At(const std::string& name) const { return (folder_ / name).string(); }

  // Empty where it is accepted.
  static std::string Reason(const std::string& file) {
    try {
      CheckOutputFile("--csv", file);
    } catch (const core::UserError& error) {
      return error.problems().at(0).path + " " + error.problems().at(0).reason;
    }
    return "";
  }

 private:
  core::TestFolder own_;
  const fs::path& folder_ = own_.path();
};

TEST_F(OutputFile, MayBeNewOrThere) {
  std::ofstream(At("old.csv")) << "1";
  fs::create_symlink(At("old.csv"), At("link.csv"));
  fs::create_symlink(At("none.csv"), At("dangling.csv"));
  for (const char* name : {"new.csv", "old.csv", "link.csv", "dangling.csv"}) {
    EXPECT_EQ(Reason(At(name)), "") << name;
  }
}

// What is renamed onto a device takes its place: as root even that of /dev/null.
TEST_F(OutputFile, IsNoDeviceAndNoPipe) {
  ASSERT_EQ(mkfifo(At("pipe").c_str(), 0600), 0);
  fs::create_symlink(At("pipe"), At("link"));
  for (const std::string& file : {At("pipe"), At("link"), std::string("/dev/null")}) {
    EXPECT_EQ(Reason(file), "--csv is there and is no regular file: " + file);
  }
}

// A file is written under a longer name first, with 21 more bytes; most file systems know 255.
TEST_F(OutputFile, HasANameThatLeavesRoomForAnother) {
  const std::string longest(255 - 21, 'x');
  EXPECT_EQ(Reason(At(longest)), "");
  EXPECT_EQ(Reason(At(longest + "x")), "--csv has too long a name: " + At(longest + "x"));
}

TEST_F(OutputFile, IsNoFolderAndInOneThatIsThere) {
  EXPECT_EQ(Reason(At("")), "--csv is a folder: " + At(""));
  EXPECT_EQ(Reason(At("none/a.csv")),
            "--csv is in a folder that does not exist: " + At("none/a.csv"));
}

}  // namespace
}  // namespace rockyard::campaign
