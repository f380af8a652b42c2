// Records of experiments that measure a sensor rather than drive: counts and sums over the scenes
// of one cell of a table, with the values of the factors that name the cell.
//
// Records of one cell add up column by column, so that a run may hold any number of scenes and any
// number of runs may share a cell.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "truth/record.h"

namespace rockyard::truth {

enum class ColumnRole {
  kFactor,   // constant within a cell
  kBase,     // how often something could have happened
  kCount,    // how often it did: a rate of the base `of`
  kSum,      // adds up to a mean per `of`
  kSquares,  // squares add up to a root mean square per `of`
};

struct MeasuredColumn {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  ColumnRole role = ColumnRole::kFactor;
  std::string_view of = {};  // name of the base
};

// First column of every such record: the number of the cell.
inline constexpr std::string_view kCellColumn = "cell";

inline constexpr std::array kMeasuredColumns = {
    MeasuredColumn{kCellColumn, "1", "number of the cell"},
    // Factors.
    MeasuredColumn{"height_m", "m", "height of the rock above the ground"},
    MeasuredColumn{"diameter_m", "m", "largest horizontal diameter of the rock"},
    MeasuredColumn{"lateral_offset_m", "m", "rock's centre beside the rover's course"},
    MeasuredColumn{"distance_m", "m", "rover's front to the nearest end of the rock"},
    MeasuredColumn{"wrong_place_probability", "1", "chance that a point is found in a wrong place"},
    MeasuredColumn{"sun_elevation_deg", "deg", "sun above the horizon"},
    MeasuredColumn{"laser_power_w", "W", "electrical input of each laser"},
    MeasuredColumn{"outlier_persistence", "1", "chance that a wrong point stays where it was"},
    MeasuredColumn{"rock_k_per_m2", "1/m2", "rocks of at least 1 m per square metre"},
    MeasuredColumn{"baseline_m", "m", "camera to emitter"},
    MeasuredColumn{"row", "1", "row of the array, 0 is the nearest"},
    MeasuredColumn{"plane_height_m", "m", "middle height of the plane that is measured"},
    // Bases.
    MeasuredColumn{"scenes", "1", "independent scenes", ColumnRole::kBase},
    MeasuredColumn{"hazards", "1", "rocks in the way that are high enough", ColumnRole::kBase},
    MeasuredColumn{"path_m", "m", "length of the straight drives in which hazards count",
                   ColumnRole::kBase},
    MeasuredColumn{"points", "1", "points that a scan looks for", ColumnRole::kBase},
    // Counts.
    MeasuredColumn{"detected_single", "1", "seen by a single scan", ColumnRole::kCount, "scenes"},
    MeasuredColumn{"detected_double", "1", "believed under the two-scan rule", ColumnRole::kCount,
                   "scenes"},
    MeasuredColumn{"by_missing", "1", "first scan: one of the nearest two points missing",
                   ColumnRole::kCount, "scenes"},
    MeasuredColumn{"by_neighbour", "1", "first scan: difference of neighbours", ColumnRole::kCount,
                   "scenes"},
    MeasuredColumn{"by_range", "1", "first scan: range of the whole array", ColumnRole::kCount,
                   "scenes"},
    MeasuredColumn{"alarm_single", "1", "first scan shows a hazard", ColumnRole::kCount, "scenes"},
    MeasuredColumn{"alarm_pair", "1", "first and second scan show a hazard and agree",
                   ColumnRole::kCount, "scenes"},
    MeasuredColumn{"alarm_believed", "1", "believed under the two-scan rule", ColumnRole::kCount,
                   "scenes"},
    MeasuredColumn{"missed", "1", "never charged by a believed report before contact",
                   ColumnRole::kCount, "hazards"},
    MeasuredColumn{"missed_single", "1", "never charged by any first scan before contact",
                   ColumnRole::kCount, "hazards"},
    MeasuredColumn{"found", "1", "points that were found", ColumnRole::kCount, "points"},
    // Sums.
    MeasuredColumn{"scans", "1", "scans taken", ColumnRole::kSum, "scenes"},
    MeasuredColumn{"range_m", "m", "true range from the camera", ColumnRole::kSum, "found"},
    MeasuredColumn{"range_bias_m", "m", "measured less true range", ColumnRole::kSum, "found"},
    MeasuredColumn{"range_error_m", "m", "measured less true range", ColumnRole::kSquares, "found"},
    MeasuredColumn{"elevation_bias_m", "m", "measured less true elevation", ColumnRole::kSum,
                   "found"},
    MeasuredColumn{"elevation_error_m", "m", "measured less true elevation", ColumnRole::kSquares,
                   "found"},
    MeasuredColumn{"range_step_m", "m", "range that one pixel stands for", ColumnRole::kSum,
                   "found"},
    MeasuredColumn{"equation_2_m", "m", "the same by pitch range^2 / baseline", ColumnRole::kSum,
                   "found"},
    MeasuredColumn{"resolution_30cm_m", "m",
                   "four times the magnitude of the range error, times (0.3 m / range)^2",
                   ColumnRole::kSum, "found"},
};

// Null where no such column is known.
inline const MeasuredColumn* FindMeasuredColumn(std::string_view name) {
  const auto* found = std::find_if(kMeasuredColumns.begin(), kMeasuredColumns.end(),
                                   [&](const MeasuredColumn& c) { return c.name == name; });
  return found == kMeasuredColumns.end() ? nullptr : found;
}

// A schema of known columns. `names` must all be known.
inline RecordSchema MeasurementSchema(std::span<const std::string_view> names) {
  RecordSchema schema;
  for (const std::string_view name : names) {
    const MeasuredColumn& column = *FindMeasuredColumn(name);
    schema.push_back(
        {std::string(column.name), std::string(column.unit), std::string(column.meaning)});
  }
  return schema;
}

// Whether records of this schema are measurements, for which no drive succeeds or fails.
inline bool IsMeasurement(const RecordSchema& schema) {
  return !schema.empty() && schema.front().name == kCellColumn;
}

}  // namespace rockyard::truth
