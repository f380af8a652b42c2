// Records of experiments that measure a sensor rather than drive: counts and sums over the scenes
// of one cell of a table, with the values of the factors that name the cell. These experiments
// write them, cell summaries add them up, and reports and comparisons tell them from drives.
//
// Records of one cell add up column by column, as the role of each column says, so that a record
// may hold any number of scenes and any number of records may share a cell.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "truth/record.h"

namespace rockyard::truth {

// The first column of every such record: the number of the cell. Must stay: IsMeasurement tells
// stored runs from drives by this name in this place.
inline constexpr std::string_view kCellColumn = "cell";

// Returns whether records of this schema are measurements, which neither succeed nor fail.
inline bool IsMeasurement(const RecordSchema& schema) {
  return !schema.empty() && schema.front().name == kCellColumn;
}

// Returns the column of that name; null where the schema has none.
inline const ValueInfo* FindColumn(const RecordSchema& schema, std::string_view name) {
  const auto found = std::find_if(schema.begin(), schema.end(),
                                  [&](const ValueInfo& column) { return column.name == name; });
  return found == schema.end() ? nullptr : &*found;
}

// Returns the schema of the cell's number and those columns of `known` that `names` lists, in the
// order of `names`. `known` must have all of them.
inline RecordSchema MeasurementSchema(const RecordSchema& known,
                                      std::span<const std::string_view> names) {
  RecordSchema schema{{std::string(kCellColumn), "1", "number of the cell"}};
  for (const std::string_view name : names) schema.push_back(*FindColumn(known, name));
  return schema;
}

// Returns the schema of the cell's number and all columns of `known`.
inline RecordSchema MeasurementSchema(const RecordSchema& known) {
  RecordSchema schema = MeasurementSchema(known, {});
  schema.insert(schema.end(), known.begin(), known.end());
  return schema;
}

// Returns whether a column counts what rates are shares of.
constexpr bool IsBase(ColumnRole role) {
  return role == ColumnRole::kTrials || role == ColumnRole::kBase;
}

// Returns whether a column is a count of which a base makes a rate.
constexpr bool IsCount(ColumnRole role) {
  return role == ColumnRole::kCount || role == ColumnRole::kMainCount;
}

}  // namespace rockyard::truth
