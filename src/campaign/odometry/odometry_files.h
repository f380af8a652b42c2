// The files of an estimated path, vo.json and two pictures among them. EstimatePath writes them;
// the command `vo` also prints vo.json and counts of reasons.
#pragma once

#include <string>
#include <vector>

#include "campaign/odometry/estimate_path.h"
#include "core/json_value.h"
#include "image_files/raw_image.h"
#include "vision/image.h"
#include "vision/odometry/odometer.h"

namespace rockyard::campaign {

// Files that are there before WriteOdometryFiles writes the others (PathJournal, FeaturePicture).
inline constexpr const char* kJournalFile = "journal.jsonl";
inline constexpr const char* kFeaturesFile = "features.png";
// Returns the names of all files of a path.
std::vector<std::string> OdometryFileNames();

// Writes the files that follow from the whole path, each whole or not at all, finishes the folder
// and fills result.files.
void WriteOdometryFiles(const OdometryRequest& request, OutputFolder& folder,
                        OdometryResult& result);

// Returns the file vo.json, described in src/campaign/README.md. Programs read it (--json). Must
// stay: its members; others may only be added.
core::JsonValue OdometryJson(const OdometryRequest& request, const OdometryResult& result);

// Returns the times of one stage over all pairs, s; nothing where there are no pairs.
std::optional<vision::ErrorSummary> StageTimes(const OdometryResult& result, PairStage stage);

// Returns how many pairs ended with each reason, in the order of vision::NoMotion.
std::vector<std::int64_t> ReasonCounts(const OdometryResult& result);

// Returns the aligned left image, in muted grey, with its features as green-blue squares; those of
// the consistent set are yellow, with a line from where each was in the keyframe's image.
image_files::Picture FeaturePicture(const vision::GrayImage& left,
                                    const vision::OdometryStep& step);

// Returns an SVG drawing of the path in the plane in which it is widest: the two axes of largest
// extent of the outer frame of the first pair, the longer one to the right. Pairs without a motion
// are marked; with truth the true path is drawn too, in the frame of the first pair.
std::string PathDrawing(const OdometryResult& result);

}  // namespace rockyard::campaign
