#include "experiments/visual_motion/columns.h"

#include <string>

namespace rockyard::experiments {
namespace {

using enum truth::ColumnRole;

truth::RecordSchema MakeVisualColumns() {
  truth::RecordSchema columns{
      {"step_m", "m", "length of the way", kFactor},
      {"turn_deg", "deg", "turn, to either side", kFactor},
      {"soil_graininess", "1", "of sensors.look", kFactor},
      {"sun_elevation_deg", "deg", "of sensors.sun", kFactor},
      {"baseline_m", "m", "of sensors.stereo", kFactor},
      {"steps", "1", "motions, each at a place of its own", kTrials},
      {"found", "1", "of these, with a motion", kMainCount, "steps"},
      {"wrong", "1",
       "of these, off by more than 6 standard deviations of their own statement and more than 5 cm "
       "or 2 deg",
       kCount, "found"},
      {"matches", "1", "features of two left images that look alike", kSum, "steps"},
      {"points", "1", "of these, with a place at both moments", kSum, "steps"},
      {"consistent", "1", "of these, moved as one", kSum, "steps"},
      {"nees", "1",
       "squared error in units of the stated covariance: 6 on average where that is right", kSum,
       "found"},
      {"position_m", "m", "length of the error of the way", kSum, "found"},
  };
  const auto add = [&](const std::string& name, const std::string& unit,
                       const std::string& meaning) {
    columns.push_back({name + "_bias_" + unit, unit, meaning, kSum, "found"});
    columns.push_back({name + "_error_" + unit, unit, meaning, kSquares, "found"});
  };
  add("along", "m", "measured less true way, along x of the first rover frame");
  add("across", "m", "along y");
  add("up", "m", "along z");
  add("roll", "deg", "measured less true turn, about x of the first rover frame");
  add("pitch", "deg", "about y");
  add("heading", "deg", "about z");
  return columns;
}

}  // namespace

const truth::RecordSchema& VisualMotionColumns() {
  static const truth::RecordSchema kColumns = MakeVisualColumns();
  return kColumns;
}

}  // namespace rockyard::experiments
