// The random layout of rocks on the layout area, before mirroring.
#pragma once

#include <vector>

#include "core/random.h"
#include "terrain/course.h"
#include "terrain/rock.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// The rocks of a layout, and what became of those that were drawn.
struct RockLayout {
  // The z of their centres is measured from the ground: the ground's own height is not added yet.
  std::vector<Rock> rocks;
  int drawn = 0;
  int dropped_in_clear_zones = 0;
  int dropped_for_overlap = 0;
  int relocated = 0;
};

// Returns a rock that is given rather than drawn: round, without yaw, of the field's mean burial
// and its pointedness. The z of its centre is measured from the ground.
Rock GivenRock(const RockFieldParams& params, const CoursePoint& place, double diameter_m,
               double height_m);

// Returns the rocks in the order in which they were placed: by mark for moore, by number for
// uniform_count. A rock's fate depends on earlier ones only, so that a field of smaller k is a
// prefix of one of larger k under every overlap rule.
RockLayout LayOutRocks(const TerrainParams& params, core::TrialKey key, const Course& course);

}  // namespace rockyard::terrain
