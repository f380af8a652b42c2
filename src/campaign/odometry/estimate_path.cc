#include "campaign/odometry/estimate_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "campaign/odometry/image_sequence.h"
#include "campaign/odometry/odometry_files.h"
#include "campaign/odometry/odometry_picture.h"
#include "campaign/odometry/pair_reader.h"
#include "campaign/odometry/path_errors.h"
#include "campaign/odometry/path_tracker.h"
#include "campaign/odometry/pose_text.h"
#include "campaign/odometry/stop_wish.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/json_file.h"

namespace rockyard::campaign {
namespace {

vision::OdometerParams ParamsOf(const OdometryRequest& request) {
  core::JsonValue document = core::JsonValue::Object();
  for (const std::string& setting : request.settings) core::ApplyOverride(document, setting);
  vision::OdometerParams params;
  core::ReadParams(document, params);
  return params;
}

// Seconds since the last call.
class StageClock {
 public:
  double Lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

PairStage StageOf(vision::OdometryStage stage) {
  return static_cast<PairStage>(static_cast<int>(stage) + static_cast<int>(PairStage::kDetected));
}

// The pairs that are wanted, by their number.
std::vector<std::int64_t> WantedPairs(const OdometryRequest& request, std::int64_t there) {
  std::vector<std::int64_t> wanted;
  for (std::int64_t pair = request.first; pair < there; pair += request.every) {
    if (request.count && std::ssize(wanted) >= *request.count) break;
    wanted.push_back(pair);
  }
  if (wanted.size() < 2) {
    throw core::UserError(request.sequence.string(),
                          fmt::format("leaves {} of its {} pairs, from --first {} on every {}",
                                      wanted.size(), there, request.first, request.every),
                          "a motion needs two pairs");
  }
  return wanted;
}

// Poses of every pair of the sequence, by a file; empty without one.
std::vector<math::Transform> PredictedPoses(const OdometryRequest& request, std::int64_t there) {
  if (request.prediction != Prediction::kFile) return {};
  PoseFile file = ReadPoses(request.predicted);
  if (std::ssize(file.poses) != there) {
    throw core::UserError(request.predicted.string(),
                          fmt::format("has {} poses, there are {} pairs", file.poses.size(), there),
                          "give one pose a pair of the whole sequence");
  }
  return std::move(file.poses);
}

class PathEstimation {
 public:
  PathEstimation(const OdometryRequest& request, const ImageSequence& sequence,
                 OdometryResult& result)
      : request_(request),
        sequence_(sequence),
        result_(result),
        reader_(request, sequence),
        predicted_(PredictedPoses(request, std::ssize(sequence.pairs))),
        odometer_(result.params, reader_.cameras(), reader_.left_free(), {request.seed, 0},
                  [this](vision::OdometryStage stage) { Count(StageOf(stage)); }) {
    result.read = reader_.description();
    if (!reader_.advice().empty()) result.notes.push_back(reader_.advice());
    result.cameras = reader_.cameras();
    result.resampled = reader_.resampled();
  }

  void Add(std::int64_t pair) {
    PathStep step;
    step.pair = pair;
    const SequencePair& files = sequence_.pairs[static_cast<std::size_t>(pair)];
    step.time_s = files.time_s.value_or(static_cast<double>(pair));
    seconds_ = {};
    clock_.Lap();
    const GrayPair images = reader_.Read(files);
    Count(PairStage::kRead);
    vision::AlignedImages aligned = reader_.Align(images);
    Count(PairStage::kAligned);
    const auto predicted = tracker_.Predict(request_.prediction, ExpectedStep(pair));
    const bool pictured = pair == result_.pictured;
    const vision::GrayImage left = pictured ? aligned.left : vision::GrayImage();
    const vision::OdometryStep found = odometer_.Add(std::move(aligned), predicted);
    step.seconds = seconds_;
    step.reference = PairOfNumber(found.reference, pair);
    step.keyframe = found.keyframe;
    step.result = found.result;
    tracker_.Place(found, predicted, step);
    if (pictured) result_.features = FeaturePicture(left, found);
    result_.steps.push_back(std::move(step));
  }

 private:
  void Count(PairStage stage) { seconds_[static_cast<std::size_t>(stage)] += clock_.Lap(); }

  // The odometer numbers what it is given.
  std::int64_t PairOfNumber(std::int64_t number, std::int64_t present) const {
    if (number == std::ssize(result_.steps)) return present;
    return result_.steps[static_cast<std::size_t>(number)].pair;
  }

  // What the file of poses says of the way since the pair before.
  std::optional<math::Transform> ExpectedStep(std::int64_t pair) const {
    if (predicted_.empty() || result_.steps.empty()) return std::nullopt;
    const auto before = static_cast<std::size_t>(result_.steps.back().pair);
    return predicted_[before].inverse() * predicted_[static_cast<std::size_t>(pair)];
  }

  const OdometryRequest& request_;
  const ImageSequence& sequence_;
  OdometryResult& result_;
  PairReader reader_;
  std::vector<math::Transform> predicted_;
  StageClock clock_;
  StageSeconds seconds_{};
  PathTracker tracker_;
  vision::VisualOdometer odometer_;
};

void NotePath(OdometryResult& result) {
  const std::int64_t motions = std::ssize(result.steps) - 1;
  const std::int64_t gaps = result.Gaps();
  if (gaps > 0) {
    result.notes.push_back(fmt::format(
        "{} of {} pairs have no motion: the path goes on there as it was predicted, or stays, and "
        "has no covariance afterwards",
        gaps, motions));
  }
  if (!result.has_times) {
    result.notes.emplace_back("the sequence has no times: the numbers of its pairs stand for them");
  }
}

}  // namespace

std::int64_t OdometryResult::Gaps() const {
  return std::count_if(steps.begin(), steps.end(),
                       [](const PathStep& step) { return step.result.reason.has_value(); });
}

vision::Trajectory OdometryResult::Path() const {
  vision::Trajectory path;
  path.reserve(steps.size());
  for (const PathStep& step : steps) path.push_back(step.X_AB);
  return path;
}

double OdometryResult::Distance_m() const {
  return steps.empty() ? 0.0 : vision::DistancesAlong(Path()).back();
}

OdometryResult EstimatePath(const OdometryRequest& request, const OdometryProgress& progress,
                            const Stop& stop) {
  OdometryResult result;
  result.params = ParamsOf(request);
  const ImageSequence sequence = FindSequence(request.sequence);
  result.layout = sequence.layout;
  result.pairs_there = std::ssize(sequence.pairs);
  result.has_times = sequence.pairs.front().time_s.has_value();
  const std::vector<std::int64_t> wanted = WantedPairs(request, result.pairs_there);
  result.planned = std::ssize(wanted);
  result.pictured = request.pictured.value_or(wanted[wanted.size() / 2]);
  const std::optional<TruePath> truth = ReadTruth(request, sequence);
  PathEstimation estimation(request, sequence, result);
  const StopWish wish(stop);
  for (const std::int64_t pair : wanted) {
    if (wish.IsThere()) {
      result.outcome = Outcome::kInterrupted;
      break;
    }
    estimation.Add(pair);
    if (progress) progress(std::ssize(result.steps), result.planned, result.Gaps());
  }
  NotePath(result);
  if (truth) JudgePath(request, *truth, result);
  WriteOdometryFiles(request, result);
  return result;
}

}  // namespace rockyard::campaign
