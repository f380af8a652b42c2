// Records of experiments that measure a sensor rather than drive: counts and sums over the scenes
// of one cell of a table, with the values of the factors that name the cell.
//
// Records of one cell add up column by column, as the role of each column says, so that a run may
// hold any number of scenes and any number of runs may share a cell.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "truth/record.h"

namespace rockyard::truth {

// First column of every such record: the number of the cell. Stored runs are told from drives by
// this name in this place.
inline constexpr std::string_view kCellColumn = "cell";

// Whether records of this schema are measurements, for which no drive succeeds or fails.
inline bool IsMeasurement(const RecordSchema& schema) {
  return !schema.empty() && schema.front().name == kCellColumn;
}

// The column of that name; null where the schema has none.
inline const ValueInfo* FindColumn(const RecordSchema& schema, std::string_view name) {
  const auto found = std::find_if(schema.begin(), schema.end(),
                                  [&](const ValueInfo& column) { return column.name == name; });
  return found == schema.end() ? nullptr : &*found;
}

// The number of the cell, then those columns of `known` that `names` lists, in the order of
// `names`. All of them must be known.
inline RecordSchema MeasurementSchema(const RecordSchema& known,
                                      std::span<const std::string_view> names) {
  RecordSchema schema{{std::string(kCellColumn), "1", "number of the cell"}};
  for (const std::string_view name : names) schema.push_back(*FindColumn(known, name));
  return schema;
}

// The same with all columns of `known`.
inline RecordSchema MeasurementSchema(const RecordSchema& known) {
  RecordSchema schema = MeasurementSchema(known, {});
  schema.insert(schema.end(), known.begin(), known.end());
  return schema;
}

constexpr bool IsBase(ColumnRole role) {
  return role == ColumnRole::kTrials || role == ColumnRole::kBase;
}

constexpr bool IsCount(ColumnRole role) {
  return role == ColumnRole::kCount || role == ColumnRole::kMainCount;
}

}  // namespace rockyard::truth
