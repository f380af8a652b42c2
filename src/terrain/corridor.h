// How many rocks lie where the course leads, by size, against what the law says.
#pragma once

#include <span>
#include <vector>

#include "terrain/arena.h"
#include "terrain/course.h"
#include "terrain/rock.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// Half the width of the corridor, m: a rover 0.48 m wide and what its scanlines cover beside it.
inline constexpr double kCorridorHalfWidth_m = 0.5;

// Rocks of the corridor with diameters from from_m on and below to_m.
struct CorridorClass {
  double from_m = 0.0;
  double to_m = 0.0;
  double expected = 0.0;  // mean number of centres in one field
  int observed = 0;       // in the fields counted so far
};

// Returns the area of the rectangle that lies within a distance of radius_m from (x, y), m2. Closed
// form.
double AreaNear(const Rectangle& area, double x_m, double y_m, double radius_m);

// Returns the corridor's classes, with what the text of Matthies 1995 sec. 7 lets expect in each:
// positions uniform over the layout area, no rock in a clear zone, whatever the overlap and the
// line rule of the parameters are; a rule that pushes rocks about shows as a difference. With C the
// corridor, A the layout area, Z(D) the two clear zones grown by the radius D/2 of a rock:
//   moore:          integral of n(D) (|C| - |C and Z(D)|) dD, as rocks drawn in the zones are
//                   dropped, for .1 to .2, .2 to .3, .3 to .5, .5 to 1 m and what exceeds these;
//   uniform_count:  count times the mean of (|C| - |C and Z(D)|) / (|A| - |A and Z(D)|), as they
//   are
//                   drawn again, in one class.
// Good to 1e-5 of itself. Empty where there is no law, where the course does not lead straight
// along x, where its clear zones meet, or where the corridor leaves the layout area (uniform_count:
// the count area).
std::vector<CorridorClass> ExpectedInCorridor(const TerrainParams& params, const Course& course);

// Adds the rocks whose centres lie in the corridor of the course to their classes.
void CountInCorridor(std::span<const Rock> rocks, const Course& course,
                     std::vector<CorridorClass>& classes);

}  // namespace rockyard::terrain
