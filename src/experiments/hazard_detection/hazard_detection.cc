#include "experiments/hazard_detection/hazard_detection.h"

#include <stdexcept>

namespace rockyard::experiments {

const truth::RecordSchema& HazardColumns() {
  using enum truth::ColumnRole;
  static const truth::RecordSchema kColumns{
      // Factors.
      {"height_m", "m", "height of the rock above the ground", kFactor},
      {"diameter_m", "m", "largest horizontal diameter of the rock", kFactor},
      {"lateral_offset_m", "m", "rock's centre beside the rover's course", kFactor},
      {"distance_m", "m", "rover's front to the nearest end of the rock", kFactor},
      {"wrong_place_probability", "1", "chance that a point is found in a wrong place", kFactor},
      {"sun_elevation_deg", "deg", "sun above the horizon", kFactor},
      {"laser_power_w", "W", "electrical input of each laser", kFactor},
      {"outlier_persistence", "1", "chance that a wrong point stays where it was", kFactor},
      {"rock_k_per_m2", "1/m2", "rocks of at least 1 m per square metre", kFactor},
      {"baseline_m", "m", "camera to emitter", kFactor},
      {"row", "1", "row of the array, 0 is the nearest", kFactor},
      {"plane_height_m", "m", "middle height of the plane that is measured", kFactor},
      // Bases.
      {"scenes", "1", "independent scenes", kTrials},
      {"hazards", "1", "rocks in the way that are high enough", kBase},
      {"path_m", "m", "length of the straight drives in which hazards count", kBase},
      {"points", "1", "points that a scan looks for", kBase},
      // Counts.
      {"detected_single", "1", "seen by a single scan", kCount, "scenes"},
      {"detected_double", "1", "believed under the two-scan rule", kMainCount, "scenes"},
      {"by_missing", "1", "first scan: one of the nearest two points missing", kCount, "scenes"},
      {"by_neighbour", "1", "first scan: difference of neighbours", kCount, "scenes"},
      {"by_range", "1", "first scan: range of the whole array", kCount, "scenes"},
      {"alarm_single", "1", "first scan shows a hazard", kMainCount, "scenes"},
      {"alarm_pair", "1", "first and second scan show a hazard and agree", kCount, "scenes"},
      {"alarm_believed", "1", "believed under the two-scan rule", kCount, "scenes"},
      {"missed", "1", "never charged by a believed report before contact", kMainCount, "hazards"},
      {"missed_single", "1", "never charged by any first scan before contact", kCount, "hazards"},
      {"found", "1", "points that were found", kCount, "points"},
      // Sums.
      {"scans", "1", "scans taken", kSum, "scenes"},
      {"range_m", "m", "true range from the camera", kSum, "found"},
      {"range_bias_m", "m", "measured less true range", kSum, "found"},
      {"range_error_m", "m", "measured less true range", kSquares, "found"},
      {"elevation_bias_m", "m", "measured less true elevation", kSum, "found"},
      {"elevation_error_m", "m", "measured less true elevation", kSquares, "found"},
      {"range_step_m", "m", "range that one pixel stands for", kSum, "found"},
      {"equation_2_m", "m", "the same by pitch range^2 / baseline", kSum, "found"},
      {"resolution_30cm_m", "m",
       "four times the magnitude of the range error, times (0.3 m / range)^2", kSum, "found"},
  };
  return kColumns;
}

std::unique_ptr<Experiment> MakeHazardDetection(const HazardDetectionParams& params,
                                                const trial::DriveParams& drive,
                                                const trial::Watchers& watchers) {
  switch (params.study) {
    case HazardStudy::kDetection:
      return MakeDetectionStudy(params, drive, watchers.scan);
    case HazardStudy::kApproach:
      return MakeApproachStudy(params, drive, watchers.scan);
    case HazardStudy::kFalseAlarm:
      return MakeAlarmStudy(params, drive, watchers.scan);
    case HazardStudy::kMissed:
      return MakeMissedStudy(params, drive, watchers.scan);
    case HazardStudy::kPrecision:
      return MakePrecisionStudy(params, drive, watchers.scan);
  }
  throw std::logic_error("unknown study");
}

}  // namespace rockyard::experiments
