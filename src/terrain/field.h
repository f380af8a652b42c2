// One random terrain of a family: rocks, ground and arena, with an audit against the law.
#pragma once

#include "core/random.h"
#include "terrain/course.h"
#include "terrain/terrain.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// Height above the ground from which the light stripe sees a rock on average: 1.5 times its
// threshold of 5 cm (Matthies 1995 sec. 6).
inline constexpr double kDetectableHeight_m = 0.075;
// Height from which a rock touches Rocky 3.2's undercarriage (Matthies 1995 sec. 6).
inline constexpr double kBellyHeight_m = 0.13;

// What a field holds against what its law promises. Areas and densities are those of the layout
// area, before mirroring, clear zones included.
struct FieldAudit {
  double layout_area_m2 = 0.0;

  // Rocks of the law: the mean of a Poisson distribution for moore, exact for uniform_count.
  double expected_drawn = 0.0;
  int drawn = 0;
  int dropped_in_clear_zones = 0;  // moore only: uniform_count places them elsewhere
  int dropped_for_overlap = 0;
  int relocated = 0;  // placed, but not where first drawn
  // drawn less both kinds of dropped ones, and its mean if no overlap rule drops any. The mean is
  // exact where the clear zones, grown by the largest rock's radius, lie within the layout and
  // apart.
  double expected_placed = 0.0;
  int placed = 0;
  int mirror_images = 0;

  // Shares of the layout area: round rocks by the law (mean of the placed ones), round rocks of the
  // drawn diameters, and the elliptic outlines. Overlap is not deducted.
  double expected_cover = 0.0;
  double disc_cover = 0.0;
  double outline_cover = 0.0;

  double detectable_per_m2 = 0.0;  // at least kDetectableHeight_m above the ground
  double belly_high_per_m2 = 0.0;  // at least kBellyHeight_m above the ground
};

// A terrain with its audit.
struct Field {
  Terrain terrain;
  FieldAudit audit;
};

// Builds the field of one trial. Rock i draws its mark, diameter, position and shape from streams
// of its own (kRockMark, kRockSize, kRockPlacement, kRockShape; substream i), and the reference
// count comes from kRockCount; so no choice about one rock shifts another, and fields that differ
// only in k_per_m2 nest: the smaller field's rocks come first in the larger one's list, with the
// same position, size and shape (virtual arenas list the rocks of the strip first, then the
// images). See README.md of this folder for the equations and for the bias of each overlap rule.
// Throws core::UserError where start or goal lie outside the arena, std::runtime_error where an
// exact count finds no place. Cost: about 0.1 ms for the nominal virtual arena.
Field BuildField(const TerrainParams& params, core::TrialKey key, const Course& course);

}  // namespace rockyard::terrain
