#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "batch/unprivileged.h"
#include "core/error.h"
#include "core/files.h"
#include "core/refusals.h"
#include "core/test_folder.h"

namespace rockyard::core {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;

class WholeFileTest : public testing::Test {
 protected:
  fs::path Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  static std::string ReasonOf(const fs::path& path, std::size_t most = 100) {
    try {
      ReadWholeFile(path, most, "a toy");
    } catch (const UserError& error) {
      EXPECT_EQ(error.problems().front().path, path.string());
      return error.what();
    }
    return "is read";
  }

  TestFolder own_;
  const fs::path& folder_ = own_.path();
};

TEST_F(WholeFileTest, EveryByteUpToTheLimit) {
  const std::string bytes("a\0\r\n\xff", 5);
  EXPECT_EQ(ReadWholeFile(Write("a", bytes), 5, "a toy"), bytes);
  EXPECT_THAT(ReasonOf(folder_ / "a", 4), HasSubstr("has 5 bytes, more than the 4 allowed"));
  EXPECT_EQ(ReadWholeFile(Write("empty", ""), 0, "a toy"), "");
}

TEST_F(WholeFileTest, WhatIsNoFileOfBytesIsRefused) {
  EXPECT_THAT(ReasonOf(folder_ / "none"), HasSubstr("the file does not exist"));
  EXPECT_THAT(ReasonOf(folder_), HasSubstr("is a folder, not a regular file (name a toy)"));
  EXPECT_THAT(ReasonOf("/dev/zero"), HasSubstr("is not a regular file (name a toy)"));
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(ReasonOf(folder_ / "pipe"), HasSubstr("is not a regular file"))
      << "and does not wait";
}

TEST_F(WholeFileTest, TextIsUtf8WithOrWithoutAMark) {
  EXPECT_EQ(ReadTextFile(Write("a", "\xef\xbb\xbf\xc3\xa9\r\n"), 9, "a toy"), "\xc3\xa9\r\n");
  EXPECT_EQ(ReadTextFile(Write("a", "\xef\xbb\xbf"), 9, "a toy"), "");
  EXPECT_EQ(ReadTextFile(Write("a", "x\xef\xbb\xbf"), 9, "a toy"), "x\xef\xbb\xbf");
  const auto refused = [&](const std::string& bytes) {
    return RefusalOf([&] { ReadTextFile(Write("a", bytes), 100, "a toy"); });
  };
  EXPECT_THAT(refused("one\ntwo\ncaf\xe9\n"),
              HasSubstr("a: line 3: byte 0xe9 is no text of UTF-8"));
  EXPECT_THAT(refused("\xff\xfe"
                      "a"),
              HasSubstr("line 1: byte 0xff"));
  EXPECT_THAT(refused(std::string("a\0b", 3)), HasSubstr("line 1: byte 0x00"));
}

// A file that may not be read, and one in a folder that may not be entered.
TEST_F(WholeFileTest, WithoutPermission) {
  const fs::path closed = Write("closed", "a");
  fs::permissions(closed, fs::perms::none);
  fs::create_directory(folder_ / "shut");
  const fs::path inside = Write("shut/inside", "a");
  fs::permissions(folder_ / "shut", fs::perms::owner_read);
  for (const fs::path& path : {closed, inside}) {
    EXPECT_THAT(batch::AsNobody([&] { return ReasonOf(path); }),
                HasSubstr("cannot be read: Permission denied (check its permissions)"));
  }
  fs::permissions(folder_ / "shut", fs::perms::owner_all);
}

}  // namespace
}  // namespace rockyard::core
