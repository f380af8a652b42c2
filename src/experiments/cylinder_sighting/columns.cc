#include "experiments/cylinder_sighting/columns.h"

#include <string>

#include "experiments/cylinder_sighting/sighting_sums.h"

namespace rockyard::experiments {
namespace {

using enum truth::ColumnRole;

void AddFinder(const std::string& finder, const std::string& called, truth::ColumnRole found_role,
               truth::RecordSchema& columns) {
  const std::string found = finder + "_found";
  const std::string right = finder + "_right";
  columns.push_back({found, "1", "of these, with a pose by " + called, found_role, "measurements"});
  columns.push_back({finder + "_wrong", "1",
                     "of these, off by more than 3 of its own standard deviations and more than "
                     "10 deg or 10 %, or without a cylinder in view",
                     kCount, found});
  columns.push_back({right, "1", "of these, not wrong", kCount, found});
  for (std::size_t i = 1; i < kCylinderMisses; ++i) {
    const std::string reason(core::EnumNames<vision::CylinderMiss>::kNames[i]);
    std::string name = finder + "_";
    name += reason;
    columns.push_back(
        {name, "1", "without a pose, for the reason " + reason, kCount, "measurements"});
  }
  const auto error = [&](const std::string& name, const std::string& suffix,
                         const std::string& unit, const std::string& meaning,
                         const std::string& of) {
    columns.push_back({finder + "_" + name + "_bias" + suffix, unit, meaning, kSum, of});
    columns.push_back({finder + "_" + name + "_error" + suffix, unit, meaning, kSquares, of});
  };
  error("orientation", "_deg", "deg", "measured less true orientation, wrong ones too", found);
  error("stereo", "", "1", "depth by stereo over the true one, less 1, wrong ones too", found);
  error("size", "", "1", "depth by size over the true one, less 1, wrong ones too", found);
  error("right_orientation", "_deg", "deg", "measured less true orientation", right);
  error("right_range", "", "1", "range along the ground over the true one, less 1", right);
  error("right_bearing", "_mrad", "mrad", "measured less true bearing", right);
  columns.push_back({finder + "_nees", "1",
                     "squared error of place and orientation in units of the stated covariance: 4 "
                     "on average where that is right",
                     kSum, right});
}

truth::RecordSchema MakeSightingColumns() {
  truth::RecordSchema columns{
      {"distance_m", "m", "from the cameras' centre of rotation along the ground", kFactor},
      {"orientation_deg", "deg", "theta: azimuth of the cameras in the cylinder's frame", kFactor},
      {"sun_elevation_deg", "deg", "of picture.light", kFactor},
      {"clutter_level", "1", "factor of the numbers of picture.clutter", kFactor},
      {"third_colour", "1", "0 orange, 1 green", kFactor},
      {"measurements", "1", "pairs of images", kTrials},
  };
  AddFinder("published", "the published finder", kMainCount, columns);
  AddFinder("robust", "rockyard's own finder", kCount, columns);
  return columns;
}

}  // namespace

const truth::RecordSchema& CylinderSightingColumns() {
  static const truth::RecordSchema kColumns = MakeSightingColumns();
  return kColumns;
}

}  // namespace rockyard::experiments
