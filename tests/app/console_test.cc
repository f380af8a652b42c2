#include "app/console.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>
#include <string>

namespace rockyard::app {
namespace {

std::size_t Widest(const std::string& text) {
  std::size_t widest = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) widest = std::max(widest, line.size());
  return widest;
}

TEST(Wrapped, BreaksBetweenWordsAndLosesNone) {
  std::string text = "  two";
  for (int i = 0; i < 60; ++i) text += " word" + std::to_string(i);
  const std::string wrapped = Wrapped(text + "\nshort\n");
  EXPECT_LE(Widest(wrapped), 100u);
  EXPECT_GT(Widest(wrapped), 90u);
  EXPECT_EQ(wrapped.find("\n      word"), wrapped.find('\n')) << "four more than its line";
  EXPECT_TRUE(wrapped.ends_with("\nshort\n"));
  std::istringstream before(text + " short");
  std::istringstream after(wrapped);
  std::string word;
  for (std::string other; before >> word;) {
    ASSERT_TRUE(after >> other);
    EXPECT_EQ(other, word);
  }
  EXPECT_FALSE(after >> word);
}

TEST(Wrapped, LeavesWhatFitsAndWhatCannotBeBroken) {
  const std::string fits = std::string(40, 'a') + "  " + std::string(58, 'b') + "\n\n  c";
  EXPECT_EQ(Wrapped(fits), fits);
  const std::string path(300, 'p');
  EXPECT_EQ(Wrapped(path), path);
  EXPECT_EQ(Wrapped("in " + path + " it is"), "in\n    " + path + "\n    it is");
  EXPECT_EQ(Wrapped("   " + path), "   " + path);
  EXPECT_EQ(Wrapped(std::string(200, ' ')), std::string(200, ' '));
  EXPECT_EQ(Wrapped(""), "");
}

// mpirun gives rank 0 a terminal although its own output goes into a file.
TEST(IsTerminal, ATerminalOfMpirunIsNone) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(master, 0);
  ASSERT_EQ(grantpt(master), 0);
  ASSERT_EQ(unlockpt(master), 0);
  std::FILE* terminal = std::fopen(ptsname(master), "r+");
  ASSERT_NE(terminal, nullptr);
  EXPECT_TRUE(IsTerminal(terminal));
  setenv("OMPI_COMM_WORLD_RANK", "0", 1);
  setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  EXPECT_FALSE(IsTerminal(terminal));
  unsetenv("OMPI_COMM_WORLD_RANK");
  unsetenv("OMPI_COMM_WORLD_SIZE");
  std::fclose(terminal);
  close(master);
}

// A stream that is no terminal, with variables of the environment as given.
class Style : public testing::Test {
 protected:
  Style() {
    for (const char* name : kNames) unsetenv(name);
  }
  ~Style() override {
    for (const char* name : kNames) unsetenv(name);
    std::fclose(file_);
  }

  report::TextStyle With(const char* name, const char* value) {
    setenv(name, value, 1);
    return StyleFor(file_);
  }

 private:
  static constexpr const char* kNames[] = {"NO_COLOR", "CLICOLOR_FORCE"};
  std::FILE* file_ = std::tmpfile();
};

TEST_F(Style, IsColouredOffTheTerminalOnlyWhereForced) {
  EXPECT_EQ(With("CLICOLOR_FORCE", ""), report::TextStyle::kPlain);
  EXPECT_EQ(With("CLICOLOR_FORCE", "0"), report::TextStyle::kPlain);
  EXPECT_EQ(With("CLICOLOR_FORCE", "1"), report::TextStyle::kColour);
}

TEST_F(Style, NoColorWins) {
  EXPECT_EQ(With("CLICOLOR_FORCE", "1"), report::TextStyle::kColour);
  EXPECT_EQ(With("NO_COLOR", ""), report::TextStyle::kColour) << "empty: not set";
  EXPECT_EQ(With("NO_COLOR", "1"), report::TextStyle::kPlain);
}

}  // namespace
}  // namespace rockyard::app
