// From motions against keyframes to a path, and that path beside the true one. EstimatePath places
// its pairs and judges its path by it.
#pragma once

#include <map>
#include <optional>

#include "campaign/odometry/estimate_path.h"
#include "campaign/odometry/pair_reader.h"
#include "vision/odometry/odometer.h"

namespace rockyard::campaign {

// Places pair after pair. The first pair stands at the identity.
class PathTracker {
 public:
  // Returns where the next pair is expected, told in the frame of the present keyframe; nothing
  // where nothing tells it. `step`: the motion since the pair before that a file predicts.
  std::optional<math::Transform> Predict(Prediction prediction,
                                         const std::optional<math::Transform>& step) const;

  // Fills pose and covariance of a pair whose motion was sought. `predicted`: what Predict
  // returned, which stands in for a motion that was not found.
  void Place(const vision::OdometryStep& found, const std::optional<math::Transform>& predicted,
             PathStep& step);

 private:
  struct Known {
    math::Transform X_AB = math::Transform::Identity();
    std::optional<vision::MotionCovariance> covariance = vision::MotionCovariance::Zero();
  };

  Known keyframe_;
  math::Transform X_AB_ = math::Transform::Identity();  // of the last pair
  std::optional<math::Transform> last_step_;            // between the last two pairs
};

// True poses by the number of the pair.
using TruePath = std::map<std::int64_t, math::Transform>;

// Reads the truth that the request names; returns nothing where it names none. Poses of KITTI's
// form belong to the pairs of the whole sequence one by one; those of TUM's form to the pair whose
// time is nearest, at most 0.02 s away (Sturm et al. 2012 and their tools). Throws core::UserError:
// a file that cannot be read, another number of poses than of pairs, times where the sequence has
// none, no pair with a pose.
std::optional<TruePath> ReadTruth(const OdometryRequest& request, const ImageSequence& sequence);

// Fills truth, steps_with_truth and errors of the result, and notes what cannot be told.
void JudgePath(const OdometryRequest& request, const TruePath& truth, OdometryResult& result);

}  // namespace rockyard::campaign
