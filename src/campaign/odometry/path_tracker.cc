#include "campaign/odometry/path_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "campaign/odometry/pose_text.h"
#include "core/error.h"
#include "vision/odometry/estimate_motion.h"

namespace rockyard::campaign {
namespace {

constexpr double kSameTime_s = 0.02;
// The 95 % point of chi-squared with 6 degrees of freedom (any table of it).
constexpr double kChiSquared6_95 = 12.591587;

TruePath TruthByNumber(const OdometryRequest& request, const PoseFile& file,
                       const ImageSequence& sequence) {
  if (file.poses.size() != sequence.pairs.size()) {
    throw core::UserError(request.truth.string(),
                          fmt::format("has {} poses, the sequence {} pairs", file.poses.size(),
                                      sequence.pairs.size()),
                          "give one pose a pair of the whole sequence, or poses with times (TUM)");
  }
  TruePath truth;
  for (std::size_t i = 0; i < file.poses.size(); ++i) {
    truth.emplace(static_cast<std::int64_t>(i), file.poses[i]);
  }
  return truth;
}

TruePath TruthByTime(const OdometryRequest& request, const PoseFile& file,
                     const ImageSequence& sequence) {
  if (!sequence.pairs.front().time_s) {
    throw core::UserError(request.truth.string(), "has times, the sequence has none",
                          "add times.txt to the sequence, or give poses of KITTI's form");
  }
  const std::vector<double>& times_s = *file.times_s;
  TruePath truth;
  for (std::size_t i = 0; i < sequence.pairs.size(); ++i) {
    const double time_s = sequence.pairs[i].time_s.value_or(0.0);
    const auto after = std::lower_bound(times_s.begin(), times_s.end(), time_s);
    auto nearest = static_cast<std::size_t>(after - times_s.begin());
    const bool before_is_nearer =
        nearest == times_s.size() ||
        (nearest > 0 && time_s - times_s[nearest - 1] < times_s[nearest] - time_s);
    if (before_is_nearer) --nearest;
    if (std::abs(times_s[nearest] - time_s) > kSameTime_s) continue;
    truth.emplace(static_cast<std::int64_t>(i), file.poses[nearest]);
  }
  if (truth.empty()) {
    throw core::UserError(request.truth.string(),
                          fmt::format("has no pose within {} s of any pair", kSameTime_s),
                          "give poses of the time in which the images were taken");
  }
  return truth;
}

// Returns the normalized error of every motion whose two pairs have true poses.
std::vector<double> NormalizedErrors(const TruePath& truth, const OdometryResult& result) {
  std::vector<double> normalized;
  for (const PathStep& step : result.steps) {
    const auto first = truth.find(step.reference);
    const auto second = truth.find(step.pair);
    if (!step.result.motion || first == truth.end() || second == truth.end()) continue;
    normalized.push_back(vision::NormalizedErrorSquared(*step.result.motion,
                                                        first->second.inverse() * second->second));
  }
  return normalized;
}

}  // namespace

using math::Transform;

std::optional<Transform> PathTracker::Predict(Prediction prediction,
                                              const std::optional<Transform>& step) const {
  if (prediction == Prediction::kNone) return std::nullopt;
  const std::optional<Transform>& next = prediction == Prediction::kFile ? step : last_step_;
  if (!next) return std::nullopt;
  return keyframe_.X_AB.inverse() * X_AB_ * *next;
}

void PathTracker::Place(const vision::OdometryStep& found,
                        const std::optional<Transform>& predicted, PathStep& step) {
  const bool first = found.reference == found.number;
  Known known = keyframe_;
  if (found.result.motion && known.covariance) {
    const vision::Motion whole =
        vision::Compose({known.X_AB, *known.covariance}, *found.result.motion);
    known = {whole.X_FS, whole.covariance};
  } else if (found.result.motion) {
    known.X_AB = known.X_AB * found.result.motion->X_FS;
  } else if (!first) {
    known = {predicted ? Transform(known.X_AB * *predicted) : X_AB_, std::nullopt};
  }
  if (!first) last_step_ = X_AB_.inverse() * known.X_AB;
  if (!first && !found.result.motion && !predicted) last_step_.reset();
  X_AB_ = known.X_AB;
  step.X_AB = known.X_AB;
  step.covariance = known.covariance;
  if (found.keyframe) keyframe_ = known;
}

std::optional<TruePath> ReadTruth(const OdometryRequest& request, const ImageSequence& sequence) {
  if (request.truth.empty()) return std::nullopt;
  const PoseFile file = ReadPoses(request.truth);
  return file.times_s ? TruthByTime(request, file, sequence)
                      : TruthByNumber(request, file, sequence);
}

void JudgePath(const OdometryRequest& request, const TruePath& truth, OdometryResult& result) {
  vision::Trajectory estimate;
  for (std::size_t i = 0; i < result.steps.size(); ++i) {
    const auto pose = truth.find(result.steps[i].pair);
    if (pose == truth.end()) continue;
    result.steps_with_truth.push_back(i);
    result.truth.push_back(pose->second);
    estimate.push_back(result.steps[i].X_AB);
  }
  if (estimate.size() < 2) {
    result.notes.emplace_back("fewer than two pairs have a true pose: no errors");
    return;
  }
  using vision::Alignment;
  PathErrors errors;
  errors.pairs = std::ssize(estimate);
  errors.distance_m = vision::DistancesAlong(result.truth).back();
  errors.segments =
      vision::MeanOf(request.lengths_m.empty()
                         ? vision::SegmentErrors(result.truth, estimate)
                         : vision::SegmentErrors(result.truth, estimate, request.lengths_m, 1));
  const std::vector<double> absolute_m =
      vision::AbsoluteErrors_m(result.truth, estimate, Alignment::kFirstPose);
  errors.end_error_m = absolute_m.back();
  errors.absolute_first_m = vision::SummaryOf(absolute_m);
  errors.absolute_rigid_m =
      vision::SummaryOf(vision::AbsoluteErrors_m(result.truth, estimate, Alignment::kRigid));
  const vision::RelativeErrors relative =
      vision::RelativeErrorsOf(result.truth, estimate, request.delta);
  errors.relative_m = vision::SummaryOf(relative.translation_m);
  errors.relative_rad = vision::SummaryOf(relative.rotation_rad);
  const std::vector<double> normalized = NormalizedErrors(truth, result);
  errors.normalized = vision::SummaryOf(normalized);
  if (!normalized.empty()) {
    const auto above = std::count_if(normalized.begin(), normalized.end(),
                                     [](double value) { return value > kChiSquared6_95; });
    errors.normalized_above_95 =
        static_cast<double>(above) / static_cast<double>(normalized.size());
  }
  if (!errors.segments) {
    result.notes.push_back(fmt::format(
        "the true path of {:.1f} m is too short for the lengths of KITTI's segments: --lengths "
        "names shorter ones",
        errors.distance_m));
  }
  result.errors = errors;
}

}  // namespace rockyard::campaign
