// Schemas of measurements, for tests that need columns with roles and no experiment.
#pragma once

#include "truth/measurement_record.h"

namespace rockyard::truth {

// The number of the cell, then the columns of these names, which must be among the ones below.
inline RecordSchema MeasuredSchema(std::span<const std::string_view> names) {
  using enum ColumnRole;
  static const RecordSchema kKnown{{"height_m", "m", "height of a rock", kFactor},
                                   {"diameter_m", "m", "diameter of a rock", kFactor},
                                   {"distance_m", "m", "distance to a rock", kFactor},
                                   {"scenes", "1", "independent scenes", kTrials},
                                   {"hazards", "1", "rocks in the way", kBase},
                                   {"points", "1", "points looked for", kBase},
                                   {"detected_single", "1", "seen once", kCount, "scenes"},
                                   {"detected_double", "1", "seen twice", kMainCount, "scenes"},
                                   {"alarm_single", "1", "alarms", kMainCount, "scenes"},
                                   {"missed", "1", "never seen", kMainCount, "hazards"},
                                   {"found", "1", "points found", kCount, "points"},
                                   {"scans", "1", "scans taken", kSum, "scenes"},
                                   {"range_error_m", "m", "error", kSquares, "found"}};
  return MeasurementSchema(kKnown, names);
}

}  // namespace rockyard::truth
