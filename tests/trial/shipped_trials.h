// Trials of the scenarios of Pathfinder and GESTALT for the tests of the closed loop.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

#include "scenario/shipped.h"
#include "trial/run_trial.h"

namespace rockyard::trial {

using Overrides = std::vector<std::string>;  // "PATH=VALUE"

inline Overrides operator+(Overrides a, const Overrides& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline DriveParams Pathfinder(const std::string& name, const Overrides& overrides = {}) {
  return scenario::Shipped("pathfinder/" + name, overrides).drive;
}

inline DriveParams Gestalt(const std::string& name, const Overrides& overrides = {}) {
  return scenario::Shipped("gestalt/" + name, overrides).drive;
}

// 3 m of empty sand, without errors of sensors.
inline const Overrides kShortAndEmpty = {"terrain.rocks.kind=none", "course.goal_x_m=3"};
inline const Overrides kTrueEncoders = {"sensors.encoders.distance_variance_m2_per_m=0",
                                        "sensors.encoders.physics_variance_m2_per_m=0",
                                        "sensors.gyro.heading_variance_deg2_per_m=0"};

// A trial with its course over time.
struct TracedTrial {
  DriveResult result;
  truth::Trace trace;
};

inline TracedTrial RunTraced(const DriveParams& drive, std::uint32_t index,
                             std::uint64_t seed = 1) {
  TracedTrial trial;
  trial.result = RunTrial(drive, {seed, index}, &trial.trace);
  return trial;
}

// The trials 0 to count - 1 of seed 1.
inline std::vector<DriveResult> RunTrials(const DriveParams& drive, std::uint32_t count) {
  std::vector<DriveResult> results;
  for (std::uint32_t i = 0; i < count; ++i) results.push_back(RunTrial(drive, {1, i}));
  return results;
}

// In the order of time.
inline std::vector<truth::TraceEvent> EventsOf(const truth::Trace& trace, std::string_view kind) {
  std::vector<truth::TraceEvent> events;
  for (const truth::TraceEvent& event : trace.events) {
    if (event.kind == kind) events.push_back(event);
  }
  return events;
}

// Names of the columns whose bits differ, and "outcome" and "detail" where these do.
inline std::vector<std::string> Differences(const DriveResult& a, const DriveResult& b) {
  std::vector<std::string> names;
  if (a.outcome != b.outcome) names.emplace_back("outcome");
  if (a.detail != b.detail) names.emplace_back("detail");
  for (const truth::DriveColumn& column : truth::kDriveColumns) {
    if (std::bit_cast<std::uint64_t>(a.record.*column.member) !=
        std::bit_cast<std::uint64_t>(b.record.*column.member)) {
      names.emplace_back(column.name);
    }
  }
  return names;
}

}  // namespace rockyard::trial
