#include "navigation/gestalt/spline_curves.h"

#include <algorithm>

#include "core/check.h"

namespace rockyard::navigation {

double CurvatureAt(const Spline& spline, double driven_m, const CurvatureLaw& law) {
  const double half_m = 0.5 * spline.length_m;
  if (driven_m <= 0.0) return spline.start_per_m;
  if (driven_m < half_m) {
    return law.Between(spline.start_per_m, spline.first_knot_per_m, driven_m / half_m);
  }
  if (driven_m < spline.length_m) {
    return law.Between(spline.first_knot_per_m, spline.second_knot_per_m,
                       (driven_m - half_m) / half_m);
  }
  return spline.second_knot_per_m;
}

double CurvatureRateAt(const Spline& spline, double driven_m, const CurvatureLaw& law) {
  const double half_m = 0.5 * spline.length_m;
  if (driven_m < 0.0 || driven_m >= spline.length_m) return 0.0;
  if (driven_m < half_m) {
    return law.RateBetween(spline.start_per_m, spline.first_knot_per_m, driven_m / half_m, half_m);
  }
  return law.RateBetween(spline.first_knot_per_m, spline.second_knot_per_m,
                         (driven_m - half_m) / half_m, half_m);
}

double LargestRateInTime(const Spline& spline, double full_speed_m_s, const CurvatureLaw& law) {
  const double half_m = 0.5 * spline.length_m;
  return std::max(law.LargestRateInTime(spline.start_per_m, spline.first_knot_per_m, half_m,
                                        full_speed_m_s),
                  law.LargestRateInTime(spline.first_knot_per_m, spline.second_knot_per_m, half_m,
                                        full_speed_m_s));
}

ClothoidPoint OnSpline(const Spline& spline, double driven_m, const CurvatureLaw& law) {
  return AlongSpline(spline, 0.0, driven_m, law);
}

ClothoidPoint AlongSpline(const Spline& spline, double from_m, double to_m,
                          const CurvatureLaw& law) {
  EXPECT(0.0 <= from_m && from_m <= to_m);
  ClothoidPoint end;
  double begin_m = from_m;
  // Up to each knot, and beyond the last one, as far as the way leads.
  for (const double knot_m : {0.5 * spline.length_m, spline.length_m, to_m}) {
    const double next_m = std::min(knot_m, to_m);
    if (next_m <= begin_m) continue;
    end = Joined(end, law.Path(CurvatureAt(spline, begin_m, law), CurvatureAt(spline, next_m, law),
                               next_m - begin_m));
    begin_m = next_m;
  }
  return end;
}

}  // namespace rockyard::navigation
