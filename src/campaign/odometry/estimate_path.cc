#include "campaign/odometry/estimate_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "campaign/odometry/odometry_files.h"
#include "campaign/odometry/pair_reader.h"
#include "campaign/odometry/path_journal.h"
#include "campaign/odometry/path_tracker.h"
#include "campaign/odometry/pose_text.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/json_file.h"
#include "image_files/png_file.h"
#include "report/result_table.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

vision::OdometerParams ParamsOf(const OdometryRequest& request) {
  core::JsonValue document = core::JsonValue::Object();
  for (const std::string& setting : request.settings) core::ApplyOverride(document, setting);
  vision::OdometerParams params;
  core::ReadParams(document, params);
  return params;
}

// A clock whose Lap returns the seconds since the last call.
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

// Returns the pairs that are wanted, by their number.
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
                          "a motion needs two pairs: use a smaller --first or a smaller --every");
  }
  return wanted;
}

// Returns the predicted pose of every pair of the sequence, from the file of the request; nothing
// without one.
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

// Returns what decides the path and the files, but for the images themselves. Must name every such
// setting: one that is left out may differ when a path is gone on with, and nobody notices.
core::JsonValue PathRequestJson(const OdometryRequest& request, const ImageSequence& sequence,
                                const OdometryResult& result) {
  const auto bytes_of = [](const fs::path& file) {
    constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
    if (file.empty()) return std::string("none");
    return core::Hex(
        core::Hasher().RawText(core::ReadWholeFile(file, kMaxBytes, "a file")).value());
  };
  return report::ObjectTree(
      "sequence", request.sequence.string(), "pairs", result.pairs_there, "planned", result.planned,
      "first", request.first, "every", request.every, "pictured", result.pictured, "seed",
      std::to_string(request.seed), "white", request.white.value_or(0), "cameras",
      bytes_of(request.cameras.empty() ? sequence.calibration : request.cameras), "prediction",
      NameOf(request.prediction), "predicted", bytes_of(request.predicted), "parameters",
      core::WriteParams(result.params));
}

OutputPlan PathPlan(const OdometryRequest& request, const ImageSequence& sequence,
                    const OdometryResult& result) {
  OutputPlan plan{.command = "vo",
                  .names = OdometryFileNames(),
                  .inputs = {request.sequence, request.cameras, request.truth, request.predicted},
                  .request = PathRequestJson(request, sequence, result)};
  for (const SequencePair& pair : sequence.pairs) {
    plan.inputs.insert(plan.inputs.end(), {pair.left, pair.right});
  }
  return plan;
}

class PathEstimation {
 public:
  PathEstimation(const OdometryRequest& request, const ImageSequence& sequence,
                 OutputFolder& folder, OdometryResult& result)
      : request_(request),
        sequence_(sequence),
        folder_(folder),
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

  // Takes what an earlier call has done of these pairs; Add is then called for the rest.
  void Resume(std::span<const std::int64_t> wanted) {
    if (!folder_.resumes()) return;
    journal_.emplace(folder_.PathOf(kJournalFile));
    std::int64_t failures = 0;
    for (const PairEntry& entry : journal_->entries()) {
      const std::int64_t given = std::ssize(pairs_) + (entry.unreadable.empty() ? 1 : 0);
      if (std::ssize(result_.steps) == std::ssize(wanted) ||
          entry.pair != wanted[result_.steps.size()] || entry.found.reference < 0 ||
          entry.found.reference >= given) {
        throw core::UserError(folder_.PathOf(kJournalFile).string(), "has other pairs",
                              "begin anew in another folder");
      }
      if (entry.unreadable.empty()) {
        failures = entry.found.keyframe || entry.found.result.motion ? 0 : failures + 1;
      }
      Take(entry);
    }
    if (pairs_.empty()) return;
    const std::int64_t keyframe = NumberOfKeyframe();
    odometer_.Resume(keyframe, reader_.Align(reader_.Read(FilesOf(PairOfNumber(keyframe)))),
                     std::ssize(pairs_), failures);
  }

  void Add(std::int64_t pair) {
    const PairEntry entry = Look(pair);
    folder_.Begin();
    if (!journal_) journal_.emplace(folder_.PathOf(kJournalFile));
    journal_->Add(entry);
    Take(entry);
  }

 private:
  void Count(PairStage stage) { seconds_[static_cast<std::size_t>(stage)] += clock_.Lap(); }

  const SequencePair& FilesOf(std::int64_t pair) const {
    return sequence_.pairs[static_cast<std::size_t>(pair)];
  }

  // Returns the pair of a number of the odometer, which counts the pairs that it is given.
  std::int64_t PairOfNumber(std::int64_t number) const {
    return pairs_[static_cast<std::size_t>(number)];
  }
  std::int64_t NumberOfKeyframe() const {
    return std::find(pairs_.begin(), pairs_.end(), keyframe_) - pairs_.begin();
  }

  // Reads the images of a pair; returns nothing, with the reason in `entry`, where they cannot be
  // read. For the first pair of a path, to which all others are told, that is an error.
  std::optional<GrayPair> Read(PairEntry& entry) const {
    try {
      return reader_.Read(FilesOf(entry.pair));
    } catch (const core::MachineError&) {
      throw;
    } catch (const core::UserError& error) {
      if (result_.steps.empty()) throw;
      entry.unreadable = error.what();
      entry.found.result.reason = vision::NoMotion::kNoImages;
      entry.found.reference = NumberOfKeyframe();
      entry.found.number = -1;
      return std::nullopt;
    }
  }

  PairEntry Look(std::int64_t pair) {
    PairEntry entry;
    entry.pair = pair;
    seconds_ = {};
    clock_.Lap();
    const std::optional<GrayPair> images = Read(entry);
    Count(PairStage::kRead);
    if (images) {
      vision::AlignedImages aligned = reader_.Align(*images);
      Count(PairStage::kAligned);
      const bool pictured = pair == result_.pictured;
      const vision::GrayImage left = pictured ? aligned.left : vision::GrayImage();
      entry.found = odometer_.Add(std::move(aligned),
                                  tracker_.Predict(request_.prediction, ExpectedStep(pair)));
      if (pictured) {
        folder_.WriteNow(kFeaturesFile, image_files::EncodePng(FeaturePicture(left, entry.found)));
      }
    }
    entry.seconds = seconds_;
    return entry;
  }

  void Take(const PairEntry& entry) {
    const bool seen = entry.unreadable.empty();
    if (seen) pairs_.push_back(entry.pair);
    if (entry.found.keyframe) keyframe_ = entry.pair;
    PathStep step;
    step.pair = entry.pair;
    step.time_s = FilesOf(entry.pair).time_s.value_or(static_cast<double>(entry.pair));
    step.seconds = entry.seconds;
    step.reference = PairOfNumber(entry.found.reference);
    step.keyframe = entry.found.keyframe;
    step.result = entry.found.result;
    step.unreadable = entry.unreadable;
    tracker_.Place(entry.found, tracker_.Predict(request_.prediction, ExpectedStep(entry.pair)),
                   step);
    result_.steps.push_back(std::move(step));
  }

  // Returns the motion since the previous pair, from the file of predicted poses.
  std::optional<math::Transform> ExpectedStep(std::int64_t pair) const {
    if (predicted_.empty() || result_.steps.empty()) return std::nullopt;
    const auto before = static_cast<std::size_t>(result_.steps.back().pair);
    return predicted_[before].inverse() * predicted_[static_cast<std::size_t>(pair)];
  }

  const OdometryRequest& request_;
  const ImageSequence& sequence_;
  OutputFolder& folder_;
  OdometryResult& result_;
  PairReader reader_;
  std::vector<math::Transform> predicted_;
  StageClock clock_;
  StageSeconds seconds_{};
  PathTracker tracker_;
  vision::VisualOdometer odometer_;
  std::optional<PathJournal> journal_;
  std::vector<std::int64_t> pairs_;  // that the odometer was given, by its numbers
  std::int64_t keyframe_ = 0;        // the pair
};

void NoteUnreadable(OdometryResult& result) {
  const auto is_unreadable = [](const PathStep& step) { return !step.unreadable.empty(); };
  const auto first = std::find_if(result.steps.begin(), result.steps.end(), is_unreadable);
  if (first == result.steps.end()) return;
  result.notes.push_back(fmt::format("images of {} pairs cannot be read, the first of pair {}: {}",
                                     std::count_if(first, result.steps.end(), is_unreadable),
                                     first->pair, first->unreadable));
}

void NotePath(OdometryResult& result) {
  const std::int64_t motions = std::ssize(result.steps) - 1;
  const std::int64_t gaps = result.Gaps();
  if (gaps > 0) {
    result.notes.push_back(fmt::format(
        "{} of {} pairs have no motion: the path goes on there as it was predicted, or stays, and "
        "has no covariance afterwards",
        gaps, motions));
  }
  NoteUnreadable(result);
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
  OutputFolder folder(request.out, request.existing, PathPlan(request, sequence, result));
  PathEstimation estimation(request, sequence, folder, result);
  estimation.Resume(wanted);
  const StopWish wish(stop);
  for (const std::int64_t pair : std::span(wanted).subspan(result.steps.size())) {
    if (wish.IsThere()) {
      result.outcome = Outcome::kInterrupted;
      break;
    }
    estimation.Add(pair);
    if (progress) progress(std::ssize(result.steps), result.planned, result.Gaps());
  }
  NotePath(result);
  if (truth) JudgePath(request, *truth, result);
  WriteOdometryFiles(request, folder, result);
  return result;
}

}  // namespace rockyard::campaign
