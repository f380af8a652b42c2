#include "vision/odometry/odometer.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "vision/odometry/consistent_set.h"
#include "vision/odometry/place_features.h"
#include "vision/odometry/plane_view.h"
#include "vision/odometry/refine_match.h"

namespace rockyard::vision {
namespace {

using math::Transform;

// Standard deviation of a feature's place in the keyframe. The place is exact by definition, and
// the error is in the place of its match; this number keeps the equations regular.
constexpr double kFeature_px = 0.01;

bool IsFew(std::int64_t count, const OdometerParams& params) {
  return count < params.selection.min_consistent;
}

// Returns whether two motions are so near that windows turned and scaled by either look alike.
bool IsNear(const Transform& a, const Transform& b, const OdometerParams& params) {
  const Transform difference = a.inverse() * b;
  return difference.translation().norm() < params.round_way_m &&
         math::TurnOf(difference.linear()).angle_rad < params.round_turn_rad;
}

bool IsSmallShare(const MotionCounts& counts, const OdometerParams& params) {
  return static_cast<double>(counts.consistent) <
         params.selection.min_share * static_cast<double>(counts.points);
}

}  // namespace

VisualOdometer::VisualOdometer(const OdometerParams& params, const RectifiedPair& cameras,
                               const Image<std::uint8_t>& left_free, core::TrialKey key,
                               OdometryWatcher watcher)
    : params_(params),
      cameras_(cameras),
      detector_(params.detector, cameras.size, left_free),
      key_(key),
      watcher_(std::move(watcher)) {}

OdometryStep VisualOdometer::Add(AlignedImages images, const std::optional<Transform>& predicted) {
  EXPECT(images.right.width() == images.left.width() &&
         images.right.height() == images.left.height());
  OdometryStep step;
  step.number = next_++;
  step.features = detector_.Detect(images.left);
  Tell(OdometryStage::kDetected);
  if (params_.placement.source == PlaceSource::kDisparityMap) MakeMap(images);
  if (keyframe_) {
    step.reference = keyframe_->number;
    Comparison found = Compare(images, step.features, predicted, step.number);
    step.result = found.result;
    step.consistent = std::move(found.consistent);
    failures_ = step.result.motion ? 0 : failures_ + 1;
    step.keyframe = IsOver(step.result);
  } else {
    step.reference = step.number;
    step.keyframe = true;
  }
  if (step.keyframe) failures_ = 0;
  if (step.keyframe) MakeKeyframe(step.number, std::move(images), step.features);
  Tell(OdometryStage::kRenewed);
  return step;
}

void VisualOdometer::Resume(std::int64_t keyframe, AlignedImages images, std::int64_t next,
                            std::int64_t failures) {
  const Features features = detector_.Detect(images.left);
  if (params_.placement.source == PlaceSource::kDisparityMap) MakeMap(images);
  MakeKeyframe(keyframe, std::move(images), features);
  next_ = next;
  failures_ = failures;
}

void VisualOdometer::MakeMap(AlignedImages& images) const {
  if (!images.disparities.empty()) {
    EXPECT(images.disparities.width() == images.left.width() &&
           images.disparities.height() == images.left.height());
    return;
  }
  images.disparities = MakePlacementMap(images.left, images.right, params_.placement);
  Tell(OdometryStage::kPlaced);
}

VisualOdometer::Comparison VisualOdometer::Compare(const AlignedImages& images,
                                                   const Features& features,
                                                   const std::optional<Transform>& predicted,
                                                   std::int64_t number) const {
  core::RandomStream stream(key_, core::Purpose::kRansac, static_cast<std::uint32_t>(number));
  Comparison best = CompareOnce(images, features, predicted, stream);
  std::optional<Transform> expected = predicted;
  if (expected && !best.result.motion) {
    Comparison anywhere = CompareOnce(images, features, std::nullopt, stream);
    if (anywhere.consistent.size() > best.consistent.size()) {
      best = std::move(anywhere);
      expected.reset();
    }
  }
  for (std::int64_t round = 1; round < params_.rounds && best.rough_X_FS; ++round) {
    if (expected && IsNear(*expected, *best.rough_X_FS, params_)) break;
    expected = best.rough_X_FS;
    Comparison next = CompareOnce(images, features, expected, stream);
    if (next.consistent.size() < best.consistent.size()) break;
    best = std::move(next);
  }
  return best;
}

VisualOdometer::Comparison VisualOdometer::CompareOnce(const AlignedImages& images,
                                                       const Features& features,
                                                       const std::optional<Transform>& predicted,
                                                       core::RandomStream& stream) const {
  Comparison comparison;
  MotionResult& result = comparison.result;
  const auto without = [&](NoMotion reason) {
    result.motion.reset();
    result.reason = reason;
    return comparison;
  };
  result.counts.features_first = static_cast<std::int64_t>(keyframe_->features.size());
  result.counts.features_second = static_cast<std::int64_t>(features.size());
  if (IsFew(result.counts.features_first, params_) ||
      IsFew(result.counts.features_second, params_)) {
    return without(NoMotion::kFewFeatures);
  }
  const PredictedFeatures expected = predicted ? Predict(*predicted) : PredictedFeatures{};
  const FeatureMatches matches = MatchFeatures(keyframe_->images.left, keyframe_->features,
                                               images.left, features, params_.matcher, expected);
  Tell(OdometryStage::kMatched);
  result.counts.matches = static_cast<std::int64_t>(matches.size());
  if (IsFew(result.counts.matches, params_)) return without(NoMotion::kFewMatches);
  const PointsSeenTwice points = PlaceAgain(images, features, matches, expected);
  Tell(OdometryStage::kPlaced);
  result.counts.points = static_cast<std::int64_t>(points.size());
  if (IsFew(result.counts.points, params_)) return without(NoMotion::kFewPoints);

  const std::optional<ConsistentSet> set =
      FindConsistentSet(points, cameras_, params_.selection, stream);
  Tell(OdometryStage::kSelected);
  if (!set) return without(NoMotion::kNoConsistentSet);
  const SetMotion found =
      MotionOfSet(points, cameras_, *set, params_.selection, params_.estimation);
  Tell(OdometryStage::kEstimated);
  for (const std::size_t member : found.members) comparison.consistent.push_back(points[member]);
  result.counts.consistent = static_cast<std::int64_t>(found.members.size());
  result.counts.iterations = found.estimated.iterations;
  result.rms_px = found.estimated.rms_px;
  result.motion = found.estimated.motion;
  if (result.motion) result.motion->covariance *= params_.variance_factor;
  result.reason = found.estimated.reason;
  if (found.estimated.converged && !IsFew(2 * result.counts.consistent, params_)) {
    comparison.rough_X_FS = found.estimated.X_FS;
  }
  if (IsFew(result.counts.consistent, params_) || IsSmallShare(result.counts, params_)) {
    return without(NoMotion::kNoConsistentSet);
  }
  return comparison;
}

// Predicts the keyframe's features. Those out of view are put far away, so that no feature is near.
PredictedFeatures VisualOdometer::Predict(const Transform& X_FS) const {
  constexpr double kNowhere_px = -1e6;
  const PlaneView see_again(cameras_, X_FS.inverse());
  PredictedFeatures predicted;
  for (const StereoMeasurement& place : keyframe_->places) {
    PredictedFeature& feature = predicted.emplace_back();
    feature.pixel = {kNowhere_px, kNowhere_px};
    if (const auto seen = see_again(place)) feature = *seen;
  }
  return predicted;
}

PointsSeenTwice VisualOdometer::PlaceAgain(const AlignedImages& images, const Features& features,
                                           const FeatureMatches& matches,
                                           const PredictedFeatures& predicted) const {
  const FeaturePlaces places(cameras_, params_.placement, images);
  const bool warp = params_.matcher.warp == MatchWarp::kPredicted && !predicted.empty();
  PointsSeenTwice points;
  std::vector<double> in_time;
  for (const FeatureMatch& match : matches) {
    const auto first = static_cast<std::size_t>(match.first);
    const Feature& found = features[static_cast<std::size_t>(match.second)];
    const StereoMeasurement& place = keyframe_->places[first];
    const WindowTemplate window(keyframe_->images.left, place.left,
                                warp ? predicted[first].view : ViewChange{},
                                params_.placement.side());
    const auto refined = window.Find(images.left, Pixel(found.column, found.row),
                                     {.noise_px = params_.placement.noise_px});
    if (!refined) continue;
    const auto second = places.PlaceOn(warp ? predicted[first].slope : place.slope, refined->pixel,
                                       refined->covariance_px2);
    if (!second) continue;
    points.push_back({place, *second});
    in_time.push_back(refined->residual);
  }
  // Unless windows were turned and scaled, their residuals in time say little about edges.
  if (!warp) in_time.clear();
  return KeepClean(points, in_time, params_.placement);
}

bool VisualOdometer::IsOver(const MotionResult& result) const {
  const KeyframeParams& rule = params_.keyframe;
  if (!result.motion) return failures_ >= rule.failures;
  const Transform& X_FS = result.motion->X_FS;
  const double share = static_cast<double>(result.counts.consistent) /
                       static_cast<double>(result.counts.features_first);
  return X_FS.translation().norm() >= rule.max_way_m ||
         math::TurnOf(X_FS.linear()).angle_rad >= rule.max_turn_rad || share < rule.min_share;
}

void VisualOdometer::MakeKeyframe(std::int64_t number, AlignedImages images,
                                  const Features& features) {
  Keyframe keyframe{number, std::move(images), {}, {}};
  const FeaturePlaces placer(cameras_, params_.placement, keyframe.images);
  for (const Feature& feature : features) {
    const auto place = placer.Place(Pixel(feature.column, feature.row),
                                    kFeature_px * kFeature_px * Eigen::Matrix2d::Identity());
    if (!place) continue;
    keyframe.features.push_back(feature);
    keyframe.places.push_back(*place);
  }
  keyframe_ = std::move(keyframe);
}

}  // namespace rockyard::vision
