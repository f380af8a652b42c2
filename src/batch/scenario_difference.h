// Where two resolved scenarios differ.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/json_value.h"

namespace rockyard::batch {

// A value that two scenarios do not share, as text; "absent" where one of them has none.
struct ScenarioDifference {
  std::string path;  // e.g. "terrain.rocks.k_per_m2"
  std::string first;
  std::string second;
};

// In the order of the first document, without what no record depends on (scenario::kNoInfluence).
// Former keys count as those of today. Both are JSON texts; throws core::UserError on what is none.
std::vector<ScenarioDifference> FindScenarioDifferences(std::string_view first,
                                                        std::string_view second);

// What scenario::Fingerprint gives for a resolved scenario, 16 digits, from its JSON alone.
std::string ResolvedFingerprint(core::JsonValue resolved);

// Where the two values of a difference are found, for messages.
struct DifferenceWords {
  std::string_view first = "in the stored run";
  std::string_view second = "now";
};

// The same as problems of a run that is to be resumed: one entry per JSON path whose value differs,
// e.g. "terrain.rocks.k_per_m2: is 0.00415 in the stored run and 0.013 now". At most `limit`
// entries, then one that counts the rest. Both are JSON texts; what is none gives one entry that
// says so.
std::vector<core::Problem> ScenarioDifferences(std::string_view stored, std::string_view wanted,
                                               std::size_t limit = 12,
                                               const DifferenceWords& words = {});

}  // namespace rockyard::batch
