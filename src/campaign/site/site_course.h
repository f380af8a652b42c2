// Where a drive of a scenario goes on a site: the arena within the elevation model, and the course
// in it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "campaign/site/elevation_file.h"
#include "core/json_value.h"
#include "scenario/scenario.h"

namespace rockyard::campaign {

// Returns the group `terrain.arena`: open, and with its margin within the model. Throws
// core::UserError where the model is too small for one.
core::JsonValue ArenaOfSite(const SiteElevation& site, const terrain::ArenaParams& base);

// Returns what of `course` differs from the base's: from `start` to `goal` where they are given,
// else along x with the middle at the origin, as long as the base's where that fits. What was
// changed is noted. Throws core::UserError for places beyond the arena.
core::JsonValue CourseOfSite(const scenario::Scenario& base, const terrain::ArenaParams& arena,
                             const std::optional<std::array<double, 2>>& start,
                             const std::optional<std::array<double, 2>>& goal,
                             std::vector<std::string>& notes);

}  // namespace rockyard::campaign
