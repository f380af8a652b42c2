// Visual odometry: how a pair of cameras moved, from the images that it took (Matthies 1989; Howard
// 2012 section 2: detect, match, select, estimate). Rovers drive by it, and `rockyard vo` runs it
// over sequences of files. feature.h has the words.
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
  MotionResult result;         // from the keyframe to this pair; empty for a path's first pair
  bool keyframe = false;       // whether later pairs are compared with this one
  Features features;           // of its left image
  PointsSeenTwice consistent;  // the consistent set; `first` is in the keyframe
};

// Must stay in this order: PairStage of `rockyard vo` (campaign/odometry) repeats it.
enum class OdometryStage { kDetected, kMatched, kPlaced, kSelected, kEstimated, kRenewed };

// Called as a stage of a step ends (in each round of matching; kPlaced after a disparity map as
// well), for progress and time. The watcher cannot change results.
using OdometryWatcher = std::function<void(OdometryStage)>;

// One path of one pair of cameras.
//
// A pair is compared with the keyframe, which is renewed by OdometerParams::keyframe: a camera that
// stands still does not drift, and one that moves a centimetre an image errs once a keyframe. After
// KeyframeParams::failures pairs in a row without a motion, the last of them becomes the keyframe
// too. The path then has a gap from `reference` to `number`, which others (wheels) have to fill.
// After fewer failures the next pair is compared with the same keyframe, and leaves no gap if it
// has a motion.
class VisualOdometer {
 public:
  // `left_free` is that of FeatureDetector. `cameras` are the calibrated ones: only variance_factor
  // covers their errors. Records depend on the draws: RANSAC draws from (key, kRansac) by the
  // pair's number, so that a resumed path draws what one without a break does.
  VisualOdometer(const OdometerParams& params, const RectifiedPair& cameras,
                 const Image<std::uint8_t>& left_free, core::TrialKey key,
                 OdometryWatcher watcher = {});

  // Takes the next pair, of the cameras' size. `predicted` is X_FS as expected: the outer frame of
  // the cameras now, in that of the keyframe. It only narrows the search (MatchSearch, MatchWarp).
  // Where it leads to no motion, matching is tried without a prediction, and the result with more
  // consistent points is kept. As long as a result has a motion to expect (Comparison::rough_X_FS)
  // that is not within round_way_m and round_turn_deg of the expected one, another round of
  // matching expects that motion, up to OdometerParams::rounds in all; a round with fewer
  // consistent points than the one before is dropped and is the last.
  OdometryStep Add(AlignedImages images,
                   const std::optional<math::Transform>& predicted = std::nullopt);

  // Goes on with a path that another odometer of the same parameters began: by the keyframe's
  // number and images, the number of the next pair, and how many pairs in a row before it had no
  // motion.
  void Resume(std::int64_t keyframe, AlignedImages images, std::int64_t next,
              std::int64_t failures);

  // Begins a new path with the next pair.
  void Renew() {
    keyframe_.reset();
    failures_ = 0;
  }

 private:
  // The pair that later ones are compared with, and those of its features that have a place.
  struct Keyframe {
    std::int64_t number = 0;
    AlignedImages images;
    Features features;
    std::vector<StereoMeasurement> places;
  };

  // The result of one round of matching.
  struct Comparison {
    MotionResult result;
    PointsSeenTwice consistent;
    // The motion of the consistent set, if this has at least half as many points as a motion needs:
    // what the next round expects.
    std::optional<math::Transform> rough_X_FS;
  };

  // Makes the disparity map where the images have none.
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
