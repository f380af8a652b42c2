// What the views of one cell add up to, for each finder.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/fields.h"
#include "math/pose.h"
#include "vision/cylinder/cylinder_sighting.h"

namespace rockyard::experiments {

// Sum and sum of squares of an error.
struct SightingErrorSums {
  double sum = 0.0;
  double squares = 0.0;

  void Add(double error) {
    sum += error;
    squares += error * error;
  }
};

inline constexpr std::size_t kCylinderMisses = core::EnumNames<vision::CylinderMiss>::kNames.size();

struct FinderSums {
  double found = 0.0;
  double wrong = 0.0;  // of these
  double right = 0.0;  // found and not wrong
  // Of what was not found, by reason; the first is of none.
  std::array<double, kCylinderMisses> misses{};
  // Of what was found, wrong or not.
  SightingErrorSums orientation_deg;
  SightingErrorSums stereo;
  SightingErrorSums size;
  // Of what was right.
  SightingErrorSums right_orientation_deg;
  SightingErrorSums right_range;
  SightingErrorSums right_bearing_mrad;
  double nees = 0.0;
};

struct SightingSums {
  double measurements = 0.0;
  FinderSums published;
  FinderSums robust;
};

// Calls f(name, value) for every column of a finder, in the order of the records.
template <typename F>
void ForEachFinderSum(const std::string& finder, const FinderSums& s, F&& f) {
  const auto error = [&](const std::string& name, const std::string& unit,
                         const SightingErrorSums& sums) {
    f(finder + "_" + name + "_bias" + unit, sums.sum);
    f(finder + "_" + name + "_error" + unit, sums.squares);
  };
  f(finder + "_found", s.found);
  f(finder + "_wrong", s.wrong);
  f(finder + "_right", s.right);
  for (std::size_t i = 1; i < kCylinderMisses; ++i) {
    f(finder + "_" + std::string(core::EnumNames<vision::CylinderMiss>::kNames[i]), s.misses[i]);
  }
  error("orientation", "_deg", s.orientation_deg);
  error("stereo", "", s.stereo);
  error("size", "", s.size);
  error("right_orientation", "_deg", s.right_orientation_deg);
  error("right_range", "", s.right_range);
  error("right_bearing", "_mrad", s.right_bearing_mrad);
  f(finder + "_nees", s.nees);
}

template <typename F>
void ForEachSum(const SightingSums& s, F&& f) {
  f("measurements", s.measurements);
  ForEachFinderSum("published", s.published, f);
  ForEachFinderSum("robust", s.robust, f);
}

// What is true of a view. L as in rendering/cylinder/cylinder_scene.h.
struct CylinderTruth {
  bool present = true;
  double orientation_rad = 0.0;
  math::Vector3 p_LT_L = math::Vector3::Zero();
  double depth_m = 0.0;  // before the left camera along its axis
};

// Adds one finding to the sums. A pose is wrong if its orientation is off by more than three of its
// own standard deviations and more than 10 deg, or its range along the ground, from the origin of
// L, by more than three of its own and more than 10 %; every pose is where there is no cylinder.
// Distances by stereo and by size are depths, compared as shares of the true depth.
void JudgeSighting(const CylinderTruth& truth, const vision::CylinderFinding& finding,
                   FinderSums& sums);

}  // namespace rockyard::experiments
