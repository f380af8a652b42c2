// The files of an estimated path, vo.json among them.
#pragma once

#include <string>
#include <vector>

#include "campaign/odometry/estimate_path.h"
#include "core/json_value.h"

namespace rockyard::campaign {

// All that WriteOdometryFiles may write, and what is there before (PathJournal, FeaturePicture).
inline constexpr const char* kJournalFile = "journal.jsonl";
inline constexpr const char* kFeaturesFile = "features.png";
std::vector<std::string> OdometryFileNames();

// Writes them, ends with the folder and fills result.files. Each is there whole or not at all.
void WriteOdometryFiles(const OdometryRequest& request, OutputFolder& folder,
                        OdometryResult& result);

// The file vo.json: described in src/campaign/README.md.
core::JsonValue OdometryJson(const OdometryRequest& request, const OdometryResult& result);

// Of one stage over all pairs, s: median and largest. Nothing of no pairs.
std::optional<vision::ErrorSummary> StageTimes(const OdometryResult& result, PairStage stage);

// How many pairs ended with each reason, in the order of vision::NoMotion.
std::vector<std::int64_t> ReasonCounts(const OdometryResult& result);

}  // namespace rockyard::campaign
