// Where a spline of two knots leads, and how it is curved.
#pragma once

#include "messages/spline.h"
#include "navigation/gestalt/clothoid.h"
#include "navigation/gestalt/curvature_law.h"

namespace rockyard::navigation {

using messages::Spline;

// Returns the curvature, 1/m, after driven_m: that of the start before it, and that of the second
// knot beyond the end.
double CurvatureAt(const Spline& spline, double driven_m, const CurvatureLaw& law);

// Returns what it grows by with each metre, 1/m2; where it has a corner, what it grows by from
// there on. 0 before the start and beyond the end.
double CurvatureRateAt(const Spline& spline, double driven_m, const CurvatureLaw& law);

// Returns the largest change of curvature a second, 1/(m s), at the speed of the speed law.
double LargestRateInTime(const Spline& spline, double full_speed_m_s, const CurvatureLaw& law);

// Returns the place after driven_m >= 0, in the frame in which the spline begins at the origin
// along x. Errors and cost: those of CurvatureLaw::Path.
ClothoidPoint OnSpline(const Spline& spline, double driven_m, const CurvatureLaw& law);

// Returns the path from one place on the spline to a later one, in the frame of the first.
ClothoidPoint AlongSpline(const Spline& spline, double from_m, double to_m,
                          const CurvatureLaw& law);

}  // namespace rockyard::navigation
