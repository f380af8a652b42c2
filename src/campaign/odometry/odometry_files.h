// The files of an estimated path.
#pragma once

#include <string>
#include <vector>

#include "campaign/odometry/odometry_request.h"

namespace rockyard::campaign {

// All that WriteOdometryFiles may write, and what is there before (PathJournal, FeaturePicture).
inline constexpr const char* kJournalFile = "journal.jsonl";
inline constexpr const char* kFeaturesFile = "features.png";
std::vector<std::string> OdometryFileNames();

// Writes them, ends with the folder and fills result.files. Each is there whole or not at all.
void WriteOdometryFiles(const OdometryRequest& request, OutputFolder& folder,
                        OdometryResult& result);

// A line a pair: its number, time, reference, keyframe, whether there was a motion and why not, the
// pose (m, unit quaternion), counts, iterations, rms of what is left over.
std::string TrajectoryCsv(const OdometryResult& result);

// A line a pair: the upper triangles, row by row, of the covariance of the motion from its
// reference and of that of the pose (vision::MotionCovariance); empty where there is none.
std::string CovarianceCsv(const OdometryResult& result);

// A line a pair: milliseconds of each stage.
std::string TimesCsv(const OdometryResult& result);

// A line a pair with a true pose: true and estimated position, first poses made equal, and their
// distance, m.
std::string ErrorsCsv(const OdometryResult& result);

}  // namespace rockyard::campaign
