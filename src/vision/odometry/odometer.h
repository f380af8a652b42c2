// Visual odometry: how a pair of cameras moved, from the images that it took (Matthies 1989; Howard
// 2012 section 2: detect, match, select, estimate).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "core/random.h"
#include "math/pose.h"
#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/odometry/detect_features.h"
#include "vision/odometry/estimate_motion.h"
#include "vision/odometry/feature.h"
#include "vision/odometry/match_features.h"
#include "vision/odometry/odometer_params.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

// What one pair of images adds to a path.
struct OdometryStep {
  std::int64_t number = 0;     // of this pair, from 0
  std::int64_t reference = 0;  // of the pair that it was compared with, the keyframe
  MotionResult result;         // from the keyframe to this pair; of a path's first pair, nothing
  bool keyframe = false;       // whether later pairs are compared with this one
  Features features;           // of its left image
  PointsSeenTwice consistent;  // keyframe first
};

enum class OdometryStage { kDetected, kMatched, kPlaced, kSelected, kEstimated, kRenewed };

// Called as a stage of a step ends (in each round of matching; kPlaced after a disparity map as
// well), for progress and time. It has no influence.
using OdometryWatcher = std::function<void(OdometryStage)>;

// One path of one pair of cameras.
//
// A pair is compared with the keyframe, which is renewed by OdometerParams::keyframe: a camera that
// stands still does not drift, and one that moves a centimetre an image errs once a keyframe. A
// pair without a motion becomes the keyframe as well, once KeyframeParams::failures are reached:
// the path has a gap there, from `reference` to `number`, which others (wheels) have to fill. Of
// fewer failures the next pair is compared with the same keyframe, and there is no gap if it
// succeeds.
class VisualOdometer {
 public:
  // `left_free`: pixels of the left image that show the world (1) and not the carrier (0); empty
  // where all do. `cameras` are those that the carrier believes to have: their errors are in no
  // covariance but by variance_factor. RANSAC draws from (key, kRansac) by the pair's number, so
  // that a path that is resumed draws as one that was not cut off.
  VisualOdometer(const OdometerParams& params, const RectifiedPair& cameras,
                 const Image<std::uint8_t>& left_free, core::TrialKey key,
                 OdometryWatcher watcher = {});

  // Takes the next pair, of the cameras' size. `predicted`: where the outer frame of the cameras is
  // expected, in that of the keyframe; it narrows the search (MatchSearch, MatchWarp), no more.
  // Without it, where no motion is found near it, and where the motion found is off by more than
  // round_way_m or round_turn_deg, that of one round of matching is what the next one expects, up
  // to OdometerParams::rounds; what had more consistent points stays.
  OdometryStep Add(AlignedImages images,
                   const std::optional<math::Transform>& predicted = std::nullopt);

  // Goes on with a path that another odometer of the same parameters began: the keyframe's number
  // and images, the number of the next pair, and how many pairs in a row had no motion up to there.
  void Resume(std::int64_t keyframe, AlignedImages images, std::int64_t next,
              std::int64_t failures);

  // Begins a new path with the next pair.
  void Renew() {
    keyframe_.reset();
    failures_ = 0;
  }

 private:
  // What later pairs are compared with: features that have a place.
  struct Keyframe {
    std::int64_t number = 0;
    AlignedImages images;
    Features features;
    std::vector<StereoMeasurement> places;
  };

  // What one round of matching made of a pair.
  struct Comparison {
    MotionResult result;
    PointsSeenTwice consistent;
    // Of half as many points as a motion needs, or more: where to look again.
    std::optional<math::Transform> rough_X_FS;
  };

  // Stereo of the images, where nobody has done it.
  void MakeMap(AlignedImages& images) const;
  Comparison Compare(const AlignedImages& images, const Features& features,
                     const std::optional<math::Transform>& predicted, std::int64_t number) const;
  Comparison CompareOnce(const AlignedImages& images, const Features& features,
                         const std::optional<math::Transform>& predicted,
                         core::RandomStream& stream) const;
  PredictedFeatures Predict(const math::Transform& X_FS) const;
  PointsSeenTwice PlaceAgain(const AlignedImages& images, const Features& features,
                             const FeatureMatches& matches,
                             const PredictedFeatures& predicted) const;
  bool IsOver(const MotionResult& result) const;
  void MakeKeyframe(std::int64_t number, AlignedImages images, const Features& features);
  void Tell(OdometryStage stage) const {
    if (watcher_) watcher_(stage);
  }

  OdometerParams params_;
  RectifiedPair cameras_;
  FeatureDetector detector_;
  core::TrialKey key_;
  OdometryWatcher watcher_;
  std::int64_t next_ = 0;
  std::int64_t failures_ = 0;  // in a row, up to the last pair
  std::optional<Keyframe> keyframe_;
};

}  // namespace rockyard::vision
