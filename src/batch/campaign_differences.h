// Whether the trials of two campaigns belong together.
#pragma once

#include <string>
#include <vector>

#include "batch/campaign.h"
#include "batch/scenario_difference.h"
#include "core/error.h"

namespace rockyard::batch {

// Whether a campaign may go on with another build than the one that began it. Another scenario or
// seed is never accepted: the trials would not belong together.
enum class BuildPolicy { kSame, kAny };

// Everything that keeps the stored trials and new ones from belonging together: cells, the JSON
// paths of their scenarios, seeds, columns, and each of `builds` that is not the wanted one. Empty
// where they do. Names of campaigns and shards are not compared.
std::vector<core::Problem> CampaignDifferences(const CampaignIdentity& stored,
                                               const CampaignIdentity& wanted,
                                               const std::vector<std::string>& builds,
                                               BuildPolicy policy,
                                               const DifferenceWords& words = {});

}  // namespace rockyard::batch
