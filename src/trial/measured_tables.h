// Times of rockyard's own stages on one core of today, as data: its benchmarks' (results/).
#pragma once

#include <array>

#include "trial/stereo_tables.h"

namespace rockyard::trial {

// Dense stereo by the width of square images with disparities of an eighth of it, vectors of 512
// bits: levels 3 to 0 of results/studies/stereo_speedup.json.
inline constexpr std::array kOwnStereo = {
    PrintedTime{64.0, 0.120e-3, 0.120e-3},
    PrintedTime{128.0, 0.285e-3, 0.285e-3},
    PrintedTime{256.0, 0.862e-3, 0.862e-3},
    PrintedTime{512.0, 2.689e-3, 2.689e-3},
};

// A whole cycle of GESTALT's map with 16384 points, 9 m x 9 m in cells of 50, 20 and 10 cm
// (results/gestalt.md): points, planes, traversability and votes.
inline constexpr std::array<double, 3> kOwnCycles_s{0.325e-3, 0.372e-3, 0.541e-3};

// A step of visual odometry on images of 512 x 384 pixels with 400 features
// (results/studies/odometry_speed.json).
inline constexpr double kOwnVisualOdometry_s = 2.349e-3;

}  // namespace rockyard::trial
