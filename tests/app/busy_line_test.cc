#include "app/busy_line.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace rockyard::app {
namespace {

// Of what is done while `work` takes that long; standard error of a test is no terminal.
std::string Told(std::chrono::milliseconds work) {
  testing::internal::CaptureStderr();
  {
    const BusyLine busy("counting rocks");
    std::this_thread::sleep_for(work);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(BusyLine, TellsOfLongWorkAndEndsWithIt) {
  EXPECT_EQ(Told(std::chrono::milliseconds(5300)), "  counting rocks: 5 s\n");
}

TEST(BusyLine, IsSilentOverShortWork) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(Told(std::chrono::milliseconds(10)), "");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

}  // namespace
}  // namespace rockyard::app
