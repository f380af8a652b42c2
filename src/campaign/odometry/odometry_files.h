// The files of an estimated path, vo.json among them.
#pragma once

#include <string>
#include <vector>

#include "campaign/odometry/estimate_path.h"
#include "core/json_value.h"
#include "image_files/raw_image.h"
#include "vision/image.h"
#include "vision/odometry/odometer.h"

namespace rockyard::campaign {

// All that WriteOdometryFiles may write, and what is there before (PathJournal, FeaturePicture).
inline constexpr const char* kJournalFile = "journal.jsonl";
inline constexpr const char* kFeaturesFile = "features.png";
std::vector<std::string> OdometryFileNames();

// Writes them, ends with the folder and fills result.files. Each is there whole or not at all.
void WriteOdometryFiles(const OdometryRequest& request, OutputFolder& folder,
                        OdometryResult& result);

// The file vo.json: described in src/campaign/README.md. Programs read it (--json): members are
// only added.
core::JsonValue OdometryJson(const OdometryRequest& request, const OdometryResult& result);

// Of one stage over all pairs, s: median and largest. Nothing of no pairs.
std::optional<vision::ErrorSummary> StageTimes(const OdometryResult& result, PairStage stage);

// How many pairs ended with each reason, in the order of vision::NoMotion.
std::vector<std::int64_t> ReasonCounts(const OdometryResult& result);

// What can be looked at of a path: the features of a pair, and the path from above.

// The aligned left image, in muted grey, with its features as green-blue squares; those of the
// consistent set in yellow, with a line from where each was in the keyframe's image.
image_files::Picture FeaturePicture(const vision::GrayImage& left,
                                    const vision::OdometryStep& step);

// An SVG drawing of the path in the plane in which it is widest: of the outer frame of the first
// pair the two axes of largest extent, the longer one to the right. Pairs without a motion are
// marked; with truth the true path too, in the frame of the first pair.
std::string PathDrawing(const OdometryResult& result);

}  // namespace rockyard::campaign
