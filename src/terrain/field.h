// One random terrain of a family: rocks, ground and arena, with an audit against the law. Each
// trial builds its field here. Replays, plots and the command `terrain`, which also counts rocks
// along the course, build the same field anew. Of the audit only outline_cover is in records; the
// rest is for `rockyard terrain`, figures of studies and tests.
#pragma once

#include <span>
#include <vector>

#include "core/random.h"
#include "terrain/arena.h"
#include "terrain/course.h"
#include "terrain/rock.h"
#include "terrain/terrain.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// Height above the ground from which the light stripe sees a rock on average: 1.5 times its
// threshold of 5 cm (Matthies 1995 sec. 6). For the audit alone: the rover judges hazards itself.
inline constexpr double kDetectableHeight_m = 0.075;
// Height from which a rock touches Rocky 3.2's undercarriage (Matthies 1995 sec. 6). For audit and
// drawings alone.
inline constexpr double kBellyHeight_m = 0.13;

// What a field holds against what its law promises. Areas and densities are those of the layout
// area, before mirroring, clear zones included.
struct FieldAudit {
  double layout_area_m2 = 0.0;

  // Rocks of the law: the mean of a Poisson distribution for laws of Mars, exact for uniform_count.
  double expected_drawn = 0.0;
  int drawn = 0;
  int dropped_in_clear_zones = 0;  // uniform_count places them elsewhere
  int dropped_for_overlap = 0;
  int relocated = 0;  // placed, but not where first drawn
  // `placed` is `drawn` less both kinds of dropped rocks, expected_placed its mean if no overlap
  // rule drops any. The mean is exact where the clear zones, grown by the largest rock's radius,
  // lie within the layout and apart.
  double expected_placed = 0.0;
  int placed = 0;
  int mirror_images = 0;

  // Shares of the layout area: round rocks by the law (mean of the placed ones), round rocks of the
  // drawn diameters, and the elliptic outlines. Overlap is not deducted.
  double expected_cover = 0.0;
  double disc_cover = 0.0;
  double outline_cover = 0.0;  // in every drive's record, as rock_cover

  double detectable_per_m2 = 0.0;  // at least kDetectableHeight_m above the ground
  double belly_high_per_m2 = 0.0;  // at least kBellyHeight_m above the ground
};

// A terrain with its audit.
struct Field {
  Terrain terrain;
  FieldAudit audit;
};

// Builds the field of one trial. Records depend on the streams and on the order of rocks. Rock i
// draws its mark, diameter, position and shape from streams of its own (kRockMark, kRockSize,
// kRockPlacement, kRockShape; substream i), and the reference count comes from kRockCount; so no
// choice about one rock shifts another. Fields that differ only in k_per_m2 or cover nest: the
// rocks of the smaller field come first in the list of the larger one, with the same position, size
// and shape. Virtual arenas list the rocks of the strip first, then their images. A goal rock must
// be the last of all, as the referee finds it by that; the audit leaves it out. README.md of this
// folder has the equations and the bias of each overlap rule. Throws core::UserError where start,
// waypoints or goal lie outside the arena, std::runtime_error where an exact count finds no place.
// Cost: about 0.1 ms for the nominal virtual arena.
Field BuildField(const TerrainParams& params, core::TrialKey key, const Course& course);

// Half the width of the corridor about the straight course, m: a rover 0.48 m wide and what its
// scanlines cover beside it.
inline constexpr double kCorridorHalfWidth_m = 0.5;

// Rocks of the corridor with diameters of at least from_m and below to_m.
struct CorridorClass {
  double from_m = 0.0;
  double to_m = 0.0;
  double expected = 0.0;  // mean number of centres in one field
  int observed = 0;       // in the fields counted so far
};

// Returns the area of the part of the rectangle within a distance of radius_m from (x, y), m2, in
// closed form.
double AreaNear(const Rectangle& area, double x_m, double y_m, double radius_m);

// Returns the corridor's classes, with what the text of Matthies 1995 sec. 7 lets expect in each:
// positions uniform over the layout area, no rock in a clear zone. Overlap and line rule of the
// parameters do not count, so that a rule that pushes rocks about shows as a difference. With C the
// corridor, A the layout area, Z(D) the two clear zones grown by the radius D/2 of a rock:
//   laws of Mars:   integral of n(D) (|C| - |C and Z(D)|) dD, as rocks drawn in the zones are
//                   dropped, for .1 to .2, .2 to .3, .3 to .5, .5 to 1 m and what exceeds these;
//   uniform_count:  count times the mean of (|C| - |C and Z(D)|) / (|A| - |A and Z(D)|), as they
//                   are drawn again, in one class.
// The numbers are good to 1e-5 of themselves. Returns nothing where there is no law, for listed
// rocks, where the course does not lead straight along x, where its clear zones meet, or where the
// corridor leaves the layout area (uniform_count: the count area).
std::vector<CorridorClass> ExpectedInCorridor(const TerrainParams& params, const Course& course);

// Adds the rocks whose centres lie in the corridor of the course to their classes.
void CountInCorridor(std::span<const Rock> rocks, const Course& course,
                     std::vector<CorridorClass>& classes);

}  // namespace rockyard::terrain
