// What the tests of the replay page's data share: a trial of a scenario file, and its data.
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "campaign/replay_page.h"
#include "scenario/shipped.h"

namespace rockyard::campaign {

using Json = nlohmann::json;

inline TrialSource SourceOf(const std::string& scenario,
                            const std::vector<std::string>& overrides = {}) {
  TrialSource source;
  source.scenario = scenario::Shipped(scenario, overrides);
  source.seed = static_cast<std::uint64_t>(source.scenario.seed);
  source.request = scenario;
  return source;
}

inline Json PayloadOf(const TrialSource& source, std::uint64_t trial) {
  return Json::parse(ReplayPayload(ReplayTrial(source, trial)));
}

inline double ValueOf(const Json& payload, const std::string& name) {
  for (const Json& column : payload["record"]) {
    if (column["name"] == name) return column["value"].get<double>();
  }
  return std::numeric_limits<double>::quiet_NaN();
}

inline std::vector<double> Channel(const Json& payload, const char* name) {
  return payload["motion"][name].get<std::vector<double>>();
}

}  // namespace rockyard::campaign
