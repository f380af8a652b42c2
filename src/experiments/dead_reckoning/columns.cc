#include "experiments/dead_reckoning/columns.h"

#include <string>

namespace rockyard::experiments {
namespace {

using enum truth::ColumnRole;

void AddError(const std::string& name, const std::string& unit, const std::string& meaning,
              truth::RecordSchema& columns) {
  columns.push_back({name + "_bias_" + unit, unit, meaning, kSum, "walks"});
  columns.push_back({name + "_error_" + unit, unit, meaning, kSquares, "walks"});
  columns.push_back({name + "_deviation_" + unit, unit,
                     "standard deviation within the run, times its walks: " + meaning, kSum,
                     "walks"});
}

truth::RecordSchema MakeWalkColumns() {
  truth::RecordSchema columns{
      {"distance_m", "m", "length of a walk; it has the nearest number of whole steps", kFactor},
      {"heading_variance_deg2_per_m", "deg2/m", "of the heading, in driving", kFactor},
      {"distance_variance_m2_per_m", "m2/m", "of the distance", kFactor},
      {"scale_deviation", "1", "of a scale error that a walk keeps", kFactor},
      {"rest_s", "s", "time at rest after a step, in which the heading's noise goes on", kFactor},
      {"walks", "1", "walks, independent of one another", kTrials},
      {"way_m", "m", "true way of all walks", kBase},
      {"within_reach", "1", "walks that end within reach_m of where the rover believes to be",
       kMainCount, "walks"},
  };
  AddError("along", "m", "believed less true place, in the direction of the start", columns);
  AddError("across", "m", "believed less true place, to the left of it", columns);
  AddError("heading", "deg", "believed less true heading, within half a turn", columns);
  AddError("distance", "m", "odometer less true distance", columns);
  return columns;
}

}  // namespace

const truth::RecordSchema& DeadReckoningColumns() {
  static const truth::RecordSchema kColumns = MakeWalkColumns();
  return kColumns;
}

}  // namespace rockyard::experiments
