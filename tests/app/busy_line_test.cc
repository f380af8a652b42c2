#include "app/busy_line.h"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

namespace rockyard::app {
namespace {

using Clock = std::chrono::steady_clock;

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
