// Small scenarios of the experiment "hazard_detection" for tests.
#pragma once

#include <string>
#include <vector>

#include "scenario/load.h"
#include "statistics/drive_summary.h"
#include "truth/record.h"

namespace rockyard::experiments {

// A shipped scenario with changes.
inline scenario::Scenario HazardScenario(const std::string& name,
                                         std::vector<std::string> overrides = {}) {
  return scenario::LoadScenario(
      std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/hazard_detection/" + name + ".json",
      overrides);
}

// A value of a record by the name of its column.
inline double ValueOf(const truth::RecordSchema& schema, const truth::Record& record,
                      const std::string& name) {
  return record.values.at(statistics::ColumnIndex(schema, name).value());
}

}  // namespace rockyard::experiments
