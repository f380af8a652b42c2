// Tolerances of questions about what hides what.
#pragma once

namespace rockyard::sensing {

// Surfaces this close to a point do not hide it: half the width of the beam (3 mrad at 0.3 m).
inline constexpr double kOcclusionMargin_m = 0.0005;
// Added to the reach of rocks, so that rounding leaves none out that a ray touches.
inline constexpr double kRounding_m = 1e-9;

}  // namespace rockyard::sensing
