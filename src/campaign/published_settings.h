// Whether a run is of the case that published values are about.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "campaign/journal.h"
#include "campaign/run_source.h"
#include "statistics/published_comparison.h"
#include "statistics/published_values.h"

namespace rockyard::campaign {

// The runs for statistics::Compare, with the settings in which each differs from the scenario file
// that the reference in `folder` names for it: "PATH is VALUE, VALUE in FILE", the seed left out.
// Where it names none, or the file cannot be read (which is noted), what the run was told by --set
// and --ablate. `runs` must outlive the views.
std::vector<statistics::ScenarioRun> PublishedViews(const statistics::PublishedReference& reference,
                                                    const std::filesystem::path& folder,
                                                    std::span<const StoredRun* const> runs,
                                                    Journal& journal);

}  // namespace rockyard::campaign
