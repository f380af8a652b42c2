#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <new>
#include <set>

#include "batch/unprivileged.h"
#include "core/error.h"
#include "core/files.h"
#include "core/refusals.h"
#include "core/test_folder.h"

namespace rockyard::core {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class TemporaryFileTest : public testing::Test {
 protected:
  fs::path Target() const { return folder_ / "name.txt"; }
  fs::path Leftover(const std::string& suffix = "") const {
    return folder_ / ("name.txt.tmp-0123456789abcdef" + suffix);
  }
  static std::string Read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void Write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
  std::set<std::string> Names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.insert(entry.path().filename());
    return names;
  }

  TestFolder own_;
  const fs::path& folder_ = own_.path();
};

TEST_F(TemporaryFileTest, TakesTheNameAtCommitAlone) {
  Write(Target(), "old");
  {
    const TemporaryFile file(Target());
    EXPECT_TRUE(IsTemporaryOf(Target(), file.path()));
    EXPECT_EQ(write(file.descriptor(), "lost", 4), 4);
    Write(file.path().string() + "-journal", "of a library");
  }
  EXPECT_EQ(Names(), std::set<std::string>{"name.txt"});
  EXPECT_EQ(Read(Target()), "old");
  TemporaryFile file(Target());
  EXPECT_EQ(write(file.descriptor(), "new", 3), 3);
  file.Commit();
  EXPECT_EQ(Read(Target()), "new");
  EXPECT_EQ(Names(), std::set<std::string>{"name.txt"});
}

TEST_F(TemporaryFileTest, NamesCannotBeForeseen) {
  const TemporaryFile first(Target());
  const TemporaryFile second(Target());
  EXPECT_NE(first.path(), second.path());
}

// A link at the target is replaced, and what it leads to stays.
TEST_F(TemporaryFileTest, WritesThroughNoLink) {
  Write(folder_ / "victim", "mine");
  fs::create_symlink(folder_ / "victim", Target());
  TemporaryFile file(Target());
  file.Commit();
  EXPECT_EQ(Read(folder_ / "victim"), "mine");
  EXPECT_FALSE(fs::is_symlink(Target()));
}

TEST_F(TemporaryFileTest, SaysWhyNot) {
  try {
    const TemporaryFile file(folder_ / "no" / "such");
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ENOENT);
  }
}

TEST_F(TemporaryFileTest, LeftoversAreRemovedAndNothingElse) {
  const std::set<std::string> kept = {"name.txt.tmp-mine",
                                      "name.txt.tmp-123",
                                      "name.txt.tmp-0123456789ABCDEF",
                                      "name.txt.tmp-0123456789abcdef0",
                                      "other.txt.tmp-0123456789abcdef",
                                      "name.txt.tmp-0123456789abcdef.txt",
                                      "name.txt"};
  for (const std::string& name : kept) Write(folder_ / name, "x");
  for (const char* suffix : {"", "-journal", "-wal", "-shm"}) Write(Leftover(suffix), "x");
  fs::create_directories(folder_ / "name.txt.tmp-00000000000000ff" / "inside");
  RemoveLeftovers(Target());
  EXPECT_EQ(Names(), kept);
}

TEST_F(TemporaryFileTest, ALinkThatLooksLikeALeftoverIsNotFollowed) {
  fs::create_directories(folder_ / "precious" / "inside");
  fs::create_symlink(folder_ / "precious", Leftover());
  RemoveLeftovers(Target());
  EXPECT_TRUE(fs::exists(folder_ / "precious" / "inside"));
  EXPECT_TRUE(fs::is_symlink(Leftover()));
}

// Of this process or another one that lives.
TEST_F(TemporaryFileTest, WhatLivesIsNoLeftover) {
  const TemporaryFile file(Target());
  const TemporaryFolder folder(Target());
  int pipe_ends[2] = {};
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const TemporaryFile other(Target());
    const bool told = write(pipe_ends[1], "x", 1) == 1;
    while (told) pause();
    _exit(1);
  }
  char byte = 0;
  ASSERT_EQ(read(pipe_ends[0], &byte, 1), 1);
  RemoveLeftovers(Target());
  EXPECT_EQ(Names().size(), 3U);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  RemoveLeftovers(Target());
  EXPECT_EQ(Names().size(), 2U);
  EXPECT_TRUE(fs::exists(file.path()));
  EXPECT_TRUE(fs::exists(folder.path()));
}

TEST_F(TemporaryFileTest, AFolderTakesTheNameAtCommitAlone) {
  {
    const TemporaryFolder folder(Target());
    Write(folder.path() / "inside", "lost");
  }
  EXPECT_TRUE(Names().empty());
  TemporaryFolder folder(Target());
  Write(folder.path() / "inside", "kept");
  folder.Commit();
  EXPECT_EQ(Read(Target() / "inside"), "kept");
}

TEST_F(TemporaryFileTest, AFolderHasThePermissionsAskedFor) {
  const mode_t umask_before = umask(0);
  const TemporaryFolder shared(Target());
  const TemporaryFolder own(Target(), 0700);
  umask(umask_before);
  EXPECT_EQ(fs::status(shared.path()).permissions(), static_cast<fs::perms>(0777));
  EXPECT_EQ(fs::status(own.path()).permissions(), static_cast<fs::perms>(0700));
}

// Not even an empty one, which a rename would take the place of.
TEST_F(TemporaryFileTest, AFolderReplacesNothing) {
  TemporaryFolder folder(Target());
  fs::create_directories(Target());
  try {
    folder.Commit();
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), EEXIST);
  }
}

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

TEST(MachineError, SaysWhichExceptionsAreTheMachines) {
  const auto code = [](std::errc value) { return std::make_error_code(value); };
  EXPECT_TRUE(IsMachineFailure(MachineError("a.png", "cannot be read", "")));
  EXPECT_TRUE(IsMachineFailure(std::bad_alloc()));
  EXPECT_TRUE(IsMachineFailure(std::system_error(code(std::errc::no_space_on_device))));
  EXPECT_TRUE(IsMachineFailure(
      std::filesystem::filesystem_error("rename", code(std::errc::too_many_files_open))));

  EXPECT_FALSE(IsMachineFailure(UserError("a.png", "is no image", "")));
  EXPECT_FALSE(IsMachineFailure(std::bad_array_new_length())) << "a size that is no size";
  EXPECT_FALSE(IsMachineFailure(std::length_error("vector")));
  EXPECT_FALSE(IsMachineFailure(std::runtime_error("the solver blew up")));
  EXPECT_FALSE(IsMachineFailure(std::system_error(code(std::errc::invalid_argument))));
}

}  // namespace
}  // namespace rockyard::core
