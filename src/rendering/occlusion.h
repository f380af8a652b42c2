// Tolerances of questions about what hides what.
#pragma once

namespace rockyard::rendering {

// Surfaces this close to a point do not hide it: less than a pixel sees of the ground, and half the
// width of a beam of 3 mrad at 0.3 m.
inline constexpr double kOcclusionMargin_m = 0.0005;
// Added to the reach of rocks, so that rounding leaves none out that a ray touches.
inline constexpr double kRounding_m = 1e-9;

}  // namespace rockyard::rendering
