// The numbers of a study of mobility as tables of named columns: CSV files, JSON, columns for
// Python, and what charts are drawn of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "campaign/mobility/mobility.h"
#include "core/json_value.h"

namespace rockyard::campaign {

struct MobilityColumn {
  std::string name;  // with its unit at the end
  std::string unit;  // "": none
  std::string what;
  std::vector<core::JsonValue> cells;  // texts, numbers, and null where there is nothing
};

struct MobilityTable {
  std::string name;
  std::vector<MobilityColumn> columns;

  // Returns a column that is there.
  const MobilityColumn& At(std::string_view column) const;
  std::size_t rows() const { return columns.front().cells.size(); }
  std::string Csv() const;
  // Returns an object: by column a list of its cells.
  core::JsonValue Json() const;
  // Returns a list of names, units and meanings.
  core::JsonValue Meanings() const;
};

// A row for each soil, load, way and slope: state, slip, side slip, sinkage, torques, power, and
// load, sinkage, torque and power of every wheel. NAME_low and NAME_high are the band (BandOver).
MobilityTable SlopeTable(const MobilityResult& result);
// A row for each soil, load and slip of a wheel under its mean load.
MobilityTable WheelTable(const MobilityResult& result);
// A row for each soil and load: steepest slopes with their bands, highest step.
MobilityTable LimitTable(const MobilityResult& result);

}  // namespace rockyard::campaign
