// Hazards believed and begun: scripted reports, and drives at rocks on level sand.
#include "trial/hazard_counter.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <vector>

#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

HazardCounter CountOf(std::initializer_list<bool> reports) {
  HazardCounter counter;
  for (const bool believed : reports) counter.Observe(believed);
  return counter;
}

TEST(HazardCounterTest, AHazardBeginsOnceForEachRunOfReports) {
  EXPECT_EQ(CountOf({}).begun(), 0);
  EXPECT_EQ(CountOf({false, false}).begun(), 0);
  EXPECT_EQ(CountOf({true}).begun(), 1);
  EXPECT_EQ(CountOf({false, true, true, true, false}).begun(), 1);
  EXPECT_EQ(CountOf({true, true, false, true, false, false, true}).begun(), 3);
}

TEST(HazardCounterTest, EveryReportIsBelieved) {
  EXPECT_EQ(CountOf({}).believed(), 0);
  EXPECT_EQ(CountOf({true, true, false, true, false, false, true}).believed(), 4);
}

// A drive over level sand at high rocks on the straight line to the goal.
TracedTrial DriveAtRocks(std::uint32_t index) {
  return RunTraced(
      Pathfinder("level_sand",
                 {"rover.fidelity=quasi_static", "perception.hazard.enabled=true",
                  "terrain.rocks.kind=listed", "terrain.rocks.listed.x_m=[2.5, 5.5]",
                  "terrain.rocks.listed.y_m=[0, 0]", "terrain.rocks.listed.diameter_m=[0.3, 0.3]",
                  "terrain.rocks.listed.height_m=[0.3, 0.3]"}),
      index);
}

// Whether each look of a trace believed in a hazard. A look ends with the last of its scans.
std::vector<bool> LooksOf(const truth::Trace& trace) {
  std::set<double> hazard_times_s;
  for (const truth::TraceEvent& event : EventsOf(trace, "hazard")) {
    hazard_times_s.insert(event.time_s);
  }
  std::map<std::size_t, double> looks_s;  // end of each look, by the ticks before it
  for (const truth::TraceRest& rest : trace.rests) {
    if (rest.sample.activity == "scan") looks_s[rest.samples_before] = rest.sample.time_s;
  }
  std::vector<bool> believed;
  for (const auto& [samples, time_s] : looks_s) believed.push_back(hazard_times_s.contains(time_s));
  return believed;
}

TEST(HazardsBegunTest, AreReportsAfterALookWithout) {
  for (const std::uint32_t index : {0u, 1u, 2u}) {
    const TracedTrial trial = DriveAtRocks(index);
    double believed = 0.0;
    double begun = 0.0;
    bool before = false;
    for (const bool now : LooksOf(trial.trace)) {
      if (now) ++believed;
      if (now && !before) ++begun;
      before = now;
    }
    EXPECT_GE(begun, 2.0);
    EXPECT_GT(believed, begun);
    EXPECT_EQ(trial.result.record.hazards_believed, believed);
    EXPECT_EQ(trial.result.record.hazards_begun, begun);
  }
}

}  // namespace
}  // namespace rockyard::trial
