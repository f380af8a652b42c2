#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <set>
#include <string>
#include <system_error>

#include "core/files.h"
#include "core/test_folder.h"

namespace rockyard::core {
namespace {

namespace fs = std::filesystem;

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

}  // namespace
}  // namespace rockyard::core
