// Whether the trials of two campaigns belong together, and where two resolved scenarios differ. A
// store that goes on or is merged asks it, and so do comparisons of runs, reports and baselines. No
// record depends on it, but one more difference refuses stores that went on before.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "batch/campaign.h"
#include "core/error.h"
#include "core/json_value.h"

namespace rockyard::batch {

// A value that two resolved scenarios do not share, as text; "absent" where one of them has none.
struct ScenarioDifference {
  std::string path;  // e.g. "terrain.rocks.k_per_m2"
  std::string first;
  std::string second;
};

// Returns the values that differ, in the order of the first document and then what the second alone
// has, without what no record depends on (scenario::kNoInfluence). A key by its former name counts
// as the key of today. Both are JSON texts; throws core::UserError where one is none.
std::vector<ScenarioDifference> FindScenarioDifferences(std::string_view first,
                                                        std::string_view second);

// Returns what scenario::Fingerprint gives for a resolved scenario, 16 digits, from its JSON alone.
std::string ResolvedFingerprint(core::JsonValue resolved);

// Where the two values of a difference are found, for messages.
struct DifferenceWords {
  std::string_view first = "in the stored run";
  std::string_view second = "now";
};

// Returns the differences of two resolved scenarios as problems of a run that is to be resumed: one
// entry per JSON path whose value differs, e.g. "terrain.rocks.k_per_m2: is 0.00415 in the stored
// run and 0.013 now". At most `limit` entries come, then one that counts the rest. Both are JSON
// texts; a text that is none gives entries that say so.
std::vector<core::Problem> ScenarioDifferences(std::string_view stored, std::string_view wanted,
                                               std::size_t limit = 12,
                                               const DifferenceWords& words = {});

// Whether a campaign may go on with another build than the one that began it. Another scenario or
// seed is never accepted.
enum class BuildPolicy { kSame, kAny };

// Returns everything that keeps the stored trials and new ones from belonging together: cells, the
// JSON paths of their scenarios, seeds, columns, and each of `builds` that is not the wanted one.
// Returns nothing where they belong together. Names of campaigns and shards are not compared.
std::vector<core::Problem> CampaignDifferences(const CampaignIdentity& stored,
                                               const CampaignIdentity& wanted,
                                               const std::vector<std::string>& builds,
                                               BuildPolicy policy,
                                               const DifferenceWords& words = {});

}  // namespace rockyard::batch
