// Where two resolved scenarios differ.
#pragma once

#include <string_view>
#include <vector>

#include "core/error.h"

namespace rockyard::batch {

// One entry per JSON path whose value differs, e.g. "terrain.rocks.k_per_m2: is 0.00415 in the
// stored run and 0.013 now". Name, description and number of trials are left out: no record depends
// on them. At most `limit` entries, then one that counts the rest. Both are JSON texts; what is
// none gives one entry that says so.
std::vector<core::Problem> ScenarioDifferences(std::string_view stored, std::string_view wanted,
                                               std::size_t limit = 12);

}  // namespace rockyard::batch
