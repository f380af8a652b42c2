// What a scenario of driving without stopping is refused for, and with what words.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/refusals.h"
#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

using Overrides = std::vector<std::string>;

std::vector<core::Problem> ProblemsOf(const std::string& name, const Overrides& overrides) {
  const auto folder = std::filesystem::path(ROCKYARD_SOURCE_DIR) / "scenarios/continuous";
  return core::ProblemsIn([&] { LoadScenario(folder / (name + ".json"), overrides); });
}

struct Case {
  std::string scenario;
  Overrides beyond;
  std::string path;
  std::string reason;
};

TEST(ContinuousChecks, WhatCannotBeDrivenIsRefusedWithPathReasonAndSuggestion) {
  const std::string cycle = "navigation.gestalt.continuous.cycle";
  const std::vector<Case> cases{
      {"csod",
       {"clock.overlap.imaging=false", "clock.overlap.computing=false"},
       cycle,
       "stop for each look"},
      {"csad", {"clock.overlap.steering=false"}, cycle, "stand to steer"},
      {"csad",
       {"navigation.gestalt.continuous.motion_m=3.5"},
       "navigation.gestalt.continuous.motion_m",
       "blindly past what it judged"},
      {"csad",
       {"navigation.gestalt.splines.length_m=0.5", "navigation.gestalt.splines.waypoint_m=0.5"},
       "navigation.gestalt.continuous.motion_m",
       "beyond the end of the splines"},
      {"csad",
       {"navigation.gestalt.splines.max_curvature_rate_per_m_s=0.001"},
       "navigation.gestalt.splines.max_curvature_rate_per_m_s",
       "leaves no spline"},
      {"csad", {"clock.compute.acquisition_s=-1"}, "clock.compute.acquisition_s", ""},
      {"csad",
       {"navigation.gestalt.speed.min_speed_share=1.5"},
       "navigation.gestalt.speed.min_speed_share",
       ""},
      {"csod",
       {"navigation.gestalt.continuous.replan_fraction=0"},
       "navigation.gestalt.continuous.replan_fraction",
       ""},
      {"csad",
       {"navigation.gestalt.splines.waypoint_m=3.5"},
       "navigation.gestalt.splines.waypoint_m",
       "beyond the end"},
  };
  for (const Case& tested : cases) {
    SCOPED_TRACE(tested.beyond.front());
    const std::vector<core::Problem> found = ProblemsOf(tested.scenario, tested.beyond);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].path, tested.path);
    EXPECT_NE(found[0].reason.find(tested.reason), std::string::npos) << found[0].reason;
    EXPECT_FALSE(found[0].suggestion.empty());
  }
}

// What is not used misleads nobody.
TEST(ContinuousChecks, WhatIsNotInUseIsNotAsked) {
  for (const char* name : {"stop_and_look", "csod", "csad"}) {
    EXPECT_TRUE(ProblemsOf(name, {}).empty()) << name;
  }
  EXPECT_TRUE(
      ProblemsOf("stop_and_look", {"clock.overlap.imaging=false", "clock.overlap.computing=false"})
          .empty());
  EXPECT_TRUE(ProblemsOf("stop_and_look", {"navigation.gestalt.continuous.motion_m=3.5"}).empty());
  EXPECT_TRUE(ProblemsOf("csod", {"clock.overlap.imaging=false"}).empty());
  EXPECT_TRUE(ProblemsOf("csod", {"navigation.gestalt.splines.length_m=0.5",
                                  "navigation.gestalt.splines.waypoint_m=0.5"})
                  .empty());
}

}  // namespace
}  // namespace rockyard::scenario
