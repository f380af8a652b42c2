// The map of a site that a navigator gets before it drives (course.site_map). It is made of the
// true terrain, with the stated errors, by what stands for a satellite; on-board code gets the map
// alone.
#pragma once

#include <memory>

#include "core/random.h"
#include "messages/site_map.h"
#include "terrain/terrain.h"
#include "trial/course/course_params.h"

namespace rockyard::trial {

// Returns the map of a trial, or null where the scenario has none. Heights are means over a cell,
// as sampled at 5 x 5 places of the ground and the rocks on it, plus a normal error each; the share
// of rocks, of those that are large enough to be told apart, is that of the same places. All of it
// lies off by one shift. Records depend on the random numbers: Purpose::kSiteMap, substream 0 for
// the shift (x, then y), 1 for the heights, cell by cell. Cost: 25 heights a cell, some 1 ms for 30
// m x 30 m.
std::shared_ptr<const messages::SiteMap> MakeSiteMap(const CourseParams& course,
                                                     const terrain::Terrain& terrain,
                                                     core::TrialKey key);

}  // namespace rockyard::trial
