// How far a finding of the cylinder is off.
#pragma once

#include "experiments/cylinder_sighting/sighting_sums.h"
#include "math/pose.h"
#include "vision/cylinder/cylinder_sighting.h"

namespace rockyard::experiments {

// What is true of a view. L as in rendering/cylinder/cylinder_view.h.
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
