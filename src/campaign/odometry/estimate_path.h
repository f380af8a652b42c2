// What `rockyard vo` does, for that command: a sequence of image pairs to the path of its cameras
// (Matthies 1989; Howard 2012). Its steps are in the other files of this folder, but for
// render_sequence.h. No record of a trial depends on it; but the same request must give the same
// path to the bit, so that --resume ends as if nothing had been cut off.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "campaign/output_folder.h"
#include "campaign/stop.h"
#include "campaign/work.h"
#include "core/fields.h"
#include "math/pose.h"
#include "vision/cameras/rectification.h"
#include "vision/odometry/estimate_motion.h"
#include "vision/odometry/odometer_params.h"
#include "vision/odometry/trajectory_error.h"

namespace rockyard::campaign {

// Where a pair is expected before its images are looked at.
enum class Prediction {
  kNone,    // nowhere
  kSteady,  // where the last step, made once more, leads; nowhere without one
  kFile,    // where a file of poses says, such as of wheels
};

struct OdometryRequest {
  std::filesystem::path sequence;  // pair_reader.h
  std::filesystem::path cameras;   // of both images; empty: the calib.txt of the sequence
  std::filesystem::path out;       // a folder, which is made
  ExistingFiles existing = ExistingFiles::kRefuse;
  std::filesystem::path truth;        // poses (pose_text.h); empty: none
  std::vector<std::string> settings;  // PATH=VALUE of vision::OdometerParams

  Prediction prediction = Prediction::kSteady;
  std::filesystem::path predicted;  // of kFile: a pose for every pair of the whole sequence

  // Which pairs are read: from number `first` (from 0) on every `every`th one, at most `count`.
  std::int64_t first = 0;
  std::int64_t every = 1;
  std::optional<std::int64_t> count;

  std::uint64_t seed = 1;    // of RANSAC's draws
  std::optional<int> white;  // the sample that becomes 255 (image_files::ToGray)

  std::vector<double> lengths_m;  // of segments; empty: KITTI's
  std::int64_t delta = 1;         // steps of the relative pose error
  std::optional<std::int64_t>
      pictured;  // the pair whose features are drawn; absent: the middle one
};

// Where the time of a pair goes. Must stay: from kDetected on the order of vision::OdometryStage,
// and the names, which are in times.csv and vo.json.
enum class PairStage {
  kRead,
  kAligned,
  kDetected,
  kMatched,
  kPlaced,
  kSelected,
  kEstimated,
  kRenewed
};
inline constexpr std::array<std::string_view, 8> kPairStageNames{
    "read", "align", "detect", "match", "place", "select", "estimate", "renew"};
using StageSeconds = std::array<double, kPairStageNames.size()>;

// One pair of the path.
struct PathStep {
  std::int64_t pair = 0;       // its number in the sequence
  double time_s = 0.0;         // of the sequence; its number where that has no times
  std::int64_t reference = 0;  // the pair that it was compared with
  bool keyframe = false;
  vision::MotionResult result;  // from the reference to this pair
  // The pose of the cameras' outer frame in that of the first pair. Where no motion was found it is
  // the pose that was predicted, else that of the pair before.
  math::Transform X_AB = math::Transform::Identity();
  // The covariance of X_AB as of a motion from the first pair; absent from the first gap on.
  std::optional<vision::MotionCovariance> covariance;
  std::string unreadable;  // of NoMotion::kNoImages: why
  StageSeconds seconds{};
};

// Errors of a path, where truth is given. All are over pairs that have a true pose.
struct PathErrors {
  std::int64_t pairs = 0;
  double distance_m = 0.0;   // along the true path
  double end_error_m = 0.0;  // of the last position, first poses made equal
  std::optional<vision::MeanSegmentError> segments;
  std::optional<vision::ErrorSummary> absolute_first_m;  // first poses made equal
  std::optional<vision::ErrorSummary> absolute_rigid_m;  // positions laid upon each other
  std::optional<vision::ErrorSummary> relative_m;
  std::optional<vision::ErrorSummary> relative_rad;
  // The normalized errors of motions from their keyframes, e' C^-1 e: 6 on average where
  // covariances are right, and 5 % of them above the 95 % point of chi-squared.
  std::optional<vision::ErrorSummary> normalized;
  double normalized_above_95 = 0.0;  // share
};

struct OdometryResult {
  Outcome outcome = Outcome::kDone;  // or kInterrupted: a shorter path
  std::string layout;
  std::int64_t pairs_there = 0;  // in the sequence
  std::int64_t planned = 0;      // of these wanted
  std::string read;              // what the first image holds
  vision::RectifiedPair cameras;
  bool resampled = false;  // whether images had to be aligned
  bool has_times = false;
  vision::OdometerParams params;
  std::vector<PathStep> steps;
  std::vector<math::Transform> truth;         // of the steps below, in a frame of its own
  std::vector<std::size_t> steps_with_truth;  // indices of `steps`
  std::optional<PathErrors> errors;
  std::int64_t pictured = 0;
  std::vector<std::string> notes;  // what a user should know before believing it
  std::vector<OutputFile> files;

  std::int64_t Gaps() const;  // steps without a motion
  double Distance_m() const;  // along the estimated path
  vision::Trajectory Path() const;
};

}  // namespace rockyard::campaign

template <>
struct rockyard::core::EnumNames<rockyard::campaign::Prediction> {
  static constexpr std::array<std::string_view, 3> kNames{"none", "steady", "file"};
};

namespace rockyard::campaign {

// Returns the name of a value in files.
template <typename Enum>
std::string_view NameOf(Enum value) {
  return core::EnumNames<Enum>::kNames[static_cast<std::size_t>(value)];
}

// Called after each pair: how many are done, of how many, and how many had no motion.
using OdometryProgress =
    std::function<void(std::int64_t done, std::int64_t planned, std::int64_t gaps)>;

// Reads and aligns the images, finds the motion of each pair and writes into the folder, which is
// made: trajectory.csv, covariance.csv, times.csv, trajectory_kitti.txt, trajectory_tum.txt,
// path.svg and vo.json at the end, each file whole or not at all; with truth errors.csv as well.
// Where `stop` asks for an end, what was done is written too. features.png is written with the
// pictured pair.
//
// journal.jsonl grows pair by pair: with ExistingFiles::kResume a path that was cut off goes on and
// ends as if it had not been, but for the times. A pair whose images cannot be read is a gap.
// Throws core::UserError, before anything is written, for whatever is wrong with the input, the
// images of the first pair included.
OdometryResult EstimatePath(const OdometryRequest& request, const OdometryProgress& progress = {},
                            const Stop& stop = {});

}  // namespace rockyard::campaign
