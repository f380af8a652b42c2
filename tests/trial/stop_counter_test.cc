#include "trial/stop_counter.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace rockyard::trial {
namespace {

std::int64_t StopsOf(std::initializer_list<bool> moving) {
  StopCounter counter;
  for (const bool each : moving) counter.Observe(each);
  return counter.stops();
}

TEST(StopCounterTest, CountsEndsOfMotion) {
  EXPECT_EQ(StopsOf({}), 0);
  EXPECT_EQ(StopsOf({false, false}), 0);
  EXPECT_EQ(StopsOf({true, true, false, false, true, false}), 2);
}

TEST(StopCounterTest, TheEndStopsARoverThatMoves) { EXPECT_EQ(StopsOf({true, false, true}), 2); }

}  // namespace
}  // namespace rockyard::trial
