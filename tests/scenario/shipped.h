// The scenarios that come with the program.
#pragma once

#include "scenario/load.h"

namespace rockyard::scenario {

// By its path below scenarios/ without ".json", with "PATH=VALUE" overrides.
inline Scenario Shipped(const std::string& name, const std::vector<std::string>& overrides = {},
                        const Scenario& defaults = {}) {
  const std::string path = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/" + name + ".json";
  return LoadScenario(path, overrides, defaults);
}

}  // namespace rockyard::scenario
