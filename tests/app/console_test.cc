#include "app/console.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <sstream>

#include "app/progress_line.h"

namespace rockyard::app {
namespace {

using Clock = std::chrono::steady_clock;
using testing::HasSubstr;
using testing::Not;

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

TEST(ProgressText, RatesOfThePrefixAlone) {
  batch::Progress progress{.planned = 300,
                           .finished = 120,
                           .finished_before = 20,
                           .faults = 3,
                           .prefix = {.trials = 101, .faults = 1, .declared_successes = 90},
                           .elapsed_s = 25.0};
  EXPECT_EQ(ProgressText(progress),
            "  120/300 done, 4/s, ETA 0:45, declared success 90.0 % (95 %: 82.6 .. 94.5 of 100), "
            "faults 3");
}

TEST(ProgressText, SaysNothingThatItDoesNotKnow) {
  const std::string text = ProgressText({.planned = 10});
  EXPECT_THAT(text, HasSubstr("0/10 done"));
  EXPECT_THAT(text, Not(HasSubstr("ETA")));
  EXPECT_THAT(text, Not(HasSubstr("success")));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(ProgressText, SaysHowFarAStoppingRuleIs) {
  const batch::Progress progress{.planned = 30000,
                                 .finished = 700,
                                 .cells = 3,
                                 .cells_ended = 1,
                                 .widest_half_width = 0.0812,
                                 .target_half_width = 0.02};
  EXPECT_EQ(ProgressText(progress),
            "  700/<=30000 done, 1/3 cells ended, half-width 8.12 % for 2.00 %, faults 0");
}

TEST(ProgressText, LongRuns) {
  const batch::Progress progress{.planned = 1000000, .finished = 100, .elapsed_s = 100.0};
  EXPECT_THAT(ProgressText(progress), HasSubstr("ETA 277:45:00"));
}

TEST(ProgressLine, PlainLinesOnAFile) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  ProgressLine line(file);
  for (int i = 0; i <= 100; ++i) {
    line.Show({.planned = 100, .finished = i, .elapsed_s = 0.1 * i});
  }
  line.Finish({.planned = 100, .finished = 100, .elapsed_s = 10.1});
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  std::fclose(file);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);  // at 0, 5 and 10 s, and the end
}

// Of what is done while `work` takes that long; standard error of a test is no terminal.
std::string Told(std::chrono::milliseconds work) {
  testing::internal::CaptureStderr();
  {
    const BusyLine busy("counting rocks");
    std::this_thread::sleep_for(work);
  }
  return testing::internal::GetCapturedStderr();
}

// On a busy machine a line comes later, and there may be more of them.
TEST(BusyLine, TellsOfLongWorkAndEndsWithIt) {
  EXPECT_THAT(Told(std::chrono::milliseconds(6000)),
              testing::MatchesRegex("(  counting rocks: [0-9]+ s\n)+"));
}

// Where the end of each work waited for the next line, this would take a quarter of an hour.
TEST(BusyLine, IsSilentOverShortWorkAndHoldsNobody) {
  const Clock::time_point begin = Clock::now();
  for (int i = 0; i < 200; ++i) {
    const Clock::time_point work = Clock::now();
    const std::string told = Told(std::chrono::milliseconds(1));
    if (Clock::now() - work < std::chrono::seconds(5)) {
      EXPECT_EQ(told, "");
    }
  }
  EXPECT_LT(Clock::now() - begin, std::chrono::minutes(10));
}

}  // namespace
}  // namespace rockyard::app
